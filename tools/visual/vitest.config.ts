// SPDX-License-Identifier: MIT
// The files share a process and what they import, because starting one for each costs more than most of them. A file that replaces a
// module of the page has a process of its own.
import { globSync, readFileSync } from 'node:fs';
import { defineConfig } from 'vitest/config';

const own = globSync('tests/*.test.ts').filter(file => readFileSync(file, 'utf8').includes('vi.mock('));
// A busy computer may take minutes. The waits of the tests are limited in simulated time.
const patient = { testTimeout: 600_000, hookTimeout: 600_000, execArgv: ['--experimental-wasm-jspi'] };

export default defineConfig({
    test: {
        projects: [
            {
                test: {
                    ...patient,
                    name: 'shared',
                    isolate: false,
                    setupFiles: 'tests/left-as-found.ts',
                    include: ['tests/*.test.ts'],
                    exclude: own,
                },
            },
            { test: { ...patient, name: 'own', include: own } },
        ],
    },
});
