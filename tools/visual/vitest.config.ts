// SPDX-License-Identifier: MIT
import { defineConfig } from 'vitest/config';

// A busy computer may take minutes. The waits of the tests are limited in simulated time.
export default defineConfig({
    test: { include: ['tests/*.test.ts'], testTimeout: 600_000, hookTimeout: 600_000, execArgv: ['--experimental-wasm-jspi'] },
});
