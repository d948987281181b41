// SPDX-License-Identifier: MIT
// A language for tests, made from English: letters with accents, 40 % longer, in brackets. What is plain English on the page in this language
// does not come from the texts; what is cut off in it would be cut off in German. Parts of a text stay as they are given.

import { EN } from './en.ts';
import type { Texts } from './texts.ts';

const PLAIN = 'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ';
const ACCENTED = 'àƀçďèƒĝĥìĵķļɱñöþɋŕšţùṽŵẋýžÀɃÇĎÈƑĜĤÌĴĶĻṀÑÖÞɊŔŠŢÙṼŴẊÝŽ';
const LONGER = 0.4;
/** Longer words are none of German, either. */
const WORD = 8;

function accented(text: string): string {
    return [...text].map(letter => ACCENTED[PLAIN.indexOf(letter)] ?? letter).join('');
}

/** The text and as much filling as makes it longer: in words, if it has some. */
export function pseudo(text: string): string {
    if (!/[A-Za-z]/.test(text)) return text;
    const filling = 'ö'.repeat(Math.ceil(text.length * LONGER) - 1);
    const words = text.includes(' ') ? ` ${filling.replaceAll(new RegExp(`.{${WORD}}(?=.)`, 'g'), `$&${' '}`)}` : filling;
    return `[${accented(text)}${words}]`;
}

/** The parts are kept out of it by signs that no text has. */
function pseudoFunction(make: (...parts: unknown[]) => unknown): (...parts: unknown[]) => unknown {
    return (...parts) => {
        const kept: string[] = [];
        const hide = (part: unknown): unknown => {
            if (Array.isArray(part)) return part.map(hide);
            if (typeof part === 'object' && part !== null) return Object.fromEntries(Object.entries(part).map(([k, v]) => [k, hide(v)]));
            return typeof part === 'string' && part !== '' ? String.fromCharCode(0xe000 + kept.push(part) - 1) : part;
        };
        const text = make(...parts.map(hide));
        return typeof text === 'string'
            ? pseudo(text).replaceAll(/[\ue000-\uf8ff]/g, sign => kept[sign.charCodeAt(0) - 0xe000] ?? '')
            : text;
    };
}

export function pseudoOf(value: unknown): unknown {
    if (typeof value === 'string') return pseudo(value);
    if (typeof value === 'function') return pseudoFunction(value as (...parts: unknown[]) => unknown);
    if (Array.isArray(value)) return value.map(pseudoOf);
    if (typeof value === 'object' && value !== null) return Object.fromEntries(Object.entries(value).map(([k, v]) => [k, pseudoOf(v)]));
    return value;
}

export default pseudoOf(EN) as Texts; // the same but for its letters
