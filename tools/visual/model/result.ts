// SPDX-License-Identifier: MIT
// A value, or the reason why there is none, for actions that can be refused: an edit, a file. The messages are in view/texts/.

export type RefusalCode =
    | 'no-such-page' // not 0..127
    | 'trim-page' // page 0 holds a robot's trim, not a motion
    | 'page-damaged' // its checksum or a field is wrong; replace or clear it
    | 'page-in-use' // the target already holds a page
    | 'page-changed' // it is another one than when the person was asked
    | 'page-empty' // there is nothing to copy or move
    | 'no-room' // not enough free pages
    | 'no-such-step'
    | 'steps-full' // at most seven steps
    | 'bad-name' // at most 13 ASCII characters
    | 'bad-number' // out of range; `words` has the details
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
