// SPDX-License-Identifier: MIT
// My servos, as the page chooses them: what one tab does not use, another one may.
import { readFile } from 'node:fs/promises';
import { afterEach, expect, test, vi } from 'vitest';
import { ServosSource } from '../app/servos-source.ts';
import type { Body } from '../model/body.ts';

vi.mock('../app/assets.ts', () => ({
    servosModule: () => Promise.resolve(null),
    motionLibrary: () => Promise.resolve(new Uint8Array()),
}));
vi.mock('../view/robot-store.ts', () => ({ loadServos: () => Promise.resolve(null) }));

const BODY = JSON.parse(await readFile(new URL('../../../build/wasm/body.json', import.meta.url), 'utf8')) as Body;

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
    onmessage: ((event: { data: object }) => void) | null = null;

    constructor() {
        Runs.made++;
    }

    postMessage({ kind }: { kind: string }): void {
        const answer = { start: 'started', end: 'ended' }[kind];
        if (answer) setTimeout(() => this.onmessage?.({ data: { kind: answer } }), 20);
    }

    terminate(): void {
        this.onmessage = null;
    }
}

afterEach(() => {
    vi.unstubAllGlobals();
});

test('a tab whose adapter could not be opened does not keep My servos from another tab', async () => {
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
});

test('another robot is chosen while My servos change to Edit: they do not start again, nor report as the robot in use', async () => {
    const port = { getInfo: () => ({}) };
    const serial = { requestPort: () => Promise.resolve(port), getPorts: () => Promise.resolve([port]) };
    vi.stubGlobal('navigator', { serial });
    vi.stubGlobal('Worker', Runs);
    const events = { frame: vi.fn(), text: vi.fn(), connection: vi.fn(), change: vi.fn(), motions: vi.fn() };
    const source = new ServosSource(BODY, events, () => false);
    await source.choose();
    await source.start('play');
    source.connect();
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
