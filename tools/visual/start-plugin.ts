// SPDX-License-Identifier: MIT
// Writes motions.html in every language and its pictures, from the recordings of start/record.ts.

import { readFileSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import type { Plugin } from 'vite';
import { HASH, encodeMotion, pagesToSend } from './files/motion-link.ts';
import { documentFrom } from './model/document.ts';
import { Motion } from './model/motion.ts';
import type { MotionExports } from './model/motion.ts';
import { PageFormat } from './model/page-format.ts';
import { readPage } from './model/page.ts';
import { START_MOTIONS } from './start/motions.ts';
import type { Outline } from './start/outline.ts';
import { startFile, startPage } from './start/page.ts';
import type { Card } from './start/page.ts';
import { picture } from './start/picture.ts';
import DE from './view/texts/de.ts';
import { EN } from './view/texts/en.ts';
import ES from './view/texts/es.ts';
import JA from './view/texts/ja.ts';
import KO from './view/texts/ko.ts';
import { LANGUAGES } from './view/texts/languages.ts';
import type { Language } from './view/texts/languages.ts';
import type { Texts } from './view/texts/texts.ts';

/** Of all languages. */
export const TEXTS: Readonly<Record<Language, Texts>> = { en: EN, de: DE, es: ES, ja: JA, ko: KO };
const BUILD = new URL('../../build/', import.meta.url);

async function cards(): Promise<Card[]> {
    const module = await WebAssembly.compile(await readFile(new URL('wasm/motion.wasm', BUILD)));
    const { exports } = await WebAssembly.instantiate(module, {});
    const format = new PageFormat(new Motion(exports as unknown as MotionExports)); // made by board/motion_api.c
    const library = documentFrom(new Uint8Array(await readFile(new URL('motions/motions.bin', BUILD))), '');
    const numberOf = (name: string): number =>
        library.pages.findIndex((bytes, page) => page > 0 && !format.isEmpty(bytes) && readPage(format, bytes).name === name);
    return Promise.all(
        START_MOTIONS.map(async motion => ({
            ...motion,
            address: `${HASH}${await encodeMotion(pagesToSend(format, library, numberOf(motion.name)))}`,
        })),
    );
}

export function start(): Plugin {
    return {
        name: 'start',
        apply: 'build',
        async generateBundle() {
            const seen = JSON.parse(readFileSync(new URL('wasm/start.json', BUILD), 'utf8')) as Record<string, Outline[]>; // from record.ts
            for (const [name, frames] of Object.entries(seen)) {
                this.emitFile({ type: 'asset', fileName: `motions/${name}.svg`, source: picture(frames, true) });
                this.emitFile({ type: 'asset', fileName: `motions/${name}-still.svg`, source: picture(frames, false) });
            }
            const all = await cards();
            for (const [language, texts] of Object.entries(TEXTS)) {
                const others = new Map(Object.entries(LANGUAGES).filter(([code]) => code !== language));
                this.emitFile({ type: 'asset', fileName: startFile(language), source: startPage(all, language, texts, others) });
            }
        },
    };
}
