// SPDX-License-Identifier: MIT
// Messages between the page and the worker with Python. An answer has the id of its question.

import type { FileFormats } from '../model/file-formats.ts';

/** Addresses of the two large files, which are loaded when first needed. */
export interface PythonParts {
    /** pyodide.asm.wasm, compressed with gzip. */
    readonly wasmUrl: string;
    /** Made by pack.mjs. */
    readonly libraryUrl: string;
}

export type Question = {
    [K in keyof FileFormats]: { readonly id: number; readonly ask: K; readonly what: Parameters<FileFormats[K]> };
}[keyof FileFormats];

export type ToFiles = { readonly kind: 'parts'; readonly parts: PythonParts } | ({ readonly kind: 'question' } & Question);

export type FromFiles =
    | { readonly kind: 'answer'; readonly id: number; readonly answer: unknown }
    | { readonly kind: 'trouble'; readonly id: number; readonly text: string };
