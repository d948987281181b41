// SPDX-License-Identifier: MIT
// motion.wasm, the motion library and the robot's body for tests in Node.

import { readFile } from 'node:fs/promises';
import type { Body } from '../model/body.ts';
import { makeEdits } from '../model/edit.ts';
import { documentFrom } from '../model/document.ts';
import type { MotionDocument } from '../model/document.ts';
import { Motion } from '../model/motion.ts';
import type { MotionExports } from '../model/motion.ts';
import { PageFormat } from '../model/page-format.ts';
import type { Result } from '../model/result.ts';
import { robotImages, wasmModule } from './robot-bench.ts';

export const BODY = JSON.parse(await readFile(new URL('../../../build/wasm/body.json', import.meta.url), 'utf8')) as Body;

export async function makeMotion(): Promise<Motion> {
    const instance = await WebAssembly.instantiate(await wasmModule('motion'), {});
    return new Motion(instance.exports as unknown as MotionExports);
}

export async function libraryDocument(name = 'library'): Promise<MotionDocument> {
    return documentFrom((await robotImages('play')).motions, name);
}

export async function makeFormat() {
    const format = new PageFormat(await makeMotion());
    return { format, edits: makeEdits(format) };
}

/** Returns the value or throws the refusal. */
export function must<T>(result: Result<T>): T {
    if (!result.ok) throw new Error(`refused: ${result.refusal.code} ${result.refusal.words}`);
    return result.value;
}

/** The refusal's code; '' if nothing was refused. */
export function refusalOf(result: Result<unknown>): string {
    return result.ok ? '' : result.refusal.code;
}
