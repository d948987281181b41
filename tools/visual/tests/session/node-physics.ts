// SPDX-License-Identifier: MIT
// node node-physics.ts BUILD SCENARIOS.json: prints the result of each scenario as one line of JSON. See test_same_physics.py.
import { readFile } from 'node:fs/promises';
import type { Body } from '../../model/body.ts';
import { heading } from '../../model/space.ts';
import { CYCLES_PER_TICK } from '../../sim/board.ts';
import { makeMachine } from '../../sim/machine.ts';
import { makeMujoco } from '../../sim/mujoco.ts';
import { PhysicalBody } from '../../sim/physical-body.ts';
import { Simulation } from '../../sim/simulation.ts';

interface Scenario {
    readonly seed: number;
    readonly page: number;
    readonly approachTicks: number;
    readonly ticks: number;
    readonly send: readonly (readonly [number, string])[];
}

const [build, scenarios] = process.argv.slice(2);
if (!build || !scenarios) throw new Error('usage: node-physics.ts BUILD SCENARIOS.json');
const read = (name: string): Promise<string> => readFile(`${build}/${name}`, 'utf8');
const module = await WebAssembly.compile(await readFile(`${build}/wasm/board.wasm`));
const body = JSON.parse(await read('wasm/body.json')) as Body;
const xml = await read('wasm/body.xml');
const images = {
    boot: await read('firmware/boot-cm5.hex'),
    application: await read('firmware/play-cm5.hex'),
    motions: new Uint8Array(await readFile(`${build}/motions/motions.bin`)),
};
const wasm = await readFile(new URL('../../node_modules/@mujoco/mujoco/mujoco.wasm', import.meta.url));
const mujoco = await makeMujoco(wasm.buffer.slice(wasm.byteOffset, wasm.byteOffset + wasm.byteLength));

async function run(scenario: Scenario) {
    const board = await makeMachine(module, images, null, scenario.seed);
    const simulation = new Simulation(board, body);
    const to = (tick: number): boolean => simulation.runTo(tick * CYCLES_PER_TICK);
    const type = (text: string): void => board.send('pc', new TextEncoder().encode(text));
    board.setPower(true);
    to(3 * 128);
    type(`@play ${scenario.page}\r`);
    to(3 * 128 + scenario.approachTicks);
    simulation.setPhysical(new PhysicalBody(mujoco, xml, body), false);
    const begun = simulation.state(0).trunk;
    const start = 3 * 128 + scenario.approachTicks;
    let hasFallen = false;
    for (let tick = 1; tick <= scenario.ticks; tick++) {
        for (const [at, text] of scenario.send) if (at === tick) type(text);
        to(start + tick);
        hasFallen ||= simulation.hasFallen;
    }
    const { trunk } = simulation.state(0);
    const from = (i: 0 | 1): number => 1000 * (trunk.pos[i] - begun.pos[i]);
    return { x: from(0), y: from(1), heading: (heading(trunk.quat) * 180) / Math.PI, fallen: hasFallen, height: 1000 * trunk.pos[2] };
}

const results = [];
for (const scenario of JSON.parse(await readFile(scenarios, 'utf8')) as Scenario[]) results.push(await run(scenario));
console.log(JSON.stringify(results));
