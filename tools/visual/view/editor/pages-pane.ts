// SPDX-License-Identifier: MIT
// The area Pages: all 128 pages of the document, to search, choose, copy, move, rename and clear by mouse and keyboard.

import { pageOf } from '../../model/document.ts';
import { dirtyPages } from '../../model/editor-state.ts';
import type { EditorState } from '../../model/editor-state.ts';
import { PAGE_COUNT } from '../../model/motion.ts';
import { define, make } from '../element.ts';
import { keyOf } from '../key-of.ts';
import { PageCard } from './page-card.ts';
import { PageActions } from './page-actions.ts';
import { TEXTS } from '../texts/texts.ts';
import { SessionElement } from '../session-element.ts';
import './pages-pane.css';

type Filter = 'all' | 'used' | 'changed';

export class PagesPane extends SessionElement {
    /** Opens the comparison with a robot, a backup or another document. */
    onCompare: () => void = () => undefined;
    private readonly cards: PageCard[] = [];
    private readonly search = make('input', {
        type: 'search',
        placeholder: TEXTS.motions.search,
        'aria-label': TEXTS.motions.searchLabel,
        oninput: () => this.filter(),
    });
    private readonly which = make(
        'select',
        { 'aria-label': TEXTS.motions.which, onchange: () => this.filter() },
        make('option', { value: 'all' }, TEXTS.motions.all),
        make('option', { value: 'used' }, TEXTS.motions.used),
        make('option', { value: 'changed' }, TEXTS.motions.changed),
    );
    private readonly list = make('div', { class: 'cards', role: 'listbox', 'aria-label': TEXTS.areas.titles.pages });
    private readonly nothing = make('p', { class: 'nothing', hidden: true }, TEXTS.motions.nothingFound);
    private actions!: PageActions; // needs the session
    private dragged = 0;
    private playing = -1;

    connectedCallback(): void {
        this.actions = new PageActions(this.session.editor, this.session.documents);
        this.makeCards();
        this.replaceChildren(make('p', { class: 'purpose' }, TEXTS.motions.purpose), this.tools(), this.list, this.nothing);
        this.listen();
        this.disposals.push(
            this.watchSight(),
            this.session.editor.state.watch(state => this.render(state)),
            this.session.state.watch(({ where }) => {
                const playing = where?.state === 'playing' ? where.page : -1;
                if (playing === this.playing) return;
                this.playing = playing;
                this.render(this.session.editor.state.get());
            }),
        );
    }

    private get current(): number {
        return this.session.editor.state.get().page;
    }

    private tools(): HTMLElement {
        const button = (title: string, action: () => unknown): HTMLButtonElement => make('button', { onclick: () => void action() }, title);
        return make(
            'div',
            { class: 'tools', role: 'toolbar', 'aria-label': TEXTS.motions.chosen },
            this.search,
            this.which,
            button(TEXTS.document.rename, () => this.actions.rename(this.current)),
            button(TEXTS.motions.transfer, () => this.actions.transferByNumber(this.current)),
            button(TEXTS.motions.clear, () => this.actions.clear(this.current)),
            button(TEXTS.motions.compare, () => this.onCompare()),
        );
    }

    private makeCards(): void {
        if (this.cards.length > 0) return;
        for (let page = 0; page < PAGE_COUNT; page++) {
            const card = new PageCard();
            Object.assign(card, { body: this.session.body, format: this.session.editor.format, page });
            this.cards.push(card);
        }
        this.list.append(...this.cards.slice(1), ...this.cards.slice(0, 1)); // page 0, the trim, comes last: it is no motion
    }

    private watchSight(): () => void {
        const sight = new IntersectionObserver(
            seen => {
                for (const { target, isIntersecting } of seen) if (isIntersecting && target instanceof PageCard) target.see();
            },
            { root: null, rootMargin: '200px' },
        );
        for (const card of this.cards) sight.observe(card);
        return () => sight.disconnect();
    }

