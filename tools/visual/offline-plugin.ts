// SPDX-License-Identifier: MIT
// Writes the files that accompany the page: the service worker with all file names, the manifest, the icon.

import { createHash } from 'node:crypto';
import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Plugin } from 'vite';

const STATIC = ['manifest.webmanifest', 'icon.svg'];
const WORKER = 'service-worker.js';

export function offline(): Plugin {
    return {
        name: 'offline',
        apply: 'build',
        generateBundle() {
            for (const name of STATIC)
                this.emitFile({ type: 'asset', fileName: name, source: readFileSync(new URL(`static/${name}`, import.meta.url)) });
        },
        // When all files are there, the page itself, too: a release that changes only that must have another version.
        writeBundle({ dir }) {
            if (dir === undefined) return this.error('the page needs a folder');
            writeFileSync(join(dir, WORKER), workerFor(dir));
        },
    };
}

/** The service worker for the files of a folder. */
export function workerFor(folder: string): string {
    const names = readdirSync(folder, { recursive: true, withFileTypes: true })
        .filter(entry => entry.isFile())
        .map(entry => join(entry.parentPath, entry.name).slice(join(folder, '/').length))
        .filter(name => name !== WORKER)
        .sort();
    const hash = createHash('sha256');
    for (const name of names) hash.update(name).update(readFileSync(join(folder, name)));
    const files = names.map(name => `'${name === 'index.html' ? './' : name}'`).join(', ');
    return readFileSync(new URL(WORKER, import.meta.url), 'utf8')
        .replace('__VERSION__', hash.digest('hex').slice(0, 16))
        .replace("'__FILES__'", files);
}
