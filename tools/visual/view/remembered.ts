// SPDX-License-Identifier: MIT
// What the page remembers of a person between visits, beside the documents: that something has been done once.

export type Remembered = 'begun' | 'all-areas';

const keyOf = (what: Remembered): string => `motion512.${what}`;

/** false also where the browser keeps nothing. */
export function isRemembered(what: Remembered): boolean {
    try {
        return localStorage.getItem(keyOf(what)) !== null;
    } catch {
        return false;
    }
}

/** A browser that keeps nothing offers the same again at the next visit; nobody needs to be told. */
export function remember(what: Remembered): void {
    try {
        localStorage.setItem(keyOf(what), '1');
    } catch {
        return;
    }
}
