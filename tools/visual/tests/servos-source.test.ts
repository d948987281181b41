// SPDX-License-Identifier: MIT
// My servos, as the page chooses them: what one tab does not use, another one may.
import { afterEach, expect, test, vi } from 'vitest';
import { ServosSource } from '../app/servos-source.ts';
import { TEXTS } from '../view/texts/texts.ts';
import { BODY } from './motion-bench.ts';

const LIBRARY = new Uint8Array([0]);
const browser = vi.hoisted(() => ({ missing: '', reads: true, saves: true, kept: null as readonly Uint8Array[] | null }));

vi.mock('../app/assets.ts', () => ({
    servosModule: async (image: string) => {
        if (browser.missing === image) throw new TypeError('Failed to fetch');
        return null;
    },
    motionLibrary: () => Promise.resolve(LIBRARY),
}));
vi.mock('../view/robot-store.ts', () => ({
    loadServos: async () => {
        if (!browser.reads) throw new DOMException('the disk does not answer', 'UnknownError');
        return browser.kept;
    },
    saveServos: async (memories: readonly Uint8Array[]) => {
        if (!browser.saves) throw new DOMException('the disk is full', 'QuotaExceededError');
        browser.kept = memories;
    },
}));

/** A worker whose adapter is in use by another program. */
class Refused {
    onmessage: ((event: { data: object }) => void) | null = null;

    postMessage(): void {
        setTimeout(() => this.onmessage?.({ data: { kind: 'refused', text: 'in use' } }));
    }

    terminate(): void {
        this.onmessage = null;
    }
}

/** A worker whose program runs until it is asked to end. */
class Runs {
    static made = 0;
    /** What the programs were asked. */
    static readonly asked: string[] = [];
    /** The memories that each program got. */
    static readonly given: unknown[] = [];
    /** The place of the port that each program got. */
    static readonly places: unknown[] = [];
    static isRefused = false;
    static last: Runs;
    onmessage: ((event: { data: object }) => void) | null = null;

    constructor() {
        Runs.made++;
        Runs.last = this;
    }

    postMessage({ kind, kept, port }: { kind: string; kept?: unknown; port?: unknown }): void {
        Runs.asked.push(kind);
        if (kind === 'start') Runs.given.push(kept);
        if (kind === 'start') Runs.places.push(port);
        const answer = { start: Runs.isRefused || port === -1 ? 'refused' : 'started', end: 'ended' }[kind];
        if (answer) setTimeout(() => this.tell({ kind: answer, text: 'the port is in use' }), 20);
    }

    tell(message: object): void {
        this.onmessage?.({ data: message });
    }

    terminate(): void {
        this.onmessage = null;
    }
}

/** My servos run Play. */
async function runs() {
    const port = { getInfo: () => ({}) };
    const ports = [port];
    const serial = { requestPort: () => Promise.resolve(port), getPorts: () => Promise.resolve([...ports]), onconnect: () => undefined };
    vi.stubGlobal('navigator', { serial });
    vi.stubGlobal('Worker', Runs);
    const events = { frame: vi.fn(), text: vi.fn(), connection: vi.fn(), change: vi.fn(), motions: vi.fn() };
    const source = new ServosSource(BODY, events, () => false);
    await source.choose();
    await source.start('play');
    source.connect();
    return { source, events, port, ports, serial };
}

afterEach(() => {
    vi.unstubAllGlobals();
    Object.assign(browser, { missing: '', reads: true, saves: true, kept: null });
    Object.assign(Runs, { made: 0, isRefused: false });
    Runs.asked.length = Runs.given.length = Runs.places.length = 0;
});

test('a tab whose adapter could not be opened does not keep My servos from another tab; one that uses them does', async () => {
    const held = new Set<string>();
    const request = async (name: string, _: object, use: (lock: object | null) => Promise<void>): Promise<void> => {
        if (held.has(name)) return use(null);
        held.add(name);
        await use({});
        held.delete(name);
    };
    const port = { getInfo: () => ({}) };
    const serial = { requestPort: () => Promise.resolve(port), getPorts: () => Promise.resolve([port]) };
    vi.stubGlobal('navigator', { locks: { request }, serial });
    vi.stubGlobal('Worker', Refused);
    const events = { frame: vi.fn(), text: vi.fn(), connection: vi.fn(), change: vi.fn(), motions: vi.fn() };
    const source = new ServosSource(BODY, events, () => true);
    await source.choose();
    await expect(source.start('play')).rejects.toMatchObject({ code: 'port-busy' });
    await vi.waitFor(() => expect([...held]).toEqual([]));
    held.add('motion512-servos');
    await expect(source.start('play')).rejects.toMatchObject({ code: 'second-tab' });
});

test('another robot is chosen while My servos change to Edit: they do not start again, nor report as the robot in use', async () => {
    const { source, events } = await runs();
    const restarted = source.restart('edit');
    await new Promise(resolve => setTimeout(resolve, 5)); // the program is asked to end
    events.connection.mockClear();
    const closed = source.close();
    void source.restart('play'); // as when the program has ended by itself
    await Promise.all([restarted, closed]);
    await new Promise(resolve => setTimeout(resolve, 100));
    expect(events.connection.mock.calls).toEqual([]);
    expect(Runs.made).toBe(1);
});

test('another image cannot be loaded: the program that runs goes on, as the page says', async () => {
    const { source } = await runs();
    browser.missing = 'edit';
    await expect(source.restart('edit')).rejects.toMatchObject({ code: 'no-image' });
    expect(Runs.asked).not.toContain('end');
    await source.close();
});

