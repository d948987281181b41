// SPDX-License-Identifier: MIT
// The robot of a second tab: the page says that it is not kept, knows what would be lost, and keeps it when the other tab is closed. What
// the other tab has saved is not lost either. The worker is a script.
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { robotFreed } from '../app/hold-document.ts';
import { SimulatedSource } from '../app/simulated-source.ts';
import { MOTIONS_ADDRESS } from '../sim/board.ts';
import type { FromSim, ToSim } from '../sim/messages.ts';
import type { SessionState } from '../view/session/session.ts';
import type { KeptRobot } from '../view/robot-store.ts';
import { TEXTS } from '../view/texts/texts.ts';
import { BODY } from './motion-bench.ts';

const browser = vi.hoisted(() => ({ kept: null as KeptRobot | null, isFull: false }));

vi.mock('../app/assets.ts', () => ({
    boardModule: () => Promise.resolve(null),
    robotImages: () => Promise.resolve({ boot: '', application: '', motions: new Uint8Array(65_536) }),
    motionLibrary: () => Promise.resolve(new Uint8Array(65_536)),
    physics: () => Promise.reject(new Error('not here')),
}));
vi.mock('../view/robot-store.ts', () => ({
    loadRobot: () => Promise.resolve(browser.kept),
    saveRobot: async (_: string, robot: KeptRobot) => {
        if (browser.isFull) throw new DOMException('no room', 'QuotaExceededError');
        browser.kept = robot;
    },
    forgetRobot: async () => {
        browser.kept = null;
    },
}));

/** Locks as browsers have them, held by other tabs. */
class Locks {
    private readonly held = new Set<string>();
    private readonly waiting: (() => void)[] = [];

    async request(name: string, ...rest: unknown[]): Promise<void> {
        const action = rest.at(-1) as (lock: object | null) => unknown;
        const isAsked = rest.length > 1;
        if (isAsked && this.held.has(name)) return void (await action(null));
        while (this.held.has(name)) await new Promise<void>(resolve => this.waiting.push(resolve));
        this.held.add(name);
        await action({});
        this.free(name);
    }

    hold(name: string): void {
        this.held.add(name);
    }

    free(name: string): void {
        this.held.delete(name);
        for (const next of this.waiting.splice(0)) next();
    }
}

const ROBOT = 'motion512-robot';
let locks: Locks;

beforeEach(() => {
    vi.useFakeTimers();
    locks = new Locks();
    Object.assign(browser, { kept: null, isFull: false });
    vi.stubGlobal('navigator', { locks });
    vi.stubGlobal('Worker', Script);
});
afterEach(() => {
    vi.useRealTimers();
    vi.unstubAllGlobals();
});

/** A robot whose memory is full of one byte. settings: the byte of its EEPROM. */
function memories(byte: number, settings = byte): KeptRobot {
    return { flash: new Uint8Array(0x20000).fill(byte), eeprom: new Uint8Array(4096).fill(settings), servos: new Uint8Array() };
}

/** That byte. */
function byteOf(robot: KeptRobot | null): number | undefined {
    return robot?.flash[MOTIONS_ADDRESS];
}

class Script {
    static last: Script;
    onmessage: ((event: { data: FromSim }) => void) | null = null;
    now = memories(0);
    started: KeptRobot | null = null;

    constructor() {
        Script.last = this;
    }

    postMessage(message: ToSim): void {
        if (message.kind === 'start') this.started = message.kept;
        if (message.kind === 'start') this.now = message.kept ?? this.now;
        if (message.kind === 'memories') setTimeout(() => this.tell({ kind: 'memories', memories: this.now, id: message.id }));
    }

    terminate(): void {
        this.onmessage = null;
    }

    save(byte: number): void {
        this.now = memories(byte);
        this.tell({ kind: 'memories', memories: this.now, id: null });
    }

    tell(data: FromSim): void {
        this.onmessage?.({ data });
    }
}

const MINUTE_MS = 60_000;

