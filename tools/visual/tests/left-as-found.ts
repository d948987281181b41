// SPDX-License-Identifier: MIT
// Runs with every file of the tests in Node. They share a process: the clock and the globals that one replaces are not the next one's.
import { afterAll, vi } from 'vitest';

afterAll(() => {
    vi.useRealTimers();
    vi.unstubAllGlobals();
});
