// SPDX-License-Identifier: MIT
// The worker with Python. Python is loaded at the first request. A failed load (no network, no memory) is repeated at the next request.

import { loadPyodide } from 'pyodide';
import createPyodideModule from 'pyodide/pyodide.asm.mjs';
import type { FileFormats } from '../model/file-formats.ts';
import { LOCK } from './lock.ts';
import type { FromFiles, PythonParts, Question, ToFiles } from './messages.ts';
import { PythonFormats } from './python-formats.ts';

declare const self: DedicatedWorkerGlobalScope;

let parts: PythonParts | null = null;
let loading: Promise<FileFormats> | null = null;
let turn = Promise.resolve();

async function get(url: string): Promise<Response> {
    const response = await fetch(url);
    if (!response.ok) throw new Error(`${url.split('/').at(-1)} could not be loaded (${response.status})`);
    return response;
}

/** Pyodide fetches its .wasm under its own name and does not report a missing library. Makes fetch() return our files instead. */
function handOver(files: ReadonlyMap<string, Response>): () => void {
    const { fetch } = self;
    self.fetch = (what, options) => {
        const [, file] = [...files].find(([name]) => String(what).endsWith(name)) ?? [];
        return file ? Promise.resolve(file) : fetch(what, options);
    };
    return () => {
        self.fetch = fetch;
    };
}

async function load({ wasmUrl, libraryUrl }: PythonParts): Promise<FileFormats> {
    const [packed, library] = await Promise.all([get(wasmUrl), get(libraryUrl)]);
    const stream = packed.body?.pipeThrough(new DecompressionStream('gzip'));
    const wasm = new Response(stream, { headers: { 'Content-Type': 'application/wasm' } });
    const takeBack = handOver(
        new Map([
            ['/pyodide.asm.wasm', wasm],
            [libraryUrl, library],
        ]),
    );
    try {
        const python = await loadPyodide({
            createPyodideModule,
            stdLibURL: libraryUrl,
            indexURL: new URL('./', self.location.href).href,
            lockFileContents: LOCK,
        });
        return new PythonFormats(python);
    } finally {
        takeBack();
    }
}

async function answer(question: Question): Promise<FromFiles> {
    try {
        if (!parts) throw new Error('not told where Python is');
        loading ??= load(parts);
        const formats = await loading;
        const ask = formats[question.ask] as (...what: readonly unknown[]) => Promise<unknown>;
        return { kind: 'answer', id: question.id, answer: await ask.apply(formats, question.what) };
    } catch (error) {
        loading = null;
        return { kind: 'trouble', id: question.id, text: error instanceof Error ? error.message : JSON.stringify(error) };
    }
}

self.onmessage = ({ data }: MessageEvent<ToFiles>) => {
    switch (data.kind) {
        case 'parts':
            parts = data.parts;
            return;
        case 'question':
            turn = turn.then(async () => self.postMessage(await answer(data)));
            return;
        default:
            data satisfies never;
    }
};
