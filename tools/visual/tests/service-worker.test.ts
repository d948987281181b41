// SPDX-License-Identifier: MIT
// The service worker's program, with a browser that keeps old files for ten minutes, as many hosts ask for.
import { mkdir, mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { runInNewContext } from 'node:vm';
import { expect, test } from 'vitest';
import { workerFor } from '../offline-plugin.ts';

const SCOPE = 'https://host.example/page/';

interface Installed {
    /** What it keeps, by address. */
    readonly kept: ReadonlyMap<string, string>;
    /** Its answer to the page, without a network. */
    answer(address: string): Promise<string>;
}

/** Installs the service worker of a release. */
async function installed(files: readonly string[], get: (request: Request) => string): Promise<Installed> {
    const source = await readFile(new URL('../service-worker.js', import.meta.url), 'utf8');
    const kept = new Map<string, string>();
    const asked = (what: string | Request): Request => (what instanceof Request ? what : new Request(new URL(what, SCOPE)));
    const addAll = (all: readonly (string | Request)[]): Promise<void> => {
        for (const request of all.map(asked)) kept.set(request.url, get(request));
        return Promise.resolve();
    };
    const match = (what: string | Request): Promise<string | undefined> => {
        const { origin, pathname } = new URL(asked(what).url); // ignoreSearch
        return Promise.resolve(kept.get(`${origin}${pathname}`));
    };
    const listeners = new Map<string, (event: object) => void>();
    runInNewContext(source.replace("'__FILES__'", files.map(file => `'${file}'`).join()), {
        Request: class extends Request {
            constructor(address: string, options?: RequestInit) {
                super(new URL(address, SCOPE), options);
            }
        },
        caches: { open: () => Promise.resolve({ addAll, match }), keys: () => Promise.resolve([]) },
        self: {
            registration: { scope: SCOPE },
            addEventListener: (name: string, listener: (event: object) => void) => listeners.set(name, listener),
        },
        fetch: () => Promise.reject(new Error('there is no network')),
    });
    const done: Promise<unknown>[] = [];
    listeners.get('install')?.({ waitUntil: (work: Promise<unknown>) => done.push(work) });
    await Promise.all(done);
    const answer = (address: string): Promise<string> =>
        new Promise((resolve, reject) => {
            const respondWith = (given: Promise<string>): void => void given.then(resolve, reject);
            listeners.get('fetch')?.({ request: new Request(new URL(address, SCOPE)), respondWith });
        });
    return { kept, answer };
}

test('a new version keeps the new page, even if the browser still has the old one; what has its hash in its name is not asked for again', async () => {
    const fromHost: string[] = [];
    const { kept } = await installed(['./', 'assets/index-1a2b.js', 'motions.html'], request => {
        if (request.cache !== 'no-cache') return 'as the browser has it';
        fromHost.push(request.url);
        return 'new';
    });
    expect(kept.get(SCOPE)).toBe('new');
    expect(kept.get(`${SCOPE}motions.html`)).toBe('new');
    expect(fromHost).toHaveLength(2);
});

test.each(['', 'index.html', 'index.html?lang=de'])('without a network the page comes by the name "%s"', async name => {
    const { answer } = await installed(['./', 'motions.html'], ({ url }) => `what is at ${url}`);
    expect(await answer(name)).toBe(`what is at ${SCOPE}`);
    expect(await answer('motions.html')).toBe(`what is at ${SCOPE}motions.html`);
});

test('the version changes with every file of the page, and all of them are kept', async () => {
    const folder = await mkdtemp(join(tmpdir(), 'release-'));
    await mkdir(join(folder, 'assets'));
    const names = ['index.html', 'icon.svg', 'assets/index-1a2b.js', 'service-worker.js'];
    for (const name of names) await writeFile(join(folder, name), name);
    const versionOf = (worker: string): string => /VERSION = '(\w+)'/.exec(worker)?.[1] ?? '';
    const first = workerFor(folder);
    expect(first).toContain("FILES = ['assets/index-1a2b.js', 'icon.svg', './'];");
    const versions = [versionOf(first)];
    for (const name of names) {
        await writeFile(join(folder, name), `${name}, changed`);
        versions.push(versionOf(workerFor(folder)));
    }
    expect(versions.map(version => versions.indexOf(version))).toEqual([0, 1, 2, 3, 3]); // not with the worker of the build before
    await rm(folder, { recursive: true });
});
