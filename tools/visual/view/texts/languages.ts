// SPDX-License-Identifier: MIT
// Language of the page: from its address (?lang=de), else chosen in the menu, else the first supported language of the browser, else
// English. Only that one is loaded.

import { recall, store } from '../remembered.ts';
import type { Texts } from './texts.ts';
import { TEXTS, useTexts } from './texts.ts';

/** Names in the language itself. */
export const LANGUAGES = { en: 'English', de: 'Deutsch', es: 'Español', ja: '日本語', ko: '한국어' } as const;
export type Language = keyof typeof LANGUAGES;

type Load = () => Promise<{ readonly default: Texts }>;
const FILES: Readonly<Record<Exclude<Language, 'en'>, Load>> = {
    de: () => import('./de.ts'),
    es: () => import('./es.ts'),
    ja: () => import('./ja.ts'),
    ko: () => import('./ko.ts'),
};
/** For tests: see pseudo.ts. */
const PSEUDO = 'pseudo';

function isOurs(name: string | null | undefined): name is Language {
    return name !== null && name !== undefined && Object.hasOwn(LANGUAGES, name);
}

/** chosen: language from the menu; browser: its languages, the preferred one first ("de-AT"). */
export function languageFor(address: URL, chosen: string | null, browser: readonly string[]): Language {
    const asked = [address.searchParams.get('lang'), chosen, ...browser.map(name => name.split('-')[0])];
    return asked.find(isOurs) ?? 'en';
}

/** Resolves when TEXTS has the language; English if its file cannot be loaded. */
export async function useLanguage(): Promise<void> {
    const address = new URL(window.location.href);
    const language = languageFor(address, recall('language'), navigator.languages);
    const load = address.searchParams.get('lang') === PSEUDO ? () => import('./pseudo.ts') : language === 'en' ? null : FILES[language];
    const loaded = await load?.().catch(() => null);
    if (loaded) useTexts(loaded.default);
    document.documentElement.lang = loaded ? language : 'en';
    document.title = TEXTS.page.title;
    document.querySelector('meta[name="description"]')?.setAttribute('content', TEXTS.page.description);
}

/** Reloads the page in that language; document and robot are kept. */
export function chooseLanguage(language: string): void {
    store('language', language);
    const address = new URL(window.location.href);
    address.searchParams.delete('lang');
    if (recall('language') !== language) address.searchParams.set('lang', language); // the browser stores nothing
    if (address.href === window.location.href) window.location.reload();
    else window.location.replace(address);
}

/** Address of the start page in the current language. */
export function startPageAddress(): string {
    const { lang } = document.documentElement;
    return lang === 'en' ? './motions.html' : `./motions.${lang}.html`;
}
