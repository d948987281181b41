// SPDX-License-Identifier: MIT
// The pages that the keys of a remote lead to, from rest and from a playing page. Pure.

import type { PageFormat } from './page-format.ts';
import { readPage } from './page.ts';
import type { PageView } from './page.ts';

export interface KeyTarget {
    /** call: from rest; linked: at the end of the playing page; stop: its exit page; then: its next page, without a key. */
    readonly kind: 'call' | 'linked' | 'stop' | 'then';
    /** The remote's code; 0 for `stop` and `then`. */
    readonly code: number;
    readonly page: number;
    readonly name: string;
}

export type RobotPages = readonly (Uint8Array | null)[];
const KINDS = { next: 'then', exit: 'stop', linked1: 'linked', linked2: 'linked' } as const;

function view(format: PageFormat, pages: RobotPages, page: number): PageView | null {
    const bytes = pages[page];
    if (page === 0 || !bytes || format.isErased(bytes) || format.fault(bytes) !== null) return null;
    const read = readPage(format, bytes);
    return read.steps.length > 0 ? read : null;
}

/** The pages that each key or chord starts from rest, ordered by code. If several pages have the same code, the lowest is used. */
export function targetsFromRest(format: PageFormat, pages: RobotPages): KeyTarget[] {
    const calls = new Map<number, KeyTarget>();
    for (let page = pages.length - 1; page > 0; page--) {
        const read = view(format, pages, page);
        if (read && read.code !== 0) calls.set(read.code, { kind: 'call', code: read.code, page, name: read.name });
    }
    return [...calls.values()].sort((a, b) => a.code - b.code);
}

/** Where the page leads at its end: first with keys, then without one, then on a stop. */
export function targetsFrom(format: PageFormat, pages: RobotPages, page: number): KeyTarget[] {
    const bytes = pages[page];
    if (page === 0 || !bytes) return [];
    const order = ['linked', 'then', 'stop'];
    const targets = format.leads(bytes).flatMap(({ to, kind, code }) => {
        const name = view(format, pages, to)?.name;
        return name === undefined || kind === 'blendRight' || kind === 'blendLeft' ? [] : [{ kind: KINDS[kind], code, page: to, name }];
    });
    return targets.sort((a, b) => order.indexOf(a.kind) - order.indexOf(b.kind));
}
