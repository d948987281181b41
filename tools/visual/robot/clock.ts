// SPDX-License-Identifier: MIT
// Where time comes from: the wall clock for a real robot, simulated time in tests.

export interface Clock {
    /** Milliseconds from any fixed moment. */
    now(): number;
    /** Calls back once, after so many milliseconds; the returned function takes it back. */
    after(delayMs: number, call: () => void): () => void;
}

const SLICE_MS = 100;

/** The wall clock, as far as this program was awake: what it waits for it waits in slices, and a slice that comes late counts no more than
 *  it should have lasted. So an answer that came while a busy computer was elsewhere is seen before its time is said to be over. */
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
