// SPDX-License-Identifier: MIT
// The source of time: the wall clock for a real robot, simulated time in tests.

export interface Clock {
    /** Milliseconds since a fixed moment. */
    now(): number;
    /** Calls back once after this many milliseconds. The returned function cancels it. */
    after(delayMs: number, call: () => void): () => void;
}

const SLICE_MS = 100;

/** The wall clock, counting only time while this program was awake. It waits in slices, and a late slice counts no longer than planned. So
 *  an answer that arrived while the computer was busy is handled before its time-out. */
export const wallClock: Clock = {
    now: () => performance.now(),
    after: (delayMs, call) => {
        let timer: ReturnType<typeof setTimeout>;
        const wait = (leftMs: number): void => {
            const sliceMs = Math.min(leftMs, SLICE_MS);
            timer = setTimeout(() => (leftMs > sliceMs ? wait(leftMs - sliceMs) : call()), sliceMs);
        };
        wait(delayMs);
        return () => clearTimeout(timer);
    },
};
