// SPDX-License-Identifier: MIT
// A browser that is too old for the page: the built script, in a browser without what it lacks.
import { runInNewContext } from 'node:vm';
import { expect, test } from 'vitest';
import { oldBrowserScript } from '../old-browser-plugin.ts';
import DE from '../view/texts/de.ts';
import { EN } from '../view/texts/en.ts';

const script = oldBrowserScript({ en: EN, de: DE });

/** What the page shows. elements: what every element of this browser has. */
function shownBy(browser: { globals: object; elements: object; language: string; search?: string; before?: string }): string[] {
    const shown: { textContent: string; lang: string }[] = [];
    const element = { ...browser.elements, setAttribute: () => undefined };
    const document = {
        createElement: () => ({ ...element }),
        body: { firstChild: null, insertBefore: (one: { textContent: string; lang: string }) => shown.push(one) },
    };
    const { language, search = '' } = browser;
    runInNewContext((browser.before ?? '') + script, { ...browser.globals, document, navigator: { language }, location: { search } });
    return shown.map(({ lang, textContent }) => `${lang}: ${textContent}`);
}

const GLOBALS = { WebAssembly, DecompressionStream };
const NEW = { globals: GLOBALS, elements: { noModule: false }, language: 'de-AT' };
const WITHOUT = 'delete globalThis.WebAssembly; delete Array.prototype.toSpliced;';

test('a browser with all that is needed shows nothing', () => {
    expect(shownBy(NEW)).toEqual([]);
});

test('an old browser shows one sentence, in its language: what is missing, and which browsers work', () => {
    const old = { globals: {}, elements: {}, language: 'de-AT', before: WITHOUT };
    const missing = 'JavaScript modules, WebAssembly, ECMAScript 2023, DecompressionStream';
    expect(shownBy(old)).toEqual([`de: ${DE.page.lacks(missing)}`]);
    expect(shownBy({ ...old, language: 'fr' })).toEqual([`en: ${EN.page.lacks(missing)}`]);
    expect(shownBy({ ...old, language: 'fr', search: '?a=1&lang=de' })).toEqual([`de: ${DE.page.lacks(missing)}`]);
    expect(EN.page.lacks('X')).toMatch(/lacks X,.* Chrome, .*Firefox .*Safari/);
});

test('only WebAssembly is switched off', () => {
    const off = { ...NEW, globals: { DecompressionStream }, before: 'delete globalThis.WebAssembly;' };
    expect(shownBy(off)).toEqual([`de: ${DE.page.lacks('WebAssembly')}`]);
});

test('the script is written as browsers of 2009 read it', () => {
    expect(script.replaceAll(/^\/\/.*$/gm, '').replace(/\{"en".*\}/, '')).not.toMatch(
        /=>|`|\?\.|\?\?|\.\.\.|\b(let|const|class|async|of)\b/,
    );
});
