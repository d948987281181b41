// SPDX-License-Identifier: MIT
// A set of motions: 128 pages. Page 0 is the trim of the robot that they were read from. A document is a value: pages are never changed in
// place, and unchanged pages stay the same object.

import { PAGE_BYTES, PAGE_COUNT } from './motion.ts';
import type { PageFormat } from './page-format.ts';
import type { Change } from './transaction.ts';

export interface MotionDocument {
    readonly name: string;
    readonly pages: readonly Uint8Array[];
}

export function emptyDocument(format: PageFormat, name: string): MotionDocument {
    return { name, pages: Array.from({ length: PAGE_COUNT }, () => format.empty) };
}

/** From the 65,536 bytes of a motion area. Throws RangeError for another length. */
export function documentFrom(image: Uint8Array, name: string): MotionDocument {
    if (image.length !== PAGE_BYTES * PAGE_COUNT) throw new RangeError(`a motion area has 65,536 bytes, not ${image.length}`);
    return { name, pages: Array.from({ length: PAGE_COUNT }, (_, page) => image.slice(page * PAGE_BYTES, (page + 1) * PAGE_BYTES)) };
}

export function imageOf(document: MotionDocument): Uint8Array {
    const image = new Uint8Array(PAGE_BYTES * PAGE_COUNT);
    for (const [page, bytes] of document.pages.entries()) image.set(bytes, page * PAGE_BYTES);
    return image;
}

/** Page 0..127. Throws RangeError for another number. */
export function pageOf(document: MotionDocument, page: number): Uint8Array {
    const bytes = document.pages[page];
    if (!bytes) throw new RangeError(`no page ${page}`);
    return bytes;
}

export function isSamePage(a: Uint8Array, b: Uint8Array): boolean {
    return a === b || (a.length === b.length && a.every((byte, i) => byte === b[i]));
}

/** The name, or if it is taken, the next number of it: "walk (2)". */
export function freeName(name: string, taken: readonly string[]): string {
    if (!taken.includes(name)) return name;
    const base = name.replace(/ \(\d+\)$/, '');
    for (let count = 2; ; count++) {
        const free = `${base} (${count})`;
        if (!taken.includes(free)) return free;
    }
}

/** A copy's name that is not taken yet: "walk (copy)", "walk (copy 2)" ... word: "copy" in the person's language. */
export function copyName(name: string, taken: readonly string[], word: string): string {
    const base = name.replace(new RegExp(` \\(${word}( \\d+)?\\)$`), '');
    for (let count = 1; ; count++) {
        const copy = `${base} (${word}${count === 1 ? '' : ` ${count}`})`;
        if (!taken.includes(copy)) return copy;
    }
}

/** Returns the changed document. Throws if a page is not as its change expects it, which is a bug. */
export function withChanges(document: MotionDocument, changes: readonly Change[]): MotionDocument {
    const pages = [...document.pages];
    for (const { page, before, after } of changes) {
        const now = pages[page];
        if (!now || !isSamePage(now, before)) throw new Error(`page ${page} is not what this change began with`);
        pages[page] = after;
    }
    return { ...document, pages };
}

/** The first of these pages that the two documents do not have alike; undefined: none. */
export function firstDifferent(format: PageFormat, pages: readonly number[], a: MotionDocument, b: MotionDocument): number | undefined {
    return pages.find(page => !format.isSame(pageOf(a, page), pageOf(b, page)));
}
