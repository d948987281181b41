// SPDX-License-Identifier: MIT
// The servo adapter: a serial port whose rate can change. It is lost when unplugged and reopened when it is back. Received bytes wait here
// until the program takes them.

import type { Port } from '../robot/port.ts';

/** The part of a port that is used here. */
export type AdapterPort = Pick<Port, 'readable' | 'writable' | 'close'> & {
    open(options: { baudRate: number; bufferSize: number }): Promise<void>;
};

export interface AdapterEvents {
    /** Bytes have arrived, or the adapter is lost or back. Wakes a waiting program. */
    news(): void;
    isThere(isThere: boolean): void;
}

/** What the browser has taken waits there unseen while it gets no time: two ticks of goals. Received bytes find room in the driver. */
const BUFFER_BYTES = 128;
const TRY_AGAIN_MS = 1000;
/** An adapter may lose what is sent right after it is opened. */
const SETTLE_MS = 100;

export class Adapter {
    private readonly find: () => Promise<AdapterPort | null>;
    private readonly events: AdapterEvents;
    private port: AdapterPort | null = null;
    private writer: WritableStreamDefaultWriter<Uint8Array> | null = null;
    private reader: ReadableStreamDefaultReader<Uint8Array> | null = null;
    private reading: Promise<void> = Promise.resolve();
    private readonly heard: Uint8Array[] = [];
    private endWrite: () => void = () => undefined;
    private rate = 0;
    private isClosed = false;

    /** find returns the adapter's port, or null if it is not plugged in. */
    constructor(find: () => Promise<AdapterPort | null>, events: AdapterEvents) {
        this.find = find;
        this.events = events;
    }

    isThere(): boolean {
        return this.port !== null;
    }

    /** Rejects if there is no port or it cannot be opened. */
    async open(rate: number): Promise<void> {
        this.rate = rate;
        const port = await this.find();
        if (!port) throw new Error('there is no such port');
        await this.openPort(port);
    }

    /** Closes the port. */
    async close(): Promise<void> {
        this.isClosed = true;
        await this.closePort().catch(() => undefined); // a lost port cannot be closed
    }

    /** Resolves when the port has this rate. Bytes sent before have left by then. */
    async setRate(rate: number): Promise<void> {
        if (this.rate === rate) return;
        this.rate = rate;
        const { port } = this;
        if (!port) return;
        try {
            await this.closePort();
            await this.openPort(port);
        } catch {
            this.port = port; // it may have been pulled out while it was closed
            this.lose(port);
        }
    }

    /** Resolves when the port has taken the bytes. Bytes that cannot be sent are lost, as on a cable. */
    write(bytes: Uint8Array): Promise<void> {
        const { port, writer } = this;
        if (!writer) return Promise.resolve();
        return new Promise(resolve => {
            this.endWrite = resolve; // a port that is pulled out may leave the write open
            void writer
                .write(bytes)
                .catch(() => this.lose(port))
                .then(resolve);
        });
    }

    /** Takes received bytes and returns their count. */
    read(to: Uint8Array): number {
        let count = 0;
        for (let piece = this.heard[0]; piece && count < to.length; piece = this.heard[0]) {
            const part = piece.subarray(0, to.length - count);
            to.set(part, count);
            count += part.length;
            if (part.length === piece.length) this.heard.shift();
            else this.heard[0] = piece.subarray(part.length);
        }
        return count;
    }

    private async openPort(port: AdapterPort): Promise<void> {
        await port.open({ baudRate: this.rate, bufferSize: BUFFER_BYTES });
        await new Promise(resolve => setTimeout(resolve, SETTLE_MS));
        this.port = port;
        this.writer = port.writable?.getWriter() ?? null;
        this.reading = this.readAll(port);
    }

    private async closePort(): Promise<void> {
        const { port, writer, reader } = this;
        this.writer = null;
        this.port = null;
        await writer?.close();
        writer?.releaseLock();
        await reader?.cancel();
        await this.reading;
        await port?.close();
    }

    private async readAll(port: AdapterPort): Promise<void> {
        while (port.readable && this.port === port) {
            const reader = port.readable.getReader();
            this.reader = reader;
            try {
                for (let read = await reader.read(); !read.done; read = await reader.read()) {
                    this.heard.push(read.value);
                    this.events.news();
                }
            } catch {
                // A framing or overrun error ends this stream, and the port offers another. A lost port offers none.
            } finally {
                reader.releaseLock();
            }
        }
        this.lose(port);
    }

    private lose(port: AdapterPort | null): void {
        if (!port || this.port !== port) return; // closed on purpose or already lost
        const { writer } = this;
        this.writer = null;
        this.port = null;
        this.heard.length = 0;
        this.endWrite();
        this.events.isThere(false);
        this.events.news();
        void this.giveUp(port, writer).finally(() => this.lookAgain());
    }

    /** The port can only be reopened after its streams are released. */
    private async giveUp(port: AdapterPort, writer: WritableStreamDefaultWriter<Uint8Array> | null): Promise<void> {
        writer?.releaseLock();
        await this.reading;
        await port.close().catch(() => undefined); // a lost port may be closed already
    }

    private lookAgain(): void {
        if (this.isClosed) return;
        setTimeout(() => void this.comeBack().catch(() => this.lookAgain()), TRY_AGAIN_MS);
    }

    private async comeBack(): Promise<void> {
        if (this.isClosed) return;
        await this.open(this.rate);
        if (!this.isThere()) return; // lost again meanwhile, which has been told
        this.events.isThere(true);
        this.events.news();
    }
}
