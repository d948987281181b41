// SPDX-License-Identifier: MIT
// The board in Chromium equals the board in Node (which equals the native one: test_same_machine.py): the same one-minute sessions, hashed.
// Both run at full speed and at the same time.
import { readFile } from 'node:fs/promises';
import { expect, test } from 'vitest';
import { build } from 'vite';
import { runSession } from '../session/run-session.ts';
import type { Session } from '../session/run-session.ts';
import { robotImages, wasmModule } from '../robot-bench.ts';
import { PageServer, startBrowser } from './page-bench.ts';

const BUILD = new URL('../../../../build/', import.meta.url);
const asText = async (): Promise<string> => {
    const entry = new URL('../session/run-session.ts', import.meta.url).pathname;
    const made = await build({
        configFile: false,
        logLevel: 'error',
        build: { write: false, minify: false, lib: { entry, formats: ['es'], fileName: 'session' } },
    });
    const output = (Array.isArray(made) ? made : [made]).flatMap(one => ('output' in one ? one.output : []));
    const code = output.find(file => file.type === 'chunk');
    if (code?.type !== 'chunk') throw new Error('the session was not bundled');
    return code.code;
};

test('a session of walking and one of Edit, hashed in Chromium and in Node', async () => {
    const sessions = JSON.parse(await readFile(new URL('../session/session.json', import.meta.url), 'utf8')) as Session[];
    expect(sessions.reduce((sum, { seconds }) => sum + seconds, 0)).toBe(60);
    const hex = async (name: string): Promise<string> => readFile(new URL(`firmware/${name}.hex`, BUILD), 'utf8');
    const { motions } = await robotImages('play');
    const [browser, server, code] = await Promise.all([startBrowser(), PageServer.start(), asText()]);
    const page = await browser.newPage();
    const wasm = await readFile(new URL('wasm/board.wasm', BUILD));
    await page.route('**/session.js', route =>
        route.fulfill({ contentType: 'text/javascript', body: `${code};globalThis.runSession = runSession;` }),
    );
    await page.route('**/board.wasm', route => route.fulfill({ contentType: 'application/wasm', body: wasm }));
    await page.goto(`${server.address}licences.html`);
    await page.addScriptTag({ url: `${server.address}session.js`, type: 'module' });
    const files = Object.fromEntries(
        await Promise.all(['boot-cm5', 'play-cm5', 'edit-cm5'].map(async name => [name, await hex(name)] as const)),
    );
    const inBrowser = page.evaluate(
        async ({ sessions, files, motions, at }) => {
            const { runSession } = globalThis as unknown as { runSession: (s: unknown, f: unknown) => Promise<Record<string, string>> };
            const board = await WebAssembly.compileStreaming(fetch(`${at}board.wasm`));
            const results = [];
            for (const session of sessions)
                results.push(
                    await runSession(session, { board, motions: Uint8Array.from(motions), hex: async (name: string) => files[name] }),
                );
            return results;
        },
        { sessions, files, motions: Array.from(motions), at: server.address },
    );
    const board = await wasmModule('board');
    const here = [];
    for (const session of sessions) here.push(await runSession(session, { board, motions, hex }));
    const there = await inBrowser;
    await browser.close();
    await server.stop();
    for (const [i, session] of sessions.entries()) expect(there[i], session.name).toEqual(here[i]);
});
