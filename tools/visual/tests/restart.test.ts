// SPDX-License-Identifier: MIT
// Restarts of the robot in the page: pressed twice, before it was there, after a crash, without a network. Worker, board and firmware are
// real; files and the browser's storage are fakes.
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { SimulatedSource } from '../app/simulated-source.ts';
import { RobotTransfer } from '../app/transfer.ts';
import { pageOf } from '../model/document.ts';
import { MOTIONS_ADDRESS } from '../sim/board.ts';
import { SimulatedRobot } from '../sim/robot-client.ts';
import type { ToSim } from '../sim/messages.ts';
import type { SessionState } from '../view/session/session.ts';
import type { KeptRobot } from '../view/robot-store.ts';
import { BODY, libraryDocument, makeFormat } from './motion-bench.ts';
import { NodeWorker } from './node-worker.ts';
import * as bench from './robot-bench.ts';

const files = vi.hoisted(() => ({ missing: '', broken: '', physics: () => Promise.reject(new Error('not here')) }));
const browser = vi.hoisted(() => ({ keeps: true, kept: null as KeptRobot | null }));

vi.mock('../app/assets.ts', () => ({
    boardModule: () => bench.wasmModule('board'),
    robotImages: async (image: 'play' | 'edit') => {
        if (files.missing === image) throw new TypeError('Failed to fetch');
        const images = await bench.robotImages(image);
        return files.broken === image ? { ...images, application: 'no HEX' } : images;
    },
    motionLibrary: async () => (await bench.robotImages('play')).motions,
    physics: () => files.physics(),
}));
vi.mock('../view/robot-store.ts', () => {
    const tried = async (): Promise<void> => {
        if (!browser.keeps) throw new DOMException('private window', 'InvalidStateError');
    };
    return {
        loadRobot: () => tried().then(() => browser.kept),
        saveRobot: async (_: string, robot: KeptRobot) => {
            await tried();
            browser.kept = robot;
        },
        forgetRobot: async () => {
            await tried();
            browser.kept = null;
        },
    };
});

beforeEach(() => {
    vi.stubGlobal('Worker', NodeWorker);
    const request = (_: string, __: object, use: (lock: object) => unknown) => Promise.resolve(use({}));
    vi.stubGlobal('navigator', { locks: { request } }); // the robot of the test before is no other tab's
    Object.assign(files, { missing: '', broken: '' });
    Object.assign(browser, { keeps: true, kept: null });
});
afterEach(() => {
    for (const worker of NodeWorker.alive) worker.terminate();
    vi.unstubAllGlobals();
});

function page() {
    const seen = {
        stopped: null as string | null,
        motions: new Uint8Array(),
        connections: [] as string[],
        changes: [] as Partial<SessionState>[],
    };
    const source = new SimulatedSource(BODY, {
        frame: () => undefined,
        text: () => undefined,
        connection: state => seen.connections.push(state),
        change: change => {
            seen.changes.push(change);
            if (change.stopped !== undefined) seen.stopped = change.stopped;
        },
        motions: image => (seen.motions = Uint8Array.from(image)),
        backUp: () => Promise.resolve(),
    });
    return { source, seen };
}

/** Waits until this image answers. */
async function runs(source: SimulatedSource, image: string): Promise<void> {
    await vi.waitFor(() => expect(source.connection?.version?.image).toBe(image), { timeout: 240_000, interval: 20 });
}

test('what is asked of a robot that is still being made is answered when it is there', async () => {
    const worker = new NodeWorker(new URL('../sim/worker.ts', import.meta.url));
    const robot = new SimulatedRobot(worker as unknown as Worker, { message: () => undefined });
    const images = await bench.robotImages('play');
    robot.post({ kind: 'start', module: await bench.wasmModule('board'), body: BODY, images, kept: null });
    const { flash } = await robot.memories();
    expect(flash.slice(MOTIONS_ADDRESS, MOTIONS_ADDRESS + images.motions.length)).toEqual(images.motions);
});

test('pressed again before the robot is there, and again: the last one runs, and it is the only one', async () => {
    const { source } = page();
    const done = Promise.all([source.start('play'), source.restart('edit'), source.restart('play'), source.restart('edit')]);
    await done;
    await runs(source, 'edit');
    expect(NodeWorker.alive.size).toBe(1);
    await source.restart('play');
    await runs(source, 'play');
    expect(NodeWorker.alive.size).toBe(1);
});

