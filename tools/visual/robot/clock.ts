// SPDX-License-Identifier: MIT
// Where time comes from: the wall clock for a real robot, simulated time in tests.

export interface Clock {
  /** Milliseconds from any fixed moment. */
  now(): number;
  /** Calls back once, after so many milliseconds; the returned function takes it back. */
  after(delayMs: number, call: () => void): () => void;
}

export const wallClock: Clock = {
  now: () => performance.now(),
  after: (delayMs, call) => {
    const timer = setTimeout(call, delayMs);
    return () => clearTimeout(timer);
  },
};
