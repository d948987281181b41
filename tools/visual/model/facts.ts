// SPDX-License-Identifier: MIT
// The numbers of C: made from its headers by board/facts.c while the page is built. They are written nowhere else here.

export * from '../../../build/wasm/facts.ts';