test('an image that cannot be loaded: the robot goes on as it was, and the next try is one', async () => {
    const { source, seen } = page();
    await source.start('play');
    await runs(source, 'play');
    seen.connections.length = 0;
    files.missing = 'edit';
    await expect(source.restart('edit')).rejects.toThrow('Failed to fetch');
    await expect(source.forget('edit')).rejects.toThrow('Failed to fetch');
    expect(seen.connections).toEqual([]);
    expect(source.connection?.state).toBe('ready');
    expect(source.image).toBe('play');
    files.missing = '';
    await source.restart('edit');
    await runs(source, 'edit');
});

test('after a crash the next robot starts, with what was kept', async () => {
    const { source, seen } = page();
    files.broken = 'edit';
    browser.kept = { flash: new Uint8Array(0x20000).fill(0x5a), eeprom: new Uint8Array(4096).fill(0xff), servos: new Uint8Array() };
    await source.start('edit');
    await vi.waitFor(() => expect(seen.stopped).toContain('crashed'), { timeout: 240_000 });
    await source.restart('play');
    expect(seen.stopped).toBeNull(); // by then, so that who waits for the new robot does not see the old one's end
    await vi.waitFor(() => expect(seen.changes.some(({ faultNames }) => faultNames)).toBe(true), { timeout: 240_000 }); // it has started
    expect(seen.stopped).toBeNull();
    expect(seen.motions.every(byte => byte === 0x5a)).toBe(true);
});

test('from the first word that a motion is written until the browser has stored it, leaving the page would lose it, and the page knows', async () => {
    const { source, seen } = page();
    await source.start('edit');
    await runs(source, 'edit');
    const { format } = await makeFormat();
    const library = await libraryDocument();
    const [bow, free] = [pageOf(library, 2), 100];
    let robot: readonly (Uint8Array | null)[] = library.pages;
    const transfer = new RobotTransfer({
        format,
        document: () => ({ ...library, pages: library.pages.with(free, bow) }),
        robot: () => robot,
        setRobot: pages => (robot = pages),
        requests: () => {
            if (!source.connection) throw new Error('no robot');
            return source.connection.requests;
        },
        becomeEdit: () => Promise.resolve(),
        backUp: () => Promise.resolve(),
    });
    const isUnkept = (): boolean => seen.changes.findLast(({ hasUnkept }) => hasUnkept !== undefined)?.hasUnkept ?? false;
    const isKept = (): boolean => browser.kept?.flash[MOTIONS_ADDRESS + free * 512] === bow[0];
    const safe: boolean[] = [];
    transfer.state.watch(({ account }) => {
        if (['written', 'verified'].includes(account.get(free) ?? '')) safe.push(isUnkept() || isKept());
    });
    expect(await transfer.write([free])).toEqual({ isDone: true });
    expect(safe.length).toBeGreaterThan(1);
    expect(safe).not.toContain(false);
    await vi.waitFor(() => expect([isUnkept(), isKept()]).toEqual([false, true]), { timeout: 240_000 });
}, 240_000);

test('a browser that keeps nothing: another image has the motions of the one before', async () => {
    const { source, seen } = page();
    const flash = new Uint8Array(0x20000).fill(0xff);
    flash[MOTIONS_ADDRESS + 5000] = 0x77;
    browser.kept = { flash, eeprom: new Uint8Array(4096).fill(0xff), servos: new Uint8Array() };
    await source.start('play');
    browser.keeps = false;
    await source.restart('edit');
    expect(seen.motions[5000]).toBe(0x77);
});

test('what is stored cannot be read: it is not replaced by the memory of a new robot', async () => {
    const { source, seen } = page();
    browser.keeps = false;
    const kept = { flash: new Uint8Array(0x20000).fill(0x5a), eeprom: new Uint8Array(4096), servos: new Uint8Array() };
    browser.kept = kept;
    await source.start('play');
    browser.keeps = true; // the disk answers again
    const told = seen.changes.length;
    await source.restart('edit'); // which stores the robot's memory
    expect(browser.kept === kept).toBe(true);
    expect(seen.changes.slice(told).some(({ message }) => message?.text.startsWith('This browser does not save'))).toBe(true);
});

