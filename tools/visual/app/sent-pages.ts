// SPDX-License-Identifier: MIT
// Keeps the pages that were sent and perhaps not saved (robot/half-sent.ts) over a reload.

import { PAGE_BYTES } from '../model/motion.ts';
import type { KeptPages, SentPage } from '../robot/half-sent.ts';
import { recall, store } from '../view/remembered.ts';

/** What is stored of a page: its number, and its bytes before and after in hexadecimal digits. */
type Stored = readonly [page: number, before: string, after: string];

export const SENT_PAGES: KeptPages = {
    load: () => read(recall('half-sent') ?? '[]'),
    store: pages => store('half-sent', JSON.stringify(pages.map(({ page, before, after }) => [page, hex(before), hex(after)]))),
};

function read(text: string): SentPage[] {
    try {
        const pages = (JSON.parse(text) as Stored[]).map(([page, before, after]) => ({ page, before: bytes(before), after: bytes(after) }));
        return pages.every(one => one.before.length === PAGE_BYTES && one.after.length === PAGE_BYTES) ? pages : [];
    } catch {
        return []; // not of this page, or of another version: the robot is then asked about as if nothing were known
    }
}

function hex(of: Uint8Array): string {
    return Array.from(of, byte => byte.toString(16).padStart(2, '0')).join('');
}

function bytes(of: string): Uint8Array {
    return Uint8Array.from(of.match(/../g) ?? [], pair => Number.parseInt(pair, 16));
}
