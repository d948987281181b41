// SPDX-License-Identifier: MIT
// Pyodide wants to know which packages it could load: none. Ours come in python.zip. It compares the versions with its own.

export const LOCK = JSON.stringify({
    info: { abi_version: '2026_0', arch: 'wasm32', platform: 'emscripten_5_0_3', python: '3.14.2' },
    packages: {},
});
