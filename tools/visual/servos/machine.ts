// SPDX-License-Identifier: MIT
// hal/host/machine.h for a program of servos-*.wasm: the page is the computer below it. The program is one loop in C that waits inside its
// calls. A wait is a promise: JavaScript Promise Integration keeps the program's stack, and the worker can receive messages meanwhile.

import { wasiImports } from '../sim/wasi.ts';

/** machine_memory_t: motion pages, journal, EEPROM. null: nothing was stored. */
export type Memories = readonly (Uint8Array | null)[];

export interface MachineParts {
    /** Milliseconds since a fixed moment. Monotonic. */
    now(): number;
    /** Resolves at that time, or earlier when something arrives for the program. */
    sleep(untilMs: number): Promise<void>;
    readonly adapter: {
        isThere(): boolean;
        setRate(bitsPerSecond: number): Promise<void>;
        /** Resolves when the port has taken the bytes or is lost. */
        write(bytes: Uint8Array): Promise<void>;
        read(to: Uint8Array): number;
    };
    isAskedToEnd(): boolean;
    /** Takes typed bytes and returns their count. */
    typed(to: Uint8Array): number;
    printed(bytes: Uint8Array): void;
    sentence(text: string): void;
    readonly kept: Memories;
    /** Resolves when the memories are stored; false: they could not be. */
    keep(memories: readonly Uint8Array[]): Promise<boolean>;
}

interface Exports {
    readonly memory: WebAssembly.Memory;
    _initialize(): void;
    program_start(): number;
}

/** Not yet in TypeScript's own library. */
interface PromiseIntegration {
    readonly Suspending?: new (work: (...values: never[]) => unknown) => WebAssembly.ImportValue;
    readonly promising?: (exported: () => number) => () => Promise<number>;
}

const HALF_US_PER_MS = 2000;
/** An FTDI adapter holds bytes back for 16 ms, and a busy browser delivers them late. */
const PATIENCE_MS = 60;
const RATE_OF_DIVISOR = 2_000_000;

/** The program has ended by itself, for example after `@reset`. */
class Ended extends Error {}

export function canRunServos(): boolean {
    return (WebAssembly as PromiseIntegration).Suspending !== undefined;
}

/** Runs the program from its start. Resolves when it ends. Rejects with the reason if it crashes. */
export async function runProgram(module: WebAssembly.Module, parts: MachineParts): Promise<void> {
    const { Suspending, promising } = WebAssembly as PromiseIntegration;
    if (!Suspending || !promising) throw new Error('this browser has no JavaScript Promise Integration');
    const memories: Uint8Array[] = [];
    const startMs = parts.now();
    const bytes = (at: number, count: number): Uint8Array => new Uint8Array(api.memory.buffer, at, count);
    const keepAll = (): Promise<boolean> => parts.keep(memories.map(memory => memory.slice()));
    const machine = {
        machine_now: () => BigInt(Math.round((parts.now() - startMs) * HALF_US_PER_MS)),
        machine_wait: new Suspending((until: bigint) => parts.sleep(startMs + Number(until) / HALF_US_PER_MS)),
        machine_bus_is_there: () => Number(parts.adapter.isThere()),
        machine_bus_first_patience: () => PATIENCE_MS * HALF_US_PER_MS,
        machine_bus_least_patience: () => PATIENCE_MS * HALF_US_PER_MS,
        machine_bus_rate: new Suspending(async (divisor: number) => {
            const rate = Math.floor(RATE_OF_DIVISOR / (divisor + 1));
            await parts.adapter.setRate(rate);
            return rate;
        }),
        // The program waits with its goals for a port that gets no time: they do not pile up, and its ticks come late.
        machine_bus_write: new Suspending((at: number, count: number) => parts.adapter.write(bytes(at, count).slice())),
        machine_bus_read: (at: number, room: number) => parts.adapter.read(bytes(at, room)),
        machine_console_read: (at: number, room: number) => parts.typed(bytes(at, room)),
        machine_console_write: (at: number, count: number) => {
            if (count > 0) parts.printed(bytes(at, count).slice());
            return count;
        },
        machine_buttons: () => 0,
        machine_tell: (at: number) => {
            const memory = new Uint8Array(api.memory.buffer);
            parts.sentence(new TextDecoder().decode(memory.slice(at, memory.indexOf(0, at))));
        },
        machine_recall: (memory: number, at: number, count: number) => {
            const kept = parts.kept[memory];
            if (kept) bytes(at, count).set(kept.subarray(0, count));
            memories[memory] = bytes(at, count).slice();
            return Number(kept !== null);
        },
        machine_keep: new Suspending(async (memory: number, to: number, at: number, count: number, now: number) => {
            memories[memory]?.set(bytes(at, count), to);
            return Number(now === 0 || (await keepAll()));
        }),
        machine_settle: () => void keepAll(),
        machine_watch: () => undefined,
        machine_is_asked_to_end: () => Number(parts.isAskedToEnd()),
        machine_end: () => {
            throw new Ended();
        },
    };
    const instance = await WebAssembly.instantiate(module, { env: machine, ...wasiImports(() => api.memory) });
    const api = instance.exports as unknown as Exports; // made by firmware/host/program.cmake
    api._initialize();
    try {
        await promising(api.program_start)();
    } catch (cause) {
        if (!(cause instanceof Ended)) throw cause;
        await keepAll(); // what was set in a motion is not settled yet
    }
}
