// SPDX-License-Identifier: MIT
// Reads all pages of a robot: the CRCs first, then only the pages that are not known here.

import { PAGE_COUNT } from '../model/motion.ts';
import { askPageCrcs } from './page-requests.ts';
import { REFUSED, askDensePage, askPage } from './protocol.ts';
import type { PageCrc } from './protocol.ts';
import { RobotError } from './robot-error.ts';
import type { Requests } from './requests.ts';

export interface ReadOptions {
    /** Candidates for a page. A page whose CRC matches one of them is not read. */
    readonly known?: (page: number) => readonly Uint8Array[];
    readonly progress?: (done: number, total: number) => void;
    readonly signal?: AbortSignal;
}

/** The 128 pages in flash. Rejects with RobotError. Can be cancelled at any time. */
export async function readPages(requests: Requests, crcOf: PageCrc, options: ReadOptions = {}): Promise<Uint8Array[]> {
    const { signal } = options;
    const asks = signal ? { signal } : {};
    const crcs = await askPageCrcs(requests, 0, PAGE_COUNT - 1, asks);
    const pages = crcs.map((crc, page) => options.known?.(page).find(bytes => crcOf(bytes) === crc));
    const missing = pages.flatMap((bytes, page) => (bytes ? [] : [page]));
    let ask = askDensePage;
    for (const [done, page] of missing.entries()) {
        options.progress?.(done, missing.length);
        pages[page] = await ask(requests, page, crcOf, asks).catch((error: unknown) => {
            if (!(error instanceof RobotError) || error.number !== REFUSED.noCommand) throw error;
            ask = askPage; // an older image
            return askPage(requests, page, crcOf, asks);
        });
    }
    options.progress?.(missing.length, missing.length);
    return pages as Uint8Array[]; // all missing pages have been read
}
