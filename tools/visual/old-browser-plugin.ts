// SPDX-License-Identifier: MIT
// Puts old-browser.js into the page. The page's policy allows no script inside index.html.

import { readFileSync } from 'node:fs';
import type { Plugin } from 'vite';
import type { Texts } from './view/texts/texts.ts';

const SCRIPT = 'old-browser.js';

export function oldBrowser(texts: Readonly<Record<string, Texts>>): Plugin {
    return {
        name: 'old-browser',
        apply: 'build',
        generateBundle() {
            this.emitFile({ type: 'asset', fileName: SCRIPT, source: oldBrowserScript(texts) });
        },
        transformIndexHtml: () => [{ tag: 'script', attrs: { src: `./${SCRIPT}` }, injectTo: 'body' }],
    };
}

/** texts: by language. */
export function oldBrowserScript(texts: Readonly<Record<string, Texts>>): string {
    const sentences = Object.entries(texts).map(([language, { page }]) => [language, page.lacks('__MISSING__')]);
    return readFileSync(new URL(SCRIPT, import.meta.url), 'utf8').replace("'__SENTENCES__'", () =>
        JSON.stringify(Object.fromEntries(sentences)),
    );
}
