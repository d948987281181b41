// SPDX-License-Identifier: MIT
// The page's end of the worker that drives servos. Offers a Port, as any robot has.

import { BytePort } from '../sim/byte-port.ts';
import type { FromServos, ToServos } from './messages.ts';

export interface ServosEvents {
    /** All messages except bytes, which go to the port, and memories to keep. */
    message(message: FromServos): void;
    /** Resolves with false if they could not be stored. */
    keep(memories: readonly Uint8Array[]): Promise<boolean>;
}

export class ServosClient {
    readonly port: BytePort;
    private readonly worker: Worker;
    private readonly events: ServosEvents;
    private ended: () => void = () => undefined;
    private isOver = false;

    /** worker: a new one that runs worker.ts. name: the adapter's name, for people. */
    constructor(worker: Worker, name: string, events: ServosEvents) {
        this.worker = worker;
        this.events = events;
        this.port = new BytePort(name, bytes => this.post({ kind: 'bytes', bytes }));
        worker.onmessage = (event: MessageEvent<FromServos>) => this.take(event.data);
        worker.onerror = event => this.take({ kind: 'crashed', text: event.message || 'its worker cannot be loaded' });
    }

    post(message: ToServos): void {
        this.worker.postMessage(message);
    }

    /** Ends the program and then its worker. After limitMs the worker is terminated anyway. */
    async end(limitMs: number): Promise<void> {
        if (!this.isOver)
            await new Promise<void>(resolve => {
                this.ended = resolve;
                setTimeout(resolve, limitMs);
                this.post({ kind: 'end' });
            });
        this.worker.terminate();
    }

    private take(message: FromServos): void {
        if (message.kind === 'bytes') return this.port.push(message.bytes);
        if (message.kind === 'keep') return void this.keep(message.id, message.memories);
        if (message.kind === 'ended' || message.kind === 'crashed') {
            this.isOver = true;
            this.ended();
        }
        this.events.message(message);
    }

    private async keep(id: number, memories: readonly Uint8Array[]): Promise<void> {
        this.post({ kind: 'kept', id, isKept: await this.events.keep(memories) });
    }
}
