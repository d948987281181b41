// SPDX-License-Identifier: MIT
// The service worker's program, with a browser that keeps old files for ten minutes, as many hosts ask for.
import { readFile } from 'node:fs/promises';
import { runInNewContext } from 'node:vm';
import { expect, test } from 'vitest';

const SCOPE = 'https://host.example/page/';

/** Installs the service worker of a release. Returns what it keeps, by address. */
async function installed(files: readonly string[], get: (request: Request) => string): Promise<Map<string, string>> {
    const source = await readFile(new URL('../service-worker.js', import.meta.url), 'utf8');
    const kept = new Map<string, string>();
    const asked = (what: string | Request): Request => (what instanceof Request ? what : new Request(new URL(what, SCOPE)));
    const addAll = (all: readonly (string | Request)[]): Promise<void> => {
        for (const request of all.map(asked)) kept.set(request.url, get(request));
        return Promise.resolve();
    };
    const listeners = new Map<string, (event: object) => void>();
    runInNewContext(source.replace("'__FILES__'", files.map(file => `'${file}'`).join()), {
        Request: class extends Request {
            constructor(address: string, options?: RequestInit) {
                super(new URL(address, SCOPE), options);
            }
        },
        caches: { open: () => Promise.resolve({ addAll }) },
        self: { addEventListener: (name: string, listener: (event: object) => void) => listeners.set(name, listener) },
    });
    const done: Promise<unknown>[] = [];
    listeners.get('install')?.({ waitUntil: (work: Promise<unknown>) => done.push(work) });
    await Promise.all(done);
    return kept;
}

test('a new version keeps the new page, even if the browser still has the old one; what has its hash in its name is not asked for again', async () => {
    const fromHost: string[] = [];
    const kept = await installed(['./', 'assets/index-1a2b.js', 'motions.html'], request => {
        if (request.cache !== 'no-cache') return 'as the browser has it';
        fromHost.push(request.url);
        return 'new';
    });
    expect(kept.get(SCOPE)).toBe('new');
    expect(kept.get(`${SCOPE}motions.html`)).toBe('new');
    expect(fromHost).toHaveLength(2);
});
