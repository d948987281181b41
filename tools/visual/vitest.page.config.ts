// SPDX-License-Identifier: MIT
// The built page in a real browser. Two tests run at a time: a page mostly waits for its robot, which runs in real time. A failed test is
// repeated once, and the report says so, because software drawing can be starved on a shared machine. With WAIT_MS, while a test is
// written, it is not.
import { defineConfig } from 'vitest/config';

export default defineConfig({
    test: {
        include: ['tests/page/*.test.ts'],
        testTimeout: 400_000,
        hookTimeout: 120_000,
        maxWorkers: 2,
        isolate: false,
        retry: process.env.WAIT_MS ? 0 : 1,
        expect: { poll: { timeout: Number(process.env.WAIT_MS ?? 240_000) } }, // as every other wait (page-bench.ts)
    },
});
