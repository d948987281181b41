// SPDX-License-Identifier: MIT
// The texts in the language that is used. languages.ts chooses it before anything of the page is made, so no module may keep a text from the
// time when it was loaded: texts are looked up where elements are made.

import { EN } from './en.ts';

/** What each language has. */
export type Texts = typeof EN;

export let TEXTS: Texts = EN;

export function useTexts(texts: Texts): void {
    TEXTS = texts;
}
