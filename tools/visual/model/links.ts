// SPDX-License-Identifier: MIT
// Which page leads to which, and what is odd about it: links that end nowhere, pages that nothing leads to, stops that never
// stop. Pure.

import type { MotionDocument } from './document.ts';
import type { PageFormat } from './page-format.ts';
import { readPage } from './page.ts';
import type { LinkField, PageView } from './page.ts';

export interface PageLink {
  readonly from: number;
  readonly to: number;
  readonly kind: LinkField;
  /** The remote's code that chooses it; 0 for links without one. */
  readonly code: number;
  /** There is nothing to play where it leads. */
  readonly isDead: boolean;
}

export interface PageNode {
  readonly page: number;
  readonly name: string;
  readonly code: number;
  /** No code calls it, and no page that is called leads to it. It can be played by its number only. */
  readonly isUnreachable: boolean;
  /** Its exit links go round in a circle: a stop does not come to a page that ends. */
  readonly exitsRound: boolean;
}

export interface LinkGraph {
  readonly nodes: readonly PageNode[];
  readonly links: readonly PageLink[];
}

/** The links of a page that are ever followed: linked pages need a code. */
export function linksOf(page: number, view: PageView): Omit<PageLink, 'isDead'>[] {
  const all: readonly (readonly [LinkField, number, number, boolean])[] = [
    ['next', view.next, 0, true], ['exit', view.exit, 0, true],
    ['linked1', view.linked1, view.linked1Code, view.linked1Code !== 0], ['linked2', view.linked2, view.linked2Code, view.linked2Code !== 0],
    ['blendRight', view.blendRight, 0, true], ['blendLeft', view.blendLeft, 0, true],
  ];
  return all.flatMap(([kind, to, code, isUsed]) => (to !== 0 && isUsed ? [{ from: page, to, kind, code }] : []));
}

/** The pages that hold a motion, and what leads from one to another. */
export function linkGraph(format: PageFormat, document: MotionDocument): LinkGraph {
  const views = new Map(document.pages.flatMap((bytes, page) =>
    (page > 0 && !format.isErased(bytes) && format.fault(bytes) === null && readPage(format, bytes).steps.length > 0 ? [[page, readPage(format, bytes)] as const] : [])));
  const links = [...views].flatMap(([page, view]) => linksOf(page, view)).map((link) => ({ ...link, isDead: !views.has(link.to) }));
  const called = [...views].filter(([, view]) => view.code !== 0).map(([page]) => page);
  const reached = reachedFrom(called, links);
  const round = exitCircles(links);
  const nodes = [...views].map(([page, { name, code }]) => ({ page, name, code, isUnreachable: !reached.has(page), exitsRound: round.has(page) }));
  return { nodes, links };
}

function reachedFrom(pages: readonly number[], links: readonly PageLink[]): ReadonlySet<number> {
  const reached = new Set(pages);
  for (const page of reached) for (const link of links) if (link.from === page) reached.add(link.to); // a Set hands out what is added meanwhile
  return reached;
}

/** Pages whose exit links, followed on, come round to a page that was there before. */
function exitCircles(links: readonly PageLink[]): ReadonlySet<number> {
  const exit = new Map(links.filter((link) => link.kind === 'exit' && !link.isDead).map((link) => [link.from, link.to]));
  const round = new Set<number>();
  for (const start of exit.keys()) {
    const seen = new Set([start]);
    for (let page = exit.get(start); page !== undefined; page = exit.get(page)) {
      if (seen.has(page)) {
        round.add(start);
        break;
      }
      seen.add(page);
    }
  }
  return round;
}
