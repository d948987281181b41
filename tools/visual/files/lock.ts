// SPDX-License-Identifier: MIT
// Pyodide needs a list of the packages that it can load: none, ours come in python.zip. It compares these versions with its own.

export const LOCK = JSON.stringify({
    info: { abi_version: '2026_0', arch: 'wasm32', platform: 'emscripten_5_0_3', python: '3.14.2' },
    packages: {},
});
