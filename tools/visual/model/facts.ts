// SPDX-License-Identifier: MIT
// The constants of the C code, generated from its headers by board/facts.c during the build. They are not repeated anywhere else here.

export * from '../../../build/wasm/facts.ts';
