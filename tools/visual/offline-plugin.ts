// SPDX-License-Identifier: MIT
// Writes the files that accompany the page: the service worker with all file names, the manifest, the icon.

import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import type { Plugin } from 'vite';

const STATIC = ['manifest.webmanifest', 'icon.svg'];

export function offline(): Plugin {
    return {
        name: 'offline',
        apply: 'build',
        generateBundle(_options, bundle) {
            for (const name of STATIC)
                this.emitFile({ type: 'asset', fileName: name, source: readFileSync(new URL(`static/${name}`, import.meta.url)) });
            const hash = createHash('sha256');
            const names = Object.keys(bundle)
                .filter(name => name !== 'index.html')
                .sort();
            for (const name of names) {
                const file = bundle[name];
                hash.update(name).update(file?.type === 'chunk' ? file.code : (file?.source ?? ''));
            }
            const files = ['./', ...names, ...STATIC].map(name => `'${name}'`).join(', ');
            const source = readFileSync(new URL('service-worker.js', import.meta.url), 'utf8')
                .replace('__VERSION__', hash.digest('hex').slice(0, 16))
                .replace("'__FILES__'", files);
            this.emitFile({ type: 'asset', fileName: 'service-worker.js', source });
        },
    };
}
