// SPDX-License-Identifier: MIT
// What the page remembers of the user between visits, apart from documents: things done once, language and theme, pages on their way to a
// robot (app/sent-pages.ts), and the kind of the servo adapter (app/serial-ports.ts).

export type Remembered = 'begun' | 'all-areas' | 'language' | 'theme' | 'half-sent' | 'adapter';

const keyOf = (what: Remembered): string => `motion512.${what}`;

/** null also if the browser stores nothing. */
export function recall(what: Remembered): string | null {
    try {
        return localStorage.getItem(keyOf(what));
    } catch {
        return null;
    }
}

/** Ignores errors: if the browser stores nothing, the page only makes the same offers at the next visit. */
export function store(what: Remembered, value: string): void {
    try {
        localStorage.setItem(keyOf(what), value);
    } catch {
        return;
    }
}

/** false also if the browser stores nothing. */
export function isRemembered(what: Remembered): boolean {
    return recall(what) !== null;
}

export function remember(what: Remembered): void {
    store(what, '1');
}