async function tab() {
    const seen = { isSecond: false, hasUnkept: false, backups: [] as number[], said: [] as string[] };
    const source = new SimulatedSource(BODY, {
        frame: () => undefined,
        text: () => undefined,
        connection: () => undefined,
        change: (change: Partial<SessionState>) => {
            if (change.isSecond !== undefined) seen.isSecond = change.isSecond;
            if (change.hasUnkept !== undefined) seen.hasUnkept = change.hasUnkept;
            if (change.message && change.message.tone !== 'bad') seen.said.push(change.message.text);
        },
        motions: () => undefined,
        backUp: async image => void seen.backups.push(image[0] ?? -1),
    });
    await source.start('play');
    await vi.advanceTimersByTimeAsync(2000);
    return { source, seen, robot: () => Script.last };
}

async function closeOther(): Promise<void> {
    locks.free(ROBOT);
    await vi.advanceTimersByTimeAsync(MINUTE_MS);
}

test('the first tab keeps its robot, and nothing is said of another one', async () => {
    const { seen, robot } = await tab();
    robot().save(5);
    await vi.advanceTimersByTimeAsync(0);
    expect(byteOf(browser.kept)).toBe(5);
    expect(seen).toMatchObject({ isSecond: false, hasUnkept: false, said: [] });
});

test('what the robot writes is unkept before its memory comes; what a robot had not sent before it crashed is gone', async () => {
    const { source, seen, robot } = await tab();
    robot().tell({ kind: 'writes' });
    expect(seen.hasUnkept).toBe(true);
    robot().save(5);
    robot().tell({ kind: 'writes' }); // again, while the disk takes the first
    await vi.advanceTimersByTimeAsync(0);
    expect([byteOf(browser.kept), seen.hasUnkept]).toEqual([5, true]);
    robot().tell({ kind: 'crashed', text: 'out of memory' });
    const restarted = source.restart('play');
    await vi.advanceTimersByTimeAsync(1000);
    await restarted;
    expect([byteOf(robot().started), seen.hasUnkept]).toEqual([5, false]);
    robot().tell({ kind: 'writes' });
    const fresh = source.forget('play');
    await vi.advanceTimersByTimeAsync(1000);
    await fresh;
    expect(seen.hasUnkept).toBe(false);
});

test('a second tab says so before anything is saved; what is saved is known to be lost with the tab; then the other tab is closed', async () => {
    browser.kept = memories(1);
    locks.hold(ROBOT);
    const { seen, robot } = await tab();
    expect(seen).toMatchObject({ isSecond: true, hasUnkept: false });
    robot().save(5);
    await vi.advanceTimersByTimeAsync(MINUTE_MS);
    expect(seen).toMatchObject({ isSecond: true, hasUnkept: true });
    expect(byteOf(browser.kept)).toBe(1);
    await closeOther();
    expect(byteOf(browser.kept)).toBe(5);
    expect(seen).toMatchObject({ isSecond: false, hasUnkept: false, backups: [] });
    expect(seen.said).toHaveLength(1);
});

test('a restart in a second tab that has saved nothing: nothing can be lost', async () => {
    locks.hold(ROBOT);
    const { source, seen } = await tab();
    const restarted = source.restart('edit');
    await vi.advanceTimersByTimeAsync(1000);
    await restarted;
    expect(seen).toMatchObject({ isSecond: true, hasUnkept: false });
});

test('the other tab has saved meanwhile, this one too: its motions become a backup, then this robot is kept', async () => {
    browser.kept = memories(1);
    locks.hold(ROBOT);
    const { seen, robot } = await tab();
    browser.kept = memories(9);
    robot().save(5);
    await closeOther();
    expect(seen.backups).toEqual([9]);
    expect(byteOf(browser.kept)).toBe(5);
    expect(seen.said.join(' ')).toContain('backup');
});

test.each([
    ['motions alone', memories(9, 1), [TEXTS.robot.otherBackedUp]],
    ['settings alone', memories(1, 9), [TEXTS.robot.otherSettings]],
    ['both', memories(9), [TEXTS.robot.otherBackedUp, TEXTS.robot.otherSettings]],
    ['neither', memories(1), []],
])('the other tab has saved %s meanwhile, this one too: what is not in the backup is said', async (_, stored, sentences) => {
    browser.kept = memories(1);
    locks.hold(ROBOT);
    const { seen, robot } = await tab();
    browser.kept = stored;
    robot().save(5);
    await closeOther();
    expect(seen.said).toEqual([TEXTS.robot.tookOver, ...(sentences.length > 0 ? [sentences.join(' ')] : [])]);
});

