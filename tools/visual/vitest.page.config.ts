// SPDX-License-Identifier: MIT
// The built page in a real browser. Two at a time: a page mostly waits for its robot, which keeps real time. A test that failed is run
// once more, and the report says that it was: on a shared machine a browser that draws by software may be kept waiting.
import { defineConfig } from 'vitest/config';

export default defineConfig({
    test: {
        include: ['tests/page/*.test.ts'],
        testTimeout: 400_000,
        hookTimeout: 120_000,
        maxWorkers: 2,
        isolate: false,
        retry: 1,
        expect: { poll: { timeout: Number(process.env.WAIT_MS ?? 240_000) } }, // as long as every other wait (page-bench.ts)
    },
});
