// SPDX-License-Identifier: MIT
// The worker with Python in it. It loads at the first question; a load that failed (no network, no memory) is tried again at the next.

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

/** Pyodide fetches its .wasm by a name of its own. It gets ours, packed for hosts that do not pack what they send. */
function handOver(wasm: Response): () => void {
  const { fetch } = self;
  self.fetch = (what, options) => (String(what).endsWith('/pyodide.asm.wasm') ? Promise.resolve(wasm) : fetch(what, options));
  return () => { self.fetch = fetch; };
}

async function load({ wasmUrl, libraryUrl }: PythonParts): Promise<FileFormats> {
  const packed = await get(wasmUrl);
  const stream = packed.body?.pipeThrough(new DecompressionStream('gzip'));
  const takeBack = handOver(new Response(stream, { headers: { 'Content-Type': 'application/wasm' } }));
  try {
    const python = await loadPyodide({ createPyodideModule, stdLibURL: libraryUrl, indexURL: new URL('./', self.location.href).href, lockFileContents: LOCK });
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
    return { kind: 'trouble', id: question.id, text: error instanceof Error ? error.message : String(error) };
  }
}

self.onmessage = ({ data }: MessageEvent<ToFiles>) => {
  switch (data.kind) {
    case 'parts': parts = data.parts; return;
    case 'question': turn = turn.then(async () => self.postMessage(await answer(data))); return;
    default: data satisfies never;
  }
};
