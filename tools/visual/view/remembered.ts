// SPDX-License-Identifier: MIT
// What the page remembers of a person between visits, beside the documents: that something has been done once.

export type Remembered = 'begun' | 'all-areas' | 'language';

const keyOf = (what: Remembered): string => `motion512.${what}`;

/** null also where the browser keeps nothing. */
export function recall(what: Remembered): string | null {
    try {
        return localStorage.getItem(keyOf(what));
    } catch {
        return null;
    }
}

/** A browser that keeps nothing offers the same again at the next visit; nobody needs to be told. */
export function store(what: Remembered, value: string): void {
    try {
        localStorage.setItem(keyOf(what), value);
    } catch {
        return;
    }
}

/** false also where the browser keeps nothing. */
export function isRemembered(what: Remembered): boolean {
    return recall(what) !== null;
}

export function remember(what: Remembered): void {
    store(what, '1');
}
