// SPDX-License-Identifier: MIT
// A hand stands the robot in the page up and always lets go: in real physics, with the real firmware, in its own worker.
import { readFile } from 'node:fs/promises';
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { SimulatedSource } from '../app/simulated-source.ts';
import type { Body } from '../model/body.ts';
import { askWhere } from '../robot/protocol.ts';
import { remotePacket } from '../robot/remote.ts';
import type { RobotState } from '../robot/robot-state.ts';
import { NodeWorker } from './node-worker.ts';
import * as bench from './robot-bench.ts';

const factory = vi.hoisted(() => ({ isPageDamaged: false }));
const BUILD = new URL('../../../build/wasm/', import.meta.url);

vi.mock('../app/assets.ts', () => ({
    boardModule: () => bench.wasmModule('board'),
    robotImages: async (image: 'play' | 'edit') => {
        const images = await bench.robotImages(image);
        if (factory.isPageDamaged) images.motions.fill(7, 512 + 80, 512 + 90); // page 1, the standing pose
        return images;
    },
    motionLibrary: async () => (await bench.robotImages('play')).motions,
    physics: async () => {
        const wasm = await readFile(new URL('../node_modules/@mujoco/mujoco/mujoco.wasm', import.meta.url));
        return {
            bodyXml: await readFile(new URL('body.xml', BUILD), 'utf8'),
            wasm: wasm.buffer.slice(wasm.byteOffset, wasm.byteOffset + wasm.byteLength),
        };
    },
}));
vi.mock('../view/robot-store.ts', () => ({
    loadRobot: () => Promise.resolve(null),
    saveRobot: () => Promise.resolve(),
    forgetRobot: () => Promise.resolve(),
}));

const BODY = JSON.parse(await readFile(new URL('body.json', BUILD), 'utf8')) as Body;
/** The pages that a started walk continues with by itself: tools/motions/README.md. */
const WALK = [20, 21, 22];
const SOON = { timeout: 240_000, interval: 20 };

beforeEach(() => {
    vi.stubGlobal('Worker', NodeWorker);
    factory.isPageDamaged = false;
});
afterEach(() => {
    for (const worker of NodeWorker.alive) worker.terminate();
    vi.unstubAllGlobals();
});

/** Play runs and a hand holds the robot, as after every start. */
async function held() {
    let frame: RobotState | null = null;
    const source = new SimulatedSource(BODY, {
        frame: state => (frame = state),
        text: () => undefined,
        connection: () => undefined,
        change: () => undefined,
        motions: () => undefined,
        backUp: () => Promise.resolve(),
    });
    await source.start('play');
    await vi.waitFor(() => expect(source.connection?.version?.image).toBe('play'), SOON);
    await vi.waitFor(() => expect(frame?.isHeld).toBe(true), SOON);
    const where = () => {
        if (!source.connection) throw new Error('no robot');
        return askWhere(source.connection.requests);
    };
    return { source, where, isHeld: () => (frame as RobotState | null)?.isHeld };
}

test('a walk that somebody started in the air begins anew on the floor', async () => {
    const { source, where, isHeld } = await held();
    source.post({ kind: 'bytes', sender: 'remote', bytes: remotePacket(['up']) });
    await vi.waitFor(async () => expect((await where()).state).toBe('playing'), SOON);
    await source.prepare();
    expect(isHeld()).toBe(false);
    const now = await where();
    expect(now.state).toMatch(/ready|approach|playing/);
    expect(WALK).toContain(now.page);
}, 300_000);

test('put on its feet again behind the first time: the next motion has it let go again', async () => {
    const { source, isHeld } = await held();
    await source.prepare();
    expect(isHeld()).toBe(false);
    source.post({ kind: 'hold', held: true });
    await vi.waitFor(() => expect(isHeld()).toBe(true), SOON);
    await source.prepare();
    expect(isHeld()).toBe(false);
}, 300_000);

test('a robot that refuses its standing pose is let go all the same', async () => {
    factory.isPageDamaged = true;
    const { source, isHeld } = await held();
    await expect(source.prepare()).rejects.toMatchObject({ code: 'refused' });
    await vi.waitFor(() => expect(isHeld()).toBe(false), SOON);
}, 300_000);
