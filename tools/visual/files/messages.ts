// SPDX-License-Identifier: MIT
// Between the page and the worker with Python. Each question has an id; its answer carries the same.

import type { FileFormats } from '../model/file-formats.ts';

/** Addresses of the two large files, asked for when first needed. */
export interface PythonParts {
    /** pyodide.asm.wasm, packed with gzip. */
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
