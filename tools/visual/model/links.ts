// SPDX-License-Identifier: MIT
// The links between pages and their faults: links that lead nowhere, pages that cannot be reached, stops that never end. Pure.

import { pageOf } from './document.ts';
import type { MotionDocument } from './document.ts';
import type { Lead } from './motion.ts';
import type { PageFormat } from './page-format.ts';
import { readPage } from './page.ts';

export interface PageLink extends Lead {
    readonly from: number;
    /** The target has nothing to play. */
    readonly isDead: boolean;
}

export interface PageNode {
    readonly page: number;
    readonly name: string;
    readonly code: number;
    /** No code calls it, and no called page leads to it. It can be played only by its number. */
    readonly isUnreachable: boolean;
    /** Its exit links form a circle, so a stop never reaches a page that ends. */
    readonly exitsRound: boolean;
}

export interface LinkGraph {
    readonly nodes: readonly PageNode[];
    readonly links: readonly PageLink[];
}

/** The pages that hold a motion, and the links between them. */
export function linkGraph(format: PageFormat, document: MotionDocument): LinkGraph {
    const views = new Map(
        document.pages.flatMap((bytes, page) =>
            page > 0 && !format.isErased(bytes) && format.fault(bytes) === null && readPage(format, bytes).steps.length > 0
                ? [[page, readPage(format, bytes)] as const]
                : [],
        ),
    );
    const links = [...views.keys()].flatMap(from =>
        format.leads(pageOf(document, from)).map(lead => ({ ...lead, from, isDead: !views.has(lead.to) })),
    );
    const reached = format.reachByCode(document);
    const round = format.exitCircles(document);
    const nodes = [...views].map(([page, { name, code }]) => ({
        page,
        name,
        code,
        isUnreachable: !reached.has(page),
        exitsRound: round.has(page),
    }));
    return { nodes, links };
}
