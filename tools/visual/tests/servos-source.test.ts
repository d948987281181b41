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
