// SPDX-License-Identifier: MIT
// A value, or why there is none. For what may be refused: an edit, a file. The sentences stand in view/texts/.

export type RefusalCode =
    | 'no-such-page' // not 0..127
    | 'trim-page' // page 0 holds the trim of a robot: no motion
    | 'page-damaged' // its checksum or a field is wrong: repair it by putting another page there, or clear it
    | 'page-in-use' // the target holds a page already
    | 'page-empty' // there is nothing to take
    | 'no-room' // not enough free pages
    | 'no-such-step'
    | 'steps-full' // seven steps are the most
    | 'bad-name' // 13 ASCII characters at most
    | 'bad-number' // out of its range: `words` tells which
    | 'no-such-joint';

export interface Refusal {
    readonly code: RefusalCode;
    readonly words: string;
}

export type Result<T> = { readonly ok: true; readonly value: T } | { readonly ok: false; readonly refusal: Refusal };

export function ok<T>(value: T): Result<T> {
    return { ok: true, value };
}

export function refuse(code: RefusalCode, words = ''): Result<never> {
    return { ok: false, refusal: { code, words } };
}
