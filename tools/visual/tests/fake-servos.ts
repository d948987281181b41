// SPDX-License-Identifier: MIT
// Servos behind an adapter in simulated time: the machine below servos-*.wasm for tests. They reach their goals at once; tools/sim/servo
// models real movement.

import type { MachineParts, Memories } from '../servos/machine.ts';
import { runProgram } from '../servos/machine.ts';

const EVERYBODY = 254;
const [PING, READ, WRITE, SYNC_WRITE] = [1, 2, 3, 0x83];
const GOAL = 30;
const PRESENT = 36;
/** Factory settings of an AX-12's registers that are not 0: address, value. */
const SHIPPED = [
    [0, 12],
    [2, 24],
    [4, 1],
    [5, 250],
    [8, 255],
    [9, 3],
    [11, 85],
    [12, 60],
    [13, 190],
    [14, 255],
    [15, 3],
    [16, 2],
    [17, 4],
    [18, 4],
    [26, 1],
    [27, 1],
    [28, 32],
    [29, 32],
    [31, 2],
    [34, 255],
    [35, 3],
    [37, 2],
    [42, 120],
    [43, 36],
    [48, 32],
] as const;

function packet(id: number, code: number, params: readonly number[]): Uint8Array {
    const body = [id, params.length + 2, code, ...params];
    return Uint8Array.of(0xff, 0xff, ...body, ~body.reduce((sum, byte) => sum + byte, 0) & 255);
}

export interface FakeOptions {
    readonly ids: readonly number[];
    readonly latencyMs?: number;
    readonly kept?: Memories;
}

export class FakeServos {
    nowMs = 0;
    isThere = true;
    isAskedToEnd = false;
    /** Delay of an answer in milliseconds. */
    latencyMs: number;
    rate = 1_000_000;
    text = '';
    readonly said: string[] = [];
    /** Goals of each SYNC WRITE: servo units by ID. */
    readonly frames: ReadonlyMap<number, number>[] = [];
    /** Instructions and addresses of all other packets. */
    readonly packets: { readonly id: number; readonly code: number; readonly params: readonly number[] }[] = [];
    readonly written: (readonly Uint8Array[])[] = [];
    private readonly tables = new Map<number, Uint8Array>();
    private readonly coming: { readonly atMs: number; readonly bytes: Uint8Array }[] = [];
    private typing: number[] = [];
    /** Until then the port takes no bytes. */
    private heldUpMs = 0;
    private isAsleep = false;
    private readonly waits: { readonly what: () => boolean; readonly done: () => void }[] = [];
    private readonly options: FakeOptions;
    private isStopped = false;

    constructor(options: FakeOptions) {
        this.options = options;
        this.latencyMs = options.latencyMs ?? 1;
        for (const id of options.ids) {
            const table = new Uint8Array(50);
            for (const [address, value] of SHIPPED) table[address] = value;
            table[3] = id;
            this.tables.set(id, table);
        }
    }

    /** Resolves when the program has ended or stop() was called. */
    async run(module: WebAssembly.Module): Promise<void> {
        await runProgram(module, this.parts()).catch((error: unknown) => {
            if (!this.isStopped) throw error;
        });
    }

    stop(): void {
        this.isStopped = true;
    }

    /** The port takes no bytes for so long, as that of a browser that gets no time. */
    holdUp(ms: number): void {
        this.heldUpMs = this.nowMs + ms;
    }

    type(text: string): void {
        this.typing.push(...new TextEncoder().encode(text));
    }

    /** Runs the program until the condition holds. Rejects after ten minutes of its time. */
    until(what: () => boolean): Promise<void> {
        const endMs = this.nowMs + 600_000;
        return new Promise((done, fail) => {
            this.waits.push({
                what: () => what() || this.nowMs > endMs,
                done: () => (what() ? done() : fail(new Error(`it did not come; the console says:\n${this.text}`))),
            });
        });
    }

    private parts(): MachineParts {
        return {
            now: () => this.nowMs,
            sleep: untilMs => this.sleep(untilMs),
            adapter: {
                isThere: () => this.isThere,
                setRate: rate => {
                    this.rate = rate;
                    return Promise.resolve();
                },
                write: bytes => this.write(bytes),
                read: to => this.read(to),
            },
            isAskedToEnd: () => this.isAskedToEnd,
            typed: to => {
                const bytes = this.typing.splice(0, to.length);
                to.set(bytes);
                return bytes.length;
            },
            printed: bytes => {
                this.text += new TextDecoder('latin1').decode(bytes);
            },
            sentence: text => void this.said.push(text),
            kept: this.options.kept ?? [null, null, null],
            keep: memories => {
                this.written.push(memories);
                return Promise.resolve(true);
            },
        };
    }

    private async sleep(untilMs: number): Promise<void> {
        this.isAsleep = true;
        await new Promise(resolve => setImmediate(resolve));
        this.isAsleep = false;
        if (this.isStopped) throw new Error('stopped');
        this.nowMs = Math.max(this.nowMs, Math.min(untilMs, this.coming[0]?.atMs ?? Infinity));
        for (const wait of this.waits.splice(0)) {
            if (wait.what()) wait.done();
            else this.waits.push(wait);
        }
    }

    private read(to: Uint8Array): number {
        let count = 0;
        for (let next = this.coming[0]; next && next.atMs <= this.nowMs && count + next.bytes.length <= to.length; next = this.coming[0]) {
            to.set(next.bytes, count);
            count += next.bytes.length;
            this.coming.shift();
        }
        return count;
    }

    /** Time also passes for a program that waits here rather than asleep. */
    private async write(bytes: Uint8Array): Promise<void> {
        while (this.nowMs < this.heldUpMs) {
            await new Promise(resolve => setImmediate(resolve));
            if (!this.isAsleep) this.nowMs++;
        }
        this.hear(bytes);
    }

    private hear(bytes: Uint8Array): void {
        const [, , id = 0, , code = 0] = bytes;
        const params = Array.from(bytes.subarray(5, -1));
        if (code === SYNC_WRITE) return this.syncWrite(params);
        this.packets.push({ id, code, params });
        const table = this.tables.get(id);
        const [at = 0, count = 0] = params;
        if (code === WRITE) for (const [one, own] of this.tables) if (one === id || id === EVERYBODY) own.set(params.slice(1), at);
        if (!table || !this.isThere || this.rate !== 1_000_000 || ![PING, READ, WRITE].includes(code)) return;
        const answer = code === READ ? Array.from(table.subarray(at, at + count)) : [];
        this.coming.push({ atMs: this.nowMs + this.latencyMs, bytes: packet(id, 0, answer) });
    }

    private syncWrite([at = 0, size = 0, ...data]: readonly number[]): void {
        const frame = new Map<number, number>();
        for (let i = 0; i < data.length; i += size + 1) {
            const values = data.slice(i + 1, i + 1 + size);
            const table = this.tables.get(data[i] ?? 0);
            table?.set(values, at);
            if (at !== GOAL) continue;
            table?.set(values.slice(0, 2), PRESENT);
            frame.set(data[i] ?? 0, (values[0] ?? 0) | ((values[1] ?? 0) << 8));
        }
        if (at === GOAL) this.frames.push(frame);
    }
}
