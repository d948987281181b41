// SPDX-License-Identifier: MIT
// Pyodide's code refers to its .wasm, so a bundler would add 10 MB uncompressed to the page. The worker supplies our compressed file
// instead. The place must be replaced exactly once, or the build fails: a new version needs a review.

import type { Plugin } from 'vite';

const FROM = 'return new URL("pyodide.asm.wasm",import.meta.url).href';

export function pythonHandedOver(): Plugin {
    return {
        name: 'python-handed-over',
        enforce: 'pre',
        transform(code, id) {
            if (!/pyodide[\\/]pyodide\.asm\.mjs/.test(id)) return null;
            if (code.split(FROM).length !== 2) this.error(`Pyodide's JavaScript has changed: "${FROM}" is not there once`);
            return { code: code.replace(FROM, 'return "pyodide.asm.wasm"'), map: null };
        },
    };
}
