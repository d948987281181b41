// SPDX-License-Identifier: MIT
import { defineConfig } from 'vitest/config';

// A busy machine may take minutes; what a test waits for is bounded in simulated time.
export default defineConfig({
    test: { include: ['tests/*.test.ts'], testTimeout: 600_000, hookTimeout: 600_000, execArgv: ['--experimental-wasm-jspi'] },
});