test('the next robot stands on the floor that the page shows, with its battery and its faults', async () => {
    const { source } = page();
    const posted: ToSim[] = [];
    const post = vi.spyOn(SimulatedRobot.prototype, 'post').mockImplementation(message => void posted.push(message));
    await source.start('play');
    source.post({ kind: 'floor', floor: { tiltFront: 0.1, tiltLeft: 0, friction: 0.8 } });
    source.post({ kind: 'floor', floor: { tiltFront: 0.2, tiltLeft: 0, friction: 0.8 } });
    source.post({ kind: 'battery', volts: 7 });
    source.post({ kind: 'fault', servo: 3, fault: 0, answers: -1 });
    source.post({ kind: 'fault', servo: 3, fault: 1, answers: 0 });
    vi.spyOn(SimulatedRobot.prototype, 'memories').mockRejectedValue(new Error('not needed here'));
    posted.length = 0;
    await source.restart('edit');
    const room = posted.filter(({ kind }) => ['floor', 'battery', 'fault'].includes(kind));
    expect(room).toEqual([
        { kind: 'floor', floor: { tiltFront: 0.2, tiltLeft: 0, friction: 0.8 } },
        { kind: 'battery', volts: 7 },
        { kind: 'fault', servo: 3, fault: 0, answers: -1 },
        { kind: 'fault', servo: 3, fault: 1, answers: 0 },
    ]);
    expect(post).toHaveBeenCalled();
    vi.restoreAllMocks();
});

test('a restart that ends while another robot is used tells nothing of itself, until it is used again', async () => {
    const { source, seen } = page();
    await source.start('play');
    files.broken = 'edit';
    seen.changes.length = 0;
    const restarted = source.restart('edit');
    source.pause(); // another robot is chosen meanwhile
    await restarted;
    await new Promise(resolve => setTimeout(resolve, 3000));
    const told = seen.changes.flatMap(change => Object.keys(change));
    expect(told).not.toEqual(expect.arrayContaining(['version']));
    expect(told).not.toEqual(expect.arrayContaining(['where']));
    expect(told).not.toEqual(expect.arrayContaining(['stopped']));
    expect(told).not.toEqual(expect.arrayContaining(['doing']));
    source.resume();
    await vi.waitFor(() => expect(seen.stopped).toContain('crashed'), { timeout: 240_000 });
});

test('who waits for the robot to stand up does not wait for one that was restarted or has crashed', async () => {
    const { source, seen } = page();
    const post = vi.spyOn(SimulatedRobot.prototype, 'post').mockReturnValue(undefined); // it never answers
    await source.start('play');
    const standing = source.prepare();
    vi.spyOn(SimulatedRobot.prototype, 'memories').mockRejectedValue(new Error('not needed here'));
    files.broken = 'edit';
    post.mockRestore();
    void source.restart('edit');
    await expect(standing).rejects.toMatchObject({ code: 'cancelled' });
    await vi.waitFor(() => expect(seen.changes.some(({ physics }) => physics === 'off')).toBe(true));
    const next = source.prepare();
    await expect(next).rejects.toMatchObject({ code: 'no-answer' });
    await expect(source.prepare()).rejects.toMatchObject({ code: 'no-answer' });
    vi.restoreAllMocks();
}, 60_000);

test('physics does not come: after two minutes the robot goes on without, and what comes later is used; that of a robot before is not waited for', async () => {
    vi.useFakeTimers();
    const { source, seen } = page();
    const posted: string[] = [];
    vi.spyOn(SimulatedRobot.prototype, 'post').mockImplementation(({ kind }) => void posted.push(kind));
    vi.spyOn(SimulatedRobot.prototype, 'memories').mockRejectedValue(new Error('not needed here'));
    const coming = vi.spyOn(files, 'physics');
    let come = (_: unknown): void => undefined;
    coming.mockImplementation(() => new Promise<never>(resolve => (come = resolve as typeof come)));
    const off = (): number => seen.changes.filter(({ physics }) => physics === 'off').length;
    await source.start('play');
    vi.advanceTimersByTime(60_000);
    await source.restart('edit');
    vi.advanceTimersByTime(119_000);
    expect(off()).toBe(0);
    vi.advanceTimersByTime(2000);
    expect(off()).toBe(1);
    expect(seen.changes.at(-1)?.message?.text).toMatch(/^Physics could not be loaded/);
    come({ bodyXml: '', wasm: new ArrayBuffer(0) });
    await vi.advanceTimersByTimeAsync(1);
    expect(posted).toContain('physics');
    vi.useRealTimers();
    vi.restoreAllMocks();
});
