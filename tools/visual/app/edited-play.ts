// SPDX-License-Identifier: MIT
// Playing what is edited. The firmware plays what is in flash: the page and those that it leads to are written first, through
// Edit, as far as the robot has them otherwise.

import { pageOf } from '../model/document.ts';
import type { MotionDocument } from '../model/document.ts';
import { LINK_FIELDS, PARTNER_FIELDS, readPage } from '../model/page.ts';
import type { PageFormat } from '../model/page-format.ts';
import { readPages } from '../robot/page-read.ts';
import { PageWrite } from '../robot/page-write.ts';
import type { Requests } from '../robot/requests.ts';

/** The page and all that it can lead to: links, exits, blend partners. */
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

/** Pages of `wanted` that the robot has otherwise, and all of the robot's pages. */
export async function differing(requests: Requests, document: MotionDocument, wanted: readonly number[], known: readonly (Uint8Array | null)[]) {
  const robot = await readPages(requests, { known: (page) => [pageOf(document, page), known[page] ?? null].filter((bytes) => bytes !== null) });
  const pages = wanted.flatMap((page) => {
    const [before, after] = [robot[page], pageOf(document, page)];
    return before && before.some((byte, i) => byte !== after[i]) ? [{ page, before, after }] : [];
  });
  return { robot, pages };
}

/** Writes them; the robot's pages afterwards. */
export async function writePages(requests: Requests, format: PageFormat, { robot, pages }: Awaited<ReturnType<typeof differing>>): Promise<Uint8Array[]> {
  if (pages.length > 0) await new PageWrite(pages, format.empty).run(requests);
  const after = new Map(pages.map((one) => [one.page, one.after]));
  return robot.map((bytes, page) => after.get(page) ?? bytes);
}