    private render(state: EditorState): void {
        const dirty = dirtyPages(state, this.session.editor.format);
        for (const card of this.cards) {
            const { page } = card;
            card.show(pageOf(state.document, page), {
                isSelected: page === state.page,
                isDirty: dirty.has(page),
                isPlaying: page === this.playing,
            });
        }
        this.filter();
    }

    private filter(): void {
        const words = this.search.value.trim().toLowerCase();
        const which = this.which.value as Filter;
        let count = 0;
        for (const card of this.cards) {
            const isIn = which === 'all' || (which === 'changed' ? card.classList.contains('dirty') : !card.classList.contains('empty'));
            card.hidden = !isIn || !card.words.includes(words);
            if (!card.hidden) count++;
        }
        this.nothing.hidden = count > 0;
    }

    private listen(): void {
        const cardOf = (event: Event): PageCard | null =>
            event.target instanceof Element ? event.target.closest<PageCard>('page-card') : null;
        this.list.addEventListener('click', event => this.choose(cardOf(event)));
        this.list.addEventListener('focusin', event => {
            // keys act on the page with the focus, however it got it
            const page = cardOf(event)?.page ?? this.current;
            if (page !== this.current) this.session.editor.select({ page });
        });
        this.list.addEventListener('dblclick', event => cardOf(event) && this.openSteps());
        this.list.addEventListener('keydown', event => this.key(event));
        this.list.addEventListener('dragstart', event => {
            this.dragged = cardOf(event)?.page ?? 0;
            event.dataTransfer?.setData('text/plain', `page ${this.dragged}`);
        });
        this.list.addEventListener('dragover', event => {
            const over = cardOf(event);
            if (this.dragged === 0 || !over || over.page === 0) return;
            event.preventDefault();
            this.mark(over);
        });
        this.list.addEventListener('dragend', () => this.mark(null));
        this.list.addEventListener('drop', event => {
            const over = cardOf(event);
            if (this.dragged === 0 || !over) return;
            event.preventDefault();
            const from = this.dragged;
            this.mark(null);
            void this.actions.transfer(from, over.page);
        });
    }

    private mark(over: PageCard | null): void {
        if (!over) this.dragged = 0;
        for (const card of this.cards) card.classList.toggle('over', card === over);
    }

    private choose(card: PageCard | null): void {
        if (!card) return;
        this.session.editor.select({ page: card.page });
        card.focus();
    }

    private openSteps(): void {
        this.dispatchEvent(new CustomEvent('open-steps', { bubbles: true }));
    }

    private key(event: KeyboardEvent): void {
        const control = event.ctrlKey || event.metaKey;
        const action =
            this.move(event.key) ??
            {
                Enter: () => this.openSteps(),
                F2: () => this.actions.rename(this.current),
                Delete: () => this.actions.clear(this.current),
                ...(control && {
                    c: () => this.actions.take(this.current),
                    x: () => this.actions.take(this.current),
                    v: () => this.actions.putTaken(this.current),
                }),
            }[keyOf(event)];
        if (!action) return;
        event.preventDefault();
        void action();
    }

    /** Arrow keys move among the cards shown, in rows as laid out. */
    private move(key: string): (() => void) | undefined {
        const shown = this.cards
            .slice(1)
            .concat(this.cards.slice(0, 1))
            .filter(card => !card.hidden);
        const at = shown.findIndex(card => card.page === this.current);
        const top = shown[0]?.offsetTop;
        const below = shown.findIndex(card => card.offsetTop !== top);
        const columns = below > 0 ? below : shown.length; // all are in one row
        const to = {
            ArrowLeft: at - 1,
            ArrowRight: at + 1,
            ArrowUp: at - columns,
            ArrowDown: at + columns,
            Home: 0,
            End: shown.length - 1,
        }[key];
        const card = to === undefined ? undefined : (shown[to] ?? shown[at] ?? shown[0]);
        return card ? () => this.choose(card) : undefined;
    }
}

define('pages-pane', PagesPane);
