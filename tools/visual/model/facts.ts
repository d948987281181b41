// SPDX-License-Identifier: MIT
// The numbers of C: made from its headers by board/facts.c while the page is built. They are written nowhere else here
// (tests/facts.test.ts looks).

export * from '../../../build/wasm/facts.ts';
