// SPDX-License-Identifier: MIT
// How many times faster than real time board.wasm walks in Node, without and with MuJoCo.
import { readFile } from 'node:fs/promises';
import type { Body } from '../../model/body.ts';
import { CYCLES_PER_MS } from '../../sim/board.ts';
import { makeMachine } from '../../sim/machine.ts';
import { makeMujoco } from '../../sim/mujoco.ts';
import { PhysicalBody } from '../../sim/physical-body.ts';
import { Simulation } from '../../sim/simulation.ts';
import { robotImages, wasmModule } from '../robot-bench.ts';

const SECONDS = 20;
const build = new URL('../../../../build/', import.meta.url);
const body = JSON.parse(await readFile(new URL('wasm/body.json', build), 'utf8')) as Body;

async function walk(withBody: boolean): Promise<void> {
    const simulation = new Simulation(await makeMachine(await wasmModule('board'), await robotImages('play'), null), body);
    simulation.board.setPower(true);
    if (withBody) {
        const wasm = await readFile(new URL('../../node_modules/@mujoco/mujoco/mujoco.wasm', import.meta.url));
        const mujoco = await makeMujoco(wasm.buffer.slice(wasm.byteOffset, wasm.byteOffset + wasm.byteLength));
        simulation.setPhysical(new PhysicalBody(mujoco, await readFile(new URL('wasm/body.xml', build), 'utf8'), body));
    }
    const run = (ms: number): boolean => simulation.runTo(simulation.board.nowCycles + ms * CYCLES_PER_MS);
    run(3000);
    simulation.board.send('pc', new TextEncoder().encode('@play 20\r'));
    run(4000);
    simulation.setHeld(false);
    const start = process.cpuUsage();
    run(SECONDS * 1000);
    const used = process.cpuUsage(start);
    const ratio = (SECONDS * 1e6) / (used.user + used.system);
    console.log(
        `walking, board.wasm in Node, ${withBody ? 'body in MuJoCo' : 'no body       '}  ${ratio.toFixed(1).padStart(6)} x real time`,
    );
}

await walk(false);
await walk(true);
