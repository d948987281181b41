// SPDX-License-Identifier: MIT
// Pyodide names its .wasm, so that a bundler would put 10 MB unpacked beside the page; the worker hands over ours, packed.
// The place is replaced exactly once, or the build ends: a new version wants a new look.

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
