// SPDX-License-Identifier: MIT
// The texts in the current language. languages.ts chooses it after modules are loaded but before the page is built, so no module may keep a
// text from load time. Look up texts where elements are made.

import { EN } from './en.ts';

/** Texts that every language has. */
export type Texts = typeof EN;

export let TEXTS: Texts = EN;

export function useTexts(texts: Texts): void {
    TEXTS = texts;
}
