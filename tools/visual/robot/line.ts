// SPDX-License-Identifier: MIT
// One open port: the only reader and the only writer of its streams. Received bytes pass through one read loop and the parser; sent bytes
// pass through one queue that obeys XOFF. Reports by callbacks. It knows no requests and no connection states.

import type { Clock } from './clock.ts';
import { parseLine } from './line-parser.ts';
import type { LineState } from './line-parser.ts';
import type { Port } from './port.ts';
import { RobotError } from './robot-error.ts';

/** A lost XON must not block for ever. A save takes 60 ms. */
const HOLD_LIMIT_MS = 1000;

export interface LineEvents {
    /** For a terminal. */
    text(bytes: Uint8Array): void;
    /** A complete answer line without its line end. */
    answer(line: string): void;
    /** The port is lost (a pulled cable). Not called after close(). */
    lost(cause: unknown): void;
}

export class Line {
    private readonly port: Port;
    private readonly clock: Clock;
    private readonly events: LineEvents;
    private state: LineState = null;
    private reader: ReadableStreamDefaultReader<Uint8Array> | null = null;
    private writer: WritableStreamDefaultWriter<Uint8Array> | null = null;
    private writing: Promise<void> = Promise.resolve();
    /** The XOFF in force. */
    private xoff: { atMs: number; readonly ended: Promise<void>; readonly end: () => void } | null = null;
    private isClosed = false;
    private loop: Promise<void> = Promise.resolve();

    /** Takes an open port. The caller closes the port after close() of this object. */
    constructor(port: Port, clock: Clock, events: LineEvents) {
        this.port = port;
        this.clock = clock;
        this.events = events;
        this.writer = port.writable?.getWriter() ?? null;
        this.loop = this.readAll();
    }

    /** Queues bytes. Resolves when the port has taken them; rejects if it cannot, and with no-answer if it could not within limitMs: they are
     *  dropped then. */
    write(bytes: Uint8Array, limitMs = Infinity): Promise<void> {
        const endMs = this.clock.now() + limitMs;
        const done = this.writing.then(async () => {
            if (this.xoff) await this.untilXon(HOLD_LIMIT_MS);
            if (!this.writer || this.isClosed) throw new RobotError('not-connected');
            if (this.clock.now() > endMs) throw new RobotError('no-answer');
            await this.writer.write(bytes).catch((cause: unknown) => {
                this.lose(cause); // this stream takes nothing more, and the reader may never notice
                throw new RobotError('port-lost', '', { cause });
            });
        });
        this.writing = done.catch(() => undefined); // the caller gets the error; later writes may still work
        return done;
    }

    /** Resolves when no XOFF is in force, or none that is younger than limitMs. */
    async untilXon(limitMs: number): Promise<void> {
        // An XON and the next XOFF may come together.
        while (this.xoff) {
            const { atMs, ended } = this.xoff;
            const leftMs = atMs + limitMs - this.clock.now();
            if (leftMs <= 0) return;
            let cancel = (): void => undefined;
            await Promise.race([ended, new Promise<void>(resolve => (cancel = this.clock.after(leftMs, resolve)))]);
            cancel();
        }
    }

    async close(): Promise<void> {
        this.isClosed = true;
        this.go();
        await this.reader?.cancel().catch(() => undefined); // a lost port has ended already
        await this.loop;
        this.writer?.releaseLock();
        this.writer = null;
    }

    private async readAll(): Promise<void> {
        while (this.port.readable && !this.isClosed) {
            this.reader = this.port.readable.getReader();
            try {
                for (let read = await this.reader.read(); !read.done; read = await this.reader.read()) this.take(read.value);
                break; // cancelled, or closed by the port
            } catch (cause) {
                // A framing or overrun error ends this stream, and the port offers another. A lost port offers none.
                if (!this.port.readable) return this.lose(cause);
            } finally {
                this.reader.releaseLock();
                this.reader = null;
            }
        }
        if (!this.isClosed) this.lose(null);
    }

    private lose(cause: unknown): void {
        if (this.isClosed) return;
        this.isClosed = true;
        this.go();
        this.events.lost(cause);
    }

    private take(bytes: Uint8Array): void {
        const [state, events] = parseLine(this.state, bytes);
        this.state = state;
        for (const event of events) {
            switch (event.kind) {
                case 'text':
                    this.events.text(event.bytes);
                    break;
                case 'answer':
                    this.events.answer(event.line);
                    break;
                case 'flow':
                    event.go ? this.go() : this.hold();
                    break;
                default:
                    event satisfies never;
            }
        }
    }

    private hold(): void {
        const atMs = this.clock.now();
        if (this.xoff) {
            this.xoff.atMs = atMs;
            return;
        }
        let end = (): void => undefined;
        const ended = new Promise<void>(resolve => (end = resolve));
        this.xoff = { atMs, ended, end };
    }

    private go(): void {
        this.xoff?.end();
        this.xoff = null;
    }
}