test('another image starts on the adapter, wherever it stands among the ports, and not on a cable of the same kind', async () => {
    const { source, port, ports, serial } = await runs();
    const cable = { getInfo: () => ({}) };
    ports.unshift(cable);
    serial.onconnect(); // while the adapter is there
    await source.restart('edit');
    ports.splice(0, 2, cable);
    await expect(source.restart('play')).rejects.toMatchObject({ code: 'adapter-out' });
    ports.push({ ...port }); // plugged in again, it is another port
    await source.restart('edit');
    expect(Runs.places).toEqual([0, 1, 1]);
    await source.close();
});

test.each([
    ['another image is to run', (source: ServosSource) => void source.restart('edit').catch(() => undefined)],
    ['the program starts anew', () => Runs.last.tell({ kind: 'ended' })],
])('the adapter is out when %s: the page says so, and what helps', async (_, starts) => {
    const { source, events, ports } = await runs();
    const stopped = () => events.change.mock.calls.flatMap(([change]) => ('stopped' in change ? [change.stopped] : [])).at(-1);
    const adapter = ports.splice(0, 1);
    starts(source);
    await vi.waitFor(() => expect(stopped()).toEqual(expect.any(String)));
    await new Promise(resolve => setTimeout(resolve, 5)); // a second reason would replace the first
    expect(stopped()).toBe(TEXTS.robot.errors['adapter-out']);
    ports.push(...adapter);
    await source.restart('edit'); // once it is back
    await source.close();
});

test('another program has the adapter when another image starts: the page says so, and does not look for servos for ever', async () => {
    const { source, events } = await runs();
    Runs.isRefused = true;
    await expect(source.restart('edit')).rejects.toMatchObject({ code: 'port-busy' });
    expect(events.change.mock.calls.at(-1)?.[0].stopped).toContain('the port is in use');
    await source.close();
});

test('the adapter is back: that is said until Play has obeyed `on`, whose answer comes in pieces', async () => {
    const { source, events } = await runs();
    const told = (): unknown[] => events.change.mock.calls.flatMap(([change]) => ('adapter' in change ? [change.adapter] : []));
    const says = async (text: string): Promise<void> => {
        for (const byte of new TextEncoder().encode(text)) Runs.last.tell({ kind: 'bytes', bytes: Uint8Array.of(byte) });
        await new Promise(resolve => setTimeout(resolve, 5));
    };
    for (const isThere of [false, true]) Runs.last.tell({ kind: 'adapter', isThere });
    await says('on 19\r\nNo answer: ID 19\r\n] off\r\n OK\r\n] ');
    expect(told()).toEqual(['out', 'back']);
    await says('on\r\nServo 18 answers again\r\n OK\r\n] ');
    expect(told()).toEqual(['out', 'back', null]);
    await says('on 1 2\r\n OK\r\n] ');
    expect(told()).toHaveLength(3);
    await source.close();
});

test.each(['on 1-3\r\n OK', '@torque on 1 2\r\n@torque OK'])('the adapter is back, and Play has obeyed %j', async text => {
    const { source, events } = await runs();
    const told = (): unknown[] => events.change.mock.calls.flatMap(([change]) => ('adapter' in change ? [change.adapter] : []));
    const says = async (line: string): Promise<void> => {
        Runs.last.tell({ kind: 'bytes', bytes: new TextEncoder().encode(`${line}\r\n] `) });
        await new Promise(resolve => setTimeout(resolve, 5));
    };
    for (const isThere of [false, true]) Runs.last.tell({ kind: 'adapter', isThere });
    await says('@torque on 19\r\n@torque ERR 7 No answer: ID 19');
    await says('@torque off\r\n@torque OK');
    expect(told()).toEqual(['out', 'back']);
    await says(text);
    expect(told()).toEqual(['out', 'back', null]);
    await source.close();
});

test('a browser that stores nothing: Play has what Edit has saved', async () => {
    const { source } = await runs();
    browser.saves = false;
    const saved = [new Uint8Array([7]), new Uint8Array(), new Uint8Array()];
    Runs.last.tell({ kind: 'keep', id: 1, memories: saved });
    await source.restart('edit');
    expect(Runs.given).toEqual([[LIBRARY, null, null], saved]);
    await source.close();
});

test('what a program has saved is lost with the page until the browser has stored it, also when another robot is used', async () => {
    const { source, events } = await runs();
    const isUnkept = () => events.change.mock.calls.findLast(([change]) => 'hasUnkeptServos' in change)?.[0].hasUnkeptServos;
    browser.saves = false;
    Runs.last.tell({ kind: 'keep', id: 1, memories: [new Uint8Array([7])] });
    expect(isUnkept()).toBe(true);
    await new Promise(resolve => setTimeout(resolve, 5));
    expect(isUnkept()).toBe(true);
    browser.saves = true;
    Runs.last.tell({ kind: 'keep', id: 2, memories: [new Uint8Array([8])] });
    await vi.waitFor(() => expect(isUnkept()).toBe(false));
    await source.close();
});

test('what is stored cannot be read: it is not replaced by the motions of a new robot', async () => {
    Object.assign(browser, { reads: false, kept: [new Uint8Array([7])] });
    const { source, events } = await runs();
    Runs.last.tell({ kind: 'keep', id: 1, memories: [LIBRARY] });
    await source.close();
    expect(browser.kept).toEqual([new Uint8Array([7])]);
    expect(events.change.mock.calls.some(([change]) => change.message?.text.startsWith('This browser does not save'))).toBe(true);
});
