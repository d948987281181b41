// SPDX-License-Identifier: MIT
// Runs trials in Node: trial.wasm with a body in MuJoCo.

import { readFile } from 'node:fs/promises';
import type { Body } from '../model/body.ts';
import type { TrialRecord, TrialRequest } from '../model/trial.ts';
import { makeMujoco } from '../sim/mujoco.ts';
import { PhysicalBody } from '../sim/physical-body.ts';
import { TrialStand } from '../sim/trial.ts';
import { wasmModule } from './robot-bench.ts';

const BUILD = new URL('../../../build/wasm/', import.meta.url);

export interface TrialBench {
    readonly body: Body;
    readonly stand: TrialStand;
    /** For single poses. */
    readonly posed: PhysicalBody;
}

export async function trialBench(): Promise<TrialBench> {
    const bytes = await readFile(new URL('../node_modules/@mujoco/mujoco/mujoco.wasm', import.meta.url));
    const mujoco = await makeMujoco(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
    const [xml, json] = await Promise.all([readFile(new URL('body.xml', BUILD), 'utf8'), readFile(new URL('body.json', BUILD), 'utf8')]);
    const body = JSON.parse(json) as Body;
    const stand = await TrialStand.make(await wasmModule('trial'), body, new PhysicalBody(mujoco, xml, body));
    return { body, stand, posed: new PhysicalBody(mujoco, xml, body) };
}

export function played(stand: TrialStand, request: TrialRequest): TrialRecord {
    const play = stand.play(request);
    for (;;) {
        const { done, value } = play.next();
        if (done) return value;
    }
}
