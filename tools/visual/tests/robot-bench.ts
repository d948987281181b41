// SPDX-License-Identifier: MIT
// A robot on the bench for the tests of robot/: the real firmware on the board of board.wasm behind a port, in simulated time. The board's
// bytes arrive in pieces of random length.

import { readFile } from 'node:fs/promises';
import { CYCLES_PER_MS } from '../sim/board.ts';
import type { Board } from '../sim/board.ts';
import { BytePort } from '../sim/byte-port.ts';
import { makeMachine } from '../sim/machine.ts';
import type { Clock } from '../robot/clock.ts';

const BUILD = new URL('../../../build/', import.meta.url);

/** mulberry32: small, and the same on every computer. */
export function randomNumbers(seed: number): () => number {
    let state = seed >>> 0;
    return () => {
        state = (state + 0x6d2b79f5) >>> 0;
        let t = Math.imul(state ^ (state >>> 15), 1 | state);
        t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
        return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
    };
}

export class SimulatedClock implements Clock {
    private ms = 0;
    private readonly timers = new Map<number, { at: number; call: () => void }>();
    private next = 1;

    now(): number {
        return this.ms;
    }

    after(delayMs: number, call: () => void): () => void {
        const id = this.next++;
        this.timers.set(id, { at: this.ms + delayMs, call });
        return () => this.timers.delete(id);
    }

    advance(ms: number): void {
        this.ms += ms;
        for (const [id, timer] of [...this.timers]) {
            if (timer.at > this.ms) continue;
            this.timers.delete(id);
            timer.call();
        }
    }
}

export async function wasmModule(name: string): Promise<WebAssembly.Module> {
    return WebAssembly.compile(await readFile(new URL(`wasm/${name}.wasm`, BUILD)));
}

export async function robotImages(image: 'play' | 'edit') {
    const hex = (name: string): Promise<string> => readFile(new URL(`firmware/${name}-cm5.hex`, BUILD), 'utf8');
    const motions = new Uint8Array(await readFile(new URL('motions/motions.bin', BUILD)));
    return { boot: await hex('boot'), application: await hex(image), motions };
}

/** Lets all pending tasks run. */
export async function settle(): Promise<void> {
    for (let i = 0; i < 3; i++) await new Promise(resolve => setImmediate(resolve));
}

export class RobotBench {
    readonly clock = new SimulatedClock();
    readonly port: BytePort;
    readonly board: Board;
    readonly random: () => number;
    private pieces: Uint8Array[] = [];

    private constructor(board: Board, seed: number) {
        this.board = board;
        this.random = randomNumbers(seed);
        this.port = new BytePort('the robot on the bench', bytes => board.send('pc', bytes));
    }

    static async make(image: 'play' | 'edit', seed: number): Promise<RobotBench> {
        const board = await makeMachine(await wasmModule('board'), await robotImages(image), null, seed);
        board.setPower(true);
        return new RobotBench(board, seed);
    }

    /** Runs simulated time. */
    async run(ms: number): Promise<void> {
        for (let i = 0; i < ms; i++) {
            if (!this.board.runTo(this.board.nowCycles + CYCLES_PER_MS)) throw new Error(this.board.violation?.text);
            const bytes = this.board.receive();
            if (bytes.length > 0) this.pieces.push(bytes);
            if (this.random() < 0.2) this.deliver();
            this.clock.advance(1);
            await settle();
        }
    }

    /** Runs until the promise settles, at most limitMs. Returns its result or throws its error. */
    async until<T>(promise: Promise<T>, limitMs = 10_000): Promise<T> {
        let isDone = false;
        promise.then(
            () => (isDone = true),
            () => (isDone = true),
        );
        for (let ms = 0; ms < limitMs && !isDone; ms += 5) await this.run(5);
        if (!isDone) throw new Error(`nothing came within ${limitMs} ms of simulated time`);
        return promise;
    }

    private deliver(): void {
        let bytes = Uint8Array.from(this.pieces.flatMap(piece => [...piece]));
        this.pieces = [];
        while (bytes.length > 0) {
            const count = 1 + Math.floor(this.random() * Math.min(bytes.length, 40));
            this.port.push(bytes.slice(0, count));
            bytes = bytes.slice(count);
        }
    }
}
