// SPDX-License-Identifier: MIT
// What a play of a page can lead to.

import { pageOf } from './document.ts';
import type { MotionDocument } from './document.ts';
import { LINK_FIELDS, PARTNER_FIELDS, readPage } from './page.ts';
import type { PageFormat } from './page-format.ts';

/** The page, and all that its links, exits and blend partners lead to, in order. */
export function pagesOfPlay(format: PageFormat, document: MotionDocument, first: number): number[] {
  const found = new Set<number>();
  for (const waiting = [first]; waiting.length > 0;) {
    const page = waiting.pop();
    if (page === undefined || page === 0 || found.has(page)) continue;
    found.add(page);
    const view = readPage(format, pageOf(document, page));
    for (const field of [...LINK_FIELDS, ...PARTNER_FIELDS]) waiting.push(view[field]);
  }
  return [...found].sort((a, b) => a - b);
}
