// SPDX-License-Identifier: MIT
// A language for tests, made from English: accented letters, 40 % longer, in brackets. Plain English on the page then reveals text that is
// not from en.ts, and cut-off text would be cut off in German too. Arguments in a text stay unchanged.

import { EN } from './en.ts';
import type { Texts } from './texts.ts';

const PLAIN = 'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ';
const ACCENTED = 'àƀçďèƒĝĥìĵķļɱñöþɋŕšţùṽŵẋýžÀɃÇĎÈƑĜĤÌĴĶĻṀÑÖÞɊŔŠŢÙṼŴẊÝŽ';
const LONGER = 0.4;
/** Length of the filling's words: German has few longer ones. */
const WORD = 8;

function accented(text: string): string {
    return [...text].map(letter => ACCENTED[PLAIN.indexOf(letter)] ?? letter).join('');
}

/** The accented text with filling, which is split into words if the text has several. */
export function pseudo(text: string): string {
    if (!/[A-Za-z]/.test(text)) return text;
    const filling = 'ö'.repeat(Math.ceil(text.length * LONGER) - 1);
    const words = text.includes(' ') ? ` ${filling.replaceAll(new RegExp(`.{${WORD}}(?=.)`, 'g'), `$&${' '}`)}` : filling;
    return `[${accented(text)}${words}]`;
}

/** Protects arguments by replacing them with private-use characters, which occur in no text. */
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

export default pseudoOf(EN) as Texts; // has the same shape
