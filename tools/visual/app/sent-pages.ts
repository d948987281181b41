// SPDX-License-Identifier: MIT
// Keeps the pages that were sent and perhaps not saved (robot/half-sent.ts) over a reload.

import { PAGE_BYTES } from '../model/motion.ts';
import type { KeptPages, SentPage } from '../robot/half-sent.ts';
import { bytesOfHex, hexOf } from '../robot/hex.ts';
import { recall, store } from '../view/remembered.ts';

/** What is stored of a page: its number, and its bytes before and after in hexadecimal digits. */
type Stored = readonly [page: number, before: string, after: string];

export const SENT_PAGES: KeptPages = {
    load: () => read(recall('half-sent') ?? '[]'),
    store: pages => store('half-sent', JSON.stringify(pages.map(({ page, before, after }) => [page, hexOf(before), hexOf(after)]))),
};

function read(text: string): SentPage[] {
    try {
        const pages = (JSON.parse(text) as Stored[]).map(([page, before, after]) => ({
            page,
            before: bytesOfHex(before),
            after: bytesOfHex(after),
        }));
        return pages.every(one => one.before.length === PAGE_BYTES && one.after.length === PAGE_BYTES) ? pages : [];
    } catch {
        return []; // not of this page, or of another version: the robot is then asked about as if nothing were known
    }
}