test('the other tab has saved meanwhile, this one later', async () => {
    browser.kept = memories(1);
    locks.hold(ROBOT);
    const { seen, robot } = await tab();
    browser.kept = memories(9);
    await closeOther();
    expect(byteOf(browser.kept)).toBe(9);
    robot().save(5);
    await vi.advanceTimersByTimeAsync(0);
    expect([seen.backups, byteOf(browser.kept)]).toEqual([[9], 5]);
    robot().save(6);
    await vi.advanceTimersByTimeAsync(0);
    expect([seen.backups, byteOf(browser.kept)]).toEqual([[9], 6]); // its own robot needs no backup
});

test('the other tab alone has saved: a restart here begins with its robot, and nothing is written over it', async () => {
    browser.kept = memories(1);
    locks.hold(ROBOT);
    const { source, robot } = await tab();
    browser.kept = memories(9);
    await closeOther();
    const restarted = source.restart('edit');
    await vi.advanceTimersByTimeAsync(1000);
    await restarted;
    expect([byteOf(robot().started), byteOf(browser.kept)]).toEqual([9, 9]);
});

test.each([
    ['has saved nothing else', 1],
    ['has saved meanwhile', 9],
])('a robot made factory fresh here stays so; the motions of the other tab, which %s, become a backup', async (_, byte) => {
    browser.kept = memories(1);
    locks.hold(ROBOT);
    const { source, seen, robot } = await tab();
    browser.kept = memories(byte);
    await source.forget('play');
    expect(byteOf(browser.kept)).toBe(byte);
    robot().tell({ kind: 'crashed', text: 'out of memory' });
    await source.restart('play');
    expect(byteOf(robot().started)).toBeUndefined();
    await closeOther();
    expect([seen.backups, byteOf(browser.kept)]).toEqual([[byte], undefined]); // also after the page is loaded again
    robot().now = memories(3);
    const restarted = source.restart('edit');
    await vi.advanceTimersByTimeAsync(1000);
    await restarted;
    expect(byteOf(robot().started)).toBe(3);
});

test('a robot made factory fresh here that has saved since: that is what is kept', async () => {
    browser.kept = memories(1);
    locks.hold(ROBOT);
    const { source, seen, robot } = await tab();
    await source.forget('play');
    robot().save(5);
    await closeOther();
    expect([seen.backups, byteOf(browser.kept)]).toEqual([[1], 5]);
});

test('a robot that crashes in a second tab starts again with what it had saved', async () => {
    browser.kept = memories(1);
    locks.hold(ROBOT);
    const { source, robot } = await tab();
    robot().save(5);
    robot().tell({ kind: 'crashed', text: 'out of memory' });
    const restarted = source.restart('play');
    await vi.advanceTimersByTimeAsync(1000);
    await restarted;
    expect(byteOf(robot().started)).toBe(5);
});

test('a full disk: what the robot has saved would be lost with the page, until the disk takes it', async () => {
    browser.isFull = true;
    const { seen, robot } = await tab();
    robot().save(5);
    await vi.advanceTimersByTimeAsync(0);
    expect(seen.hasUnkept).toBe(true);
    browser.isFull = false;
    robot().save(6);
    await vi.advanceTimersByTimeAsync(0);
    expect(seen.hasUnkept).toBe(false);
});

test('the other tab is only loaded again: it stays the one that keeps its robot', async () => {
    locks.hold(ROBOT);
    let isFreed = false;
    void robotFreed().then(() => (isFreed = true));
    await vi.advanceTimersByTimeAsync(1000);
    locks.free(ROBOT);
    await vi.advanceTimersByTimeAsync(5000);
    locks.hold(ROBOT); // the page is there again
    await vi.advanceTimersByTimeAsync(MINUTE_MS);
    expect(isFreed).toBe(false);
    locks.free(ROBOT);
    await vi.advanceTimersByTimeAsync(MINUTE_MS);
    expect(isFreed).toBe(true);
});
