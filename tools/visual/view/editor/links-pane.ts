// SPDX-License-Identifier: MIT
// The area Links: the graph of all pages, and the links of the chosen one as a list. A page is chosen by click, arrow keys (nearest page in
// that direction) or in the list. A link is set by a drag from page to page or in the list.

import { linkGraph } from '../../model/links.ts';
import type { LinkGraph } from '../../model/links.ts';
import type { MotionDocument } from '../../model/document.ts';
import { define, keepFocus, make } from '../element.ts';
import { LINK_FIELDS, PARTNER_FIELDS } from '../../model/page.ts';
import type { LinkField } from '../../model/page.ts';
import { ask } from './ask-dialog.ts';
import { dispatchAsked } from './asked.ts';
import { linkChart, markChart } from './link-chart.ts';
import { linkList } from './link-list.ts';
import { titleOf } from '../texts/editor.ts';
import { TEXTS } from '../texts/texts.ts';
import { SessionElement } from '../session-element.ts';
import './links-pane.css';

export class LinksPane extends SessionElement {
    private readonly chart = make('div', { class: 'chart' });
    private readonly list = make('div', { class: 'list' });
    private graph: LinkGraph = { nodes: [], links: [] };
    private drawn: MotionDocument | null = null;
    /** The page whose links are listed; null: none. */
    private listed: number | null = null;
    private pulled = 0;

    connectedCallback(): void {
        this.replaceChildren(
            make('p', { class: 'purpose' }, TEXTS.links.purpose),
            this.chart,
            make(
                'p',
                { class: 'legend' },
                ...(['next', 'exit', 'linked', 'blend', 'dead'] as const).map(kind =>
                    make('span', { class: kind }, TEXTS.links.legend[kind]),
                ),
            ),
            this.list,
        );
        this.chart.addEventListener('keydown', event => this.key(event));
        this.chart.addEventListener('dblclick', () => this.dispatchEvent(new CustomEvent('open-steps', { bubbles: true })));
        this.chart.addEventListener('pointerdown', event => {
            this.pulled = pageAt(event);
            this.chart.setPointerCapture(event.pointerId); // a release outside the chart ends the drag, too
        });
        // A finger that begins on a motion links it; elsewhere it scrolls. Browsers do not take `touch-action` of a part of an SVG.
        this.chart.addEventListener('touchmove', event => void (this.pulled !== 0 && event.preventDefault()), { passive: false });
        this.chart.addEventListener('pointermove', event => this.pull(event));
        this.chart.addEventListener('pointerup', event => void this.drop(event));
        this.chart.addEventListener('pointercancel', () => this.letGo());
        this.disposals.push(
            this.session.editor.state.watch(() => this.render()),
            this.session.state.watch(() => queueMicrotask(() => this.render())),
        ); // by then the area is visible and has a width
    }

    private render(): void {
        const { editor, state } = this.session;
        const { document, page, gesture } = editor.state.get();
        const { tab, where } = state.get();
        if (tab !== 'links') return;
        if (document !== this.drawn && !gesture) this.draw(document);
        const playing = where?.state === 'playing' ? where.page : 0;
        markChart(this.chart, { selected: page, playing });
        if (page === this.listed) return;
        this.listed = page;
        keepFocus(this.list, () =>
            this.list.replaceChildren(...(page === 0 ? [make('p', {}, TEXTS.links.trimStays)] : linkList(editor, this.graph, page))),
        );
        this.centre(this.chart.querySelector('.node.selected'));
    }

    /** Scrolls only the chart, unlike scrollIntoView(). */
    private centre(node: Element | null): void {
        if (!node) return;
        const [at, room] = [node.getBoundingClientRect(), this.chart.getBoundingClientRect()];
        this.chart.scrollBy({ left: at.x + at.width / 2 - room.x - room.width / 2, top: at.y + at.height / 2 - room.y - room.height / 2 });
    }

    private draw(document: MotionDocument): void {
        this.drawn = document;
        this.listed = null;
        const hadFocus = this.chart.contains(window.document.activeElement);
        this.graph = linkGraph(this.session.editor.format, document);
        this.chart.replaceChildren(
            this.graph.nodes.length > 0 ? linkChart(this.graph, this.chart.clientWidth) : make('p', {}, TEXTS.links.none),
        );
        if (hadFocus) this.focusPage(this.session.editor.state.get().page);
    }

    private focusPage(page: number): void {
        this.chart.querySelector<SVGElement>(`.node[data-page="${page}"]`)?.focus();
    }

    private choose(page: number): void {
        this.session.editor.select({ page });
        this.focusPage(page);
    }

    private pull(event: PointerEvent): void {
        const over = pageAt(event);
        const isPulling = this.pulled !== 0 && event.buttons === 1 && over !== this.pulled;
        this.chart.classList.toggle('pulling', isPulling);
        for (const node of this.chart.querySelectorAll<SVGElement>('.node'))
            node.classList.toggle('over', isPulling && Number(node.dataset.page) === over);
    }

    private letGo(): void {
        this.pulled = 0;
        this.chart.classList.remove('pulling');
    }

    private async drop(event: PointerEvent): Promise<void> {
        const [from, to] = [this.pulled, pageAt(event)];
        this.letGo();
        if (from === 0 || to === 0) return;
        if (from === to) return this.choose(from);
        const { editor } = this.session;
        const { document } = editor.state.get();
        const kinds: readonly LinkField[] = [...LINK_FIELDS, ...PARTNER_FIELDS];
        const answer = await ask(
            TEXTS.links.ask,
            TEXTS.links.which(titleOf(editor, from), titleOf(editor, to)),
            kinds.map(kind => [TEXTS.links.names[kind], kind]),
        );
        const kind = answer as LinkField; // one of `kinds`
        if (answer) dispatchAsked(editor, document, [from, to], now => editor.edits.setLink(now, from, kind, to));
        this.choose(from);
    }

    /** Arrows go to the nearest page in that direction; Enter opens the page's steps. */
    private key(event: KeyboardEvent): void {
        const at = event.target instanceof Element ? event.target.closest<SVGElement>('.node') : null;
        if (event.key === 'Enter') {
            if (at) this.choose(Number(at.dataset.page));
            return void this.dispatchEvent(new CustomEvent('open-steps', { bubbles: true }));
        }
        const way = ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] } as const)[event.key];
        const here = (at ?? this.chart.querySelector('.node.selected'))?.getBoundingClientRect();
        if (!way || !here) return;
        event.preventDefault();
        const [dx, dy] = way;
        let best = { page: 0, far: Number.POSITIVE_INFINITY };
        for (const node of this.chart.querySelectorAll<SVGElement>('.node:not(.dead)')) {
            const there = node.getBoundingClientRect();
            const along = (there.x - here.x) * dx + (there.y - here.y) * dy;
            const across = Math.abs((there.x - here.x) * dy) + Math.abs((there.y - here.y) * dx);
            if (along > 4 && along + 2 * across < best.far) best = { page: Number(node.dataset.page), far: along + 2 * across };
        }
        if (best.page !== 0) this.choose(best.page);
    }
}

/** The page under the pointer; 0: none. */
function pageAt(event: PointerEvent): number {
    const node = document.elementFromPoint(event.clientX, event.clientY)?.closest<SVGElement>('.node');
    return Number(node?.dataset.page ?? 0);
}

define('links-pane', LinksPane);
