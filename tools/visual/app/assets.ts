// SPDX-License-Identifier: MIT
// The files next to the page: WebAssembly, images, motions, body. Their addresses are relative, so the folder works anywhere. Each file is
// fetched once.

import boardUrl from '../../../build/wasm/board.wasm?url';
import bodyXmlUrl from '../../../build/wasm/body.xml?url';
import motionUrl from '../../../build/wasm/motion.wasm?url';
import mujocoUrl from '../../../build/wasm/mujoco.wasm.gz?url';
import bootUrl from '../../../build/firmware/boot-cm5.hex?url';
import editUrl from '../../../build/firmware/edit-cm5.hex?url';
import playUrl from '../../../build/firmware/play-cm5.hex?url';
import pythonWasmUrl from '../../../build/wasm/pyodide.wasm.gz?url';
import pythonLibraryUrl from '../../../build/wasm/python.zip?url';
import servosEditUrl from '../../../build/wasm/servos-edit.wasm?url';
import servosPlayUrl from '../../../build/wasm/servos-play.wasm?url';
import trialUrl from '../../../build/wasm/trial.wasm?url';
import motionsUrl from '../../../build/motions/motions.bin?url';
import bodyUrl from '../../../build/wasm/body.json?url';
import { FormatsClient } from '../files/formats-client.ts';
import type { FormatsWorker } from '../model/file-formats.ts';
import type { Body } from '../model/body.ts';
import { Motion } from '../model/motion.ts';
import type { MotionExports } from '../model/motion.ts';
import type { Images } from '../sim/machine.ts';
import { TrialClient } from '../sim/trial-client.ts';
import { FileGone } from './image-error.ts';

/** A stalled connection, for example at the edge of a wireless network, must not block for ever. */
const FIRMWARE_MS = 120_000;

async function get(url: string, signal: AbortSignal | null = null): Promise<Response> {
    const response = await fetch(url, { signal });
    const trouble = `${url.split('/').at(-1)} could not be loaded (${response.status})`;
    if (response.status === 404) throw new FileGone(trouble);
    if (!response.ok) throw new Error(trouble);
    return response;
}

export async function robotBody(): Promise<Body> {
    const body: unknown = await (await get(bodyUrl)).json();
    return body as Body; // made by body_files.py; tests/body.test.ts checks its shape
}

export async function boardModule(): Promise<WebAssembly.Module> {
    return WebAssembly.compile(await (await get(boardUrl)).arrayBuffer());
}

/** Play or Edit as a program for servos. Rejects when it does not come within two minutes. */
export async function servosModule(image: 'play' | 'edit'): Promise<WebAssembly.Module> {
    const signal = AbortSignal.timeout(FIRMWARE_MS);
    return WebAssembly.compile(await (await get(image === 'play' ? servosPlayUrl : servosEditUrl, signal)).arrayBuffer());
}

/** An instance of motion.wasm for one owner. */
export async function motionInstance(): Promise<Motion> {
    const { instance } = await WebAssembly.instantiate(await (await get(motionUrl)).arrayBuffer());
    return new Motion(instance.exports as unknown as MotionExports); // made by board/motion_api.c
}

/** The motion library in a factory-new robot, 65,536 bytes. */
export async function motionLibrary(): Promise<Uint8Array> {
    return new Uint8Array(await (await get(motionsUrl)).arrayBuffer());
}

/** Rejects when a file does not come within two minutes. */
export async function robotImages(image: 'play' | 'edit'): Promise<Images> {
    const signal = AbortSignal.timeout(FIRMWARE_MS);
    const [boot, application, motions] = await Promise.all([
        get(bootUrl, signal).then(r => r.text()),
        get(image === 'play' ? playUrl : editUrl, signal).then(r => r.text()),
        get(motionsUrl, signal).then(r => r.arrayBuffer()),
    ]);
    return { boot, application, motions: new Uint8Array(motions) };
}

/** 2.5 MB. It is packed at build time, because the host may not compress at all. */
export async function physics(): Promise<{ bodyXml: string; wasm: ArrayBuffer }> {
    const [bodyXml, packed] = await Promise.all([get(bodyXmlUrl).then(r => r.text()), get(mujocoUrl)]);
    const stream = packed.body?.pipeThrough(new DecompressionStream('gzip'));
    return { bodyXml, wasm: await new Response(stream).arrayBuffer() };
}

/** A worker for trials with its own MuJoCo. */
export async function trialClient(body: Body): Promise<TrialClient> {
    const [{ bodyXml, wasm }, module] = await Promise.all([
        physics(),
        get(trialUrl)
            .then(r => r.arrayBuffer())
            .then(bytes => WebAssembly.compile(bytes)),
    ]);
    const worker = new Worker(new URL('../sim/trial-worker.ts', import.meta.url), { type: 'module', name: 'trials' });
    return new TrialClient(worker, { module, wasm, bodyXml, body });
}

/** Reads and writes motion files. Python (5 MB) is loaded with the first one. */
export function fileFormats(): FormatsWorker {
    const parts = { wasmUrl: new URL(pythonWasmUrl, document.baseURI).href, libraryUrl: new URL(pythonLibraryUrl, document.baseURI).href };
    return new FormatsClient(parts, () => new Worker(new URL('../files/worker.ts', import.meta.url), { type: 'module', name: 'files' }));
}
