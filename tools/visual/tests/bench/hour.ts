// SPDX-License-Identifier: MIT
// node hour.ts [MINUTES]: walks for this long with board and body, as the worker runs them. Memory and console output must not grow. Exits
// with 1 if they do. tools/visual/bench hour
import { readFile } from 'node:fs/promises';
import type { Body } from '../../model/body.ts';
import { CYCLES_PER_TICK } from '../../sim/board.ts';
import { makeMachine } from '../../sim/machine.ts';
import { makeMujoco } from '../../sim/mujoco.ts';
import { PhysicalBody } from '../../sim/physical-body.ts';
import { Simulation } from '../../sim/simulation.ts';
import { robotImages, wasmModule } from '../robot-bench.ts';

const minutes = Number(process.argv[2] ?? 60);
const MOST_GROWTH = 8 << 20;
const build = new URL('../../../../build/', import.meta.url);
const body = JSON.parse(await readFile(new URL('wasm/body.json', build), 'utf8')) as Body;
const wasm = await readFile(new URL('../../node_modules/@mujoco/mujoco/mujoco.wasm', import.meta.url));
const mujoco = await makeMujoco(wasm.buffer.slice(wasm.byteOffset, wasm.byteOffset + wasm.byteLength));
const simulation = new Simulation(await makeMachine(await wasmModule('board'), await robotImages('play'), null), body);
simulation.board.setPower(true);
simulation.setPhysical(new PhysicalBody(mujoco, await readFile(new URL('wasm/body.xml', build), 'utf8'), body));

let heard = 0;
function run(ticks: number): void {
    for (let tick = 0; tick < ticks; tick += 2) {
        if (!simulation.runTo(simulation.board.nowCycles + 2 * CYCLES_PER_TICK)) throw new Error(simulation.board.violation?.text);
        heard += simulation.board.receive().length;
        simulation.state(0);
    }
}

/** Memory of the process after a garbage collection, as far as available. Bytes. */
function memory(): number {
    (globalThis as { gc?: () => void }).gc?.();
    const { heapUsed, external, arrayBuffers } = process.memoryUsage();
    return heapUsed + external + arrayBuffers;
}

run(3 * 128);
simulation.board.send('pc', new TextEncoder().encode('@play 20\r'));
run(20 * 128);
const before = memory();
for (let minute = 1; minute <= minutes; minute++) run(60 * 128);
const grown = memory() - before;
console.log(
    `${minutes} minutes of walking: memory ${(before / 2 ** 20).toFixed(1)} MB, grown by ${(grown / 2 ** 20).toFixed(2)} MB; ${heard} bytes heard, ${simulation.board.waiting} waiting`,
);
if (grown > MOST_GROWTH || simulation.board.waiting > 0 || heard === 0) process.exit(1);
