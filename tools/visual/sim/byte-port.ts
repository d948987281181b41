// SPDX-License-Identifier: MIT
// A Port whose other end is code: the board in the worker, or a test. Bytes from the board are pushed in; bytes for the board are passed to
// a function.

import type { Port } from '../robot/port.ts';

export class BytePort implements Port {
    readonly name: string;
    readable: ReadableStream<Uint8Array> | null = null;
    writable: WritableStream<Uint8Array> | null = null;
    private readonly deliver: (bytes: Uint8Array) => void;
    private source: ReadableStreamDefaultController<Uint8Array> | null = null;

    constructor(name: string, deliver: (bytes: Uint8Array) => void) {
        this.name = name;
        this.deliver = deliver;
    }

    open(): Promise<void> {
        if (this.readable) return Promise.reject(new DOMException('the port is open already', 'InvalidStateError'));
        this.readable = this.stream();
        this.writable = new WritableStream<Uint8Array>({ write: bytes => this.deliver(bytes) });
        return Promise.resolve();
    }

    close(): Promise<void> {
        this.source?.close();
        this.source = null;
        this.readable = null;
        this.writable = null;
        return Promise.resolve();
    }

    /** Bytes from the board. If nobody reads the port, they are lost, as on a wire. */
    push(bytes: Uint8Array): void {
        this.source?.enqueue(bytes);
    }

    /** Simulates a byte without its stop bit: this stream ends with an error, and the port offers another one, as in a browser. */
    garble(): void {
        const source = this.source;
        this.readable = this.stream();
        source?.error(new DOMException('a framing error', 'FramingError'));
    }

    /** Simulates a pulled cable: the stream ends with an error, and the port offers no other. */
    unplug(): void {
        const source = this.source;
        this.source = null;
        this.readable = null;
        this.writable = null;
        source?.error(new DOMException('the device has been lost', 'NetworkError'));
    }

    private stream(): ReadableStream<Uint8Array> {
        return new ReadableStream<Uint8Array>({
            start: controller => {
                this.source = controller;
            },
            cancel: () => {
                this.source = null;
            },
        });
    }
}
