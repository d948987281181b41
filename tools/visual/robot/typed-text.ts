// SPDX-License-Identifier: MIT
// What a person types, on its way into a line. A pasted text goes in short pieces, so that an XOFF comes in time and requests come in between.
// Keys that are pressed meanwhile wait behind it, unless they stop the robot: then the rest of it is dropped.

import type { Clock } from './clock.ts';
import type { Line } from './line.ts';
import { RobotError } from './robot-error.ts';

const PIECE_BYTES = 16;
/** 800 bytes a second, about as fast as the shell answers lines. After Play's XOFF 80 bytes still fit, and an adapter passes it on late. */
const PAUSE_MS = 20;
/** A board that prints the answers of many lines sends no XON for seconds. */
const HELD_MS = 10_000;
/** Empties the line that is half typed. */
const CTRL_U = '\x15';
const CTRL_C = '\x03';
/** A line that ends a play. */
const STOP = /[^\r]*(?:stop|break)\r$/i;

interface Paste {
    left: Uint8Array;
    /** Pressed since its last text. */
    keys: string;
    readonly reject: (error: unknown) => void;
}

export class TypedText {
    private readonly line: Pick<Line, 'write' | 'untilXon'>;
    private readonly clock: Clock;
    private paste: Paste | null = null;

    constructor(line: Pick<Line, 'write' | 'untilXon'>, clock: Clock) {
        this.line = line;
        this.clock = clock;
    }

    get isPasting(): boolean {
        return this.paste !== null;
    }

    /** Resolves when the line has taken all; rejects as the line does, and with text-dropped. What is typed during a paste belongs to the
     *  paste, whose promise tells of both. */
    write(bytes: Uint8Array): Promise<void> {
        const { paste } = this;
        const isKeys = bytes.length <= PIECE_BYTES;
        if (!paste) return isKeys ? this.line.write(bytes) : this.begin(bytes);
        paste.keys = isKeys ? paste.keys + String.fromCharCode(...bytes) : '';
        const stop = paste.keys.endsWith(CTRL_C) ? CTRL_C : STOP.exec(paste.keys)?.[0];
        if (stop !== undefined) {
            this.drop();
            return this.line.write(new TextEncoder().encode(CTRL_U + stop));
        }
        paste.left = joined(paste.left, bytes);
        return Promise.resolve();
    }

    /** Drops what is not sent yet. */
    drop(): void {
        this.paste?.reject(new RobotError('text-dropped'));
        this.paste = null;
    }

    private begin(bytes: Uint8Array): Promise<void> {
        return new Promise((resolve, reject) => {
            const paste = { left: bytes, keys: '', reject };
            this.paste = paste;
            this.send(paste).then(resolve, (error: unknown) => {
                if (this.paste === paste) this.paste = null;
                reject(error);
            });
        });
    }

    private async send(paste: Paste): Promise<void> {
        for (;;) {
            await this.line.untilXon(HELD_MS);
            if (this.paste !== paste) return; // dropped
            const piece = paste.left.slice(0, PIECE_BYTES);
            paste.left = paste.left.subarray(PIECE_BYTES);
            if (paste.left.length === 0) this.paste = null;
            await this.line.write(piece);
            if (this.paste !== paste) return;
            await new Promise<void>(resolve => this.clock.after(PAUSE_MS, resolve));
        }
    }
}

function joined(first: Uint8Array, second: Uint8Array): Uint8Array {
    const both = new Uint8Array(first.length + second.length);
    both.set(first);
    both.set(second, first.length);
    return both;
}
