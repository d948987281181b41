// SPDX-License-Identifier: MIT
// node start/record.ts BUILD OUTPUT: plays the motions of the start page with the firmware on the simulated board and the body in physics,
// and writes the places of the links. The start page's pictures are drawn from them.
import { readFile, writeFile } from 'node:fs/promises';
import { jointAngle, placeLinks } from '../model/body.ts';
import type { Body } from '../model/body.ts';
import { documentFrom } from '../model/document.ts';
import { Motion } from '../model/motion.ts';
import type { MotionExports } from '../model/motion.ts';
import { PageFormat } from '../model/page-format.ts';
import { readPage } from '../model/page.ts';
import { CYCLES_PER_TICK } from '../sim/board.ts';
import { makeMachine } from '../sim/machine.ts';
import { makeMujoco } from '../sim/mujoco.ts';
import { PhysicalBody } from '../sim/physical-body.ts';
import { Simulation } from '../sim/simulation.ts';
import { START_MOTIONS } from './motions.ts';
import type { StartMotion } from './motions.ts';
import { outline } from './outline.ts';
import type { Outline } from './outline.ts';

const TICKS_PER_SECOND = 128;
const FRAME_TICKS = 10;
const READY_PAGE = 1;
const BOOT_S = 3;
const READY_S = 3;
/** The same as the page's own push (view/push.ts). */
const PUSH = { reachM: 0.2, chestM: 0.03, ticks: 38 };
const FALL_S = 2.5;
/** The motion has ended when nothing has moved for this long. */
const STILL_FRAMES = 6;
const STILL_UNITS = 1;

const [build, output] = process.argv.slice(2);
if (!build || !output) throw new Error('usage: record.ts BUILD OUTPUT');
const read = (name: string): Promise<string> => readFile(`${build}/${name}`, 'utf8');
const compiled = async (name: string): Promise<WebAssembly.Module> => WebAssembly.compile(await readFile(`${build}/wasm/${name}.wasm`));
const body = JSON.parse(await read('wasm/body.json')) as Body; // made by body_files.py
const xml = await read('wasm/body.xml');
const motions = new Uint8Array(await readFile(`${build}/motions/motions.bin`));
const images = { boot: await read('firmware/boot-cm5.hex'), application: await read('firmware/play-cm5.hex'), motions };
const board = await compiled('board');
const { exports } = await WebAssembly.instantiate(await compiled('motion'), {});
const format = new PageFormat(new Motion(exports as unknown as MotionExports)); // made by board/motion_api.c
const library = documentFrom(motions, '');
const wasm = await readFile(new URL('../node_modules/@mujoco/mujoco/mujoco.wasm', import.meta.url));
const mujoco = await makeMujoco(wasm.buffer.slice(wasm.byteOffset, wasm.byteOffset + wasm.byteLength) as ArrayBuffer);

function pageNumber(name: string): number {
    const page = library.pages.findIndex((bytes, number) => number > 0 && !format.isEmpty(bytes) && readPage(format, bytes).name === name);
    if (page < 1) throw new Error(`start page: the library has no motion "${name}"`);
    return page;
}

/** Starts a robot that stands in the room by itself. */
async function standing(): Promise<{ simulation: Simulation; type: (text: string) => void; pass: (seconds: number) => void }> {
    const machine = await makeMachine(board, images, null);
    const simulation = new Simulation(machine, body);
    let ticks = 0;
    const pass = (seconds: number): void => {
        ticks += Math.round(seconds * TICKS_PER_SECOND);
        simulation.runTo(ticks * CYCLES_PER_TICK);
    };
    const type = (text: string): void => machine.send('pc', new TextEncoder().encode(`${text}\r`));
    machine.setPower(true);
    pass(BOOT_S);
    type(`@play ${READY_PAGE}`);
    pass(READY_S);
    simulation.setPhysical(new PhysicalBody(mujoco, xml, body), false);
    pass(0.5);
    return { simulation, type, pass };
}

async function record(motion: StartMotion): Promise<Outline[]> {
    const { simulation, type, pass } = await standing();
    if (motion.lies) {
        const [x, y, z] = simulation.state(0).trunk.pos;
        const target = [x + PUSH.reachM, y, z + PUSH.chestM] as const;
        simulation.setGrip({ link: body.links[0]?.name ?? '', point: [0, 0, PUSH.chestM], target }, PUSH.ticks);
        pass(FALL_S);
    }
    type(`@play ${pageNumber(motion.name)}`);
    pass(motion.fromSeconds);
    const frames: Outline[] = [];
    let before: readonly number[] = [];
    let still = 0;
    for (let frame = 0; frame * FRAME_TICKS < motion.seconds * TICKS_PER_SECOND && still < STILL_FRAMES; frame++) {
        const { servos, trunk } = simulation.state(0);
        const positions = new Map(servos.map(({ id, position }) => [id, position]));
        frames.push(outline(placeLinks(body, trunk, joint => jointAngle(joint, positions.get(joint.servo) ?? joint.zero))));
        const now = servos.map(({ position }) => position);
        const isStill =
            frame > TICKS_PER_SECOND / FRAME_TICKS && now.every((position, i) => Math.abs(position - (before[i] ?? 0)) <= STILL_UNITS);
        still = isStill ? still + 1 : 0;
        before = now;
        pass(FRAME_TICKS / TICKS_PER_SECOND);
    }
    return frames;
}

const recorded: Record<string, Outline[]> = {};
for (const motion of START_MOTIONS) recorded[motion.name] = await record(motion);
await writeFile(output, JSON.stringify(recorded));
