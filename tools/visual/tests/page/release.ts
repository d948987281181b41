// SPDX-License-Identifier: MIT
// The built page in its own folder, and a release after it: every file named after its contents gets another name, as if all of them had
// changed, and the old files are gone.

import { cp, mkdtemp, readFile, readdir, rename, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const BUILT = new URL('../../../../build/visual/', import.meta.url).pathname;
const HASHED = /-([\w-]{8})\.\w+(\.gz)?$/;
const VERSION = /VERSION = '(\w+)'/;

export class ReleasedPage {
    readonly folder: string;

    private constructor(folder: string) {
        this.folder = folder;
    }

    static async make(): Promise<ReleasedPage> {
        const folder = await mkdtemp(join(tmpdir(), 'motion512-page-'));
        await cp(BUILT, folder, { recursive: true });
        return new ReleasedPage(folder);
    }

    /** Replaces this version by the next one. */
    async release(): Promise<void> {
        const assets = join(this.folder, 'assets');
        const names = await readdir(assets);
        const next = new Map(
            names.flatMap(name => {
                const hash = HASHED.exec(name)?.[1];
                return hash ? [[hash, [...hash].reverse().join('')] as const] : [];
            }),
        );
        if (next.size < 10) throw new Error('the files of the page are named otherwise');
        const renamed = (text: string): string => [...next].reduce((all, [from, to]) => all.replaceAll(from, to), text);
        for (const name of [...names.map(one => join('assets', one)), 'index.html', 'service-worker.js']) {
            const path = join(this.folder, name);
            if (/\.(js|css|html)$/.test(name)) await writeFile(path, renamed(await readFile(path, 'utf8')));
            if (renamed(name) !== name) await rename(path, join(this.folder, renamed(name)));
        }
        const worker = join(this.folder, 'service-worker.js');
        await writeFile(worker, (await readFile(worker, 'utf8')).replace(VERSION, "VERSION = 'the-next-one'"));
    }

    remove(): Promise<void> {
        return rm(this.folder, { recursive: true });
    }
}
