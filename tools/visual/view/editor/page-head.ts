// SPDX-License-Identifier: MIT
// Header for the edited page: choose, rename, create and play it.

import { pageOf } from '../../model/document.ts';
import { PAGE_COUNT } from '../../model/motion.ts';
import { define, make, once, setDisabled, setText } from '../element.ts';
import { TypedFor } from './shown-for.ts';
import { TEXTS } from '../texts/texts.ts';
import { SessionElement } from '../session-element.ts';

/** Library pages that the user wants to edit directly, not as copies: in every area, but not in another document. */
const AGREED = new WeakSet<Uint8Array>();

export class PageHead extends SessionElement {
    private readonly choice = make('select', {
        'aria-label': TEXTS.steps.choose,
        onchange: () => this.session.editor.select({ page: Number(this.choice.value) }),
    });
    private readonly name = make('input', {
        type: 'text',
        maxlength: 13,
        'aria-label': TEXTS.steps.nameOf,
        placeholder: TEXTS.steps.name,
        spellcheck: 'false',
    });
    private readonly play = make(
        'button',
        { onclick: once(() => this.session.playEdited(this.session.editor.state.get().page)) },
        TEXTS.steps.play,
    );
    private readonly library = make('div', { class: 'library', role: 'status' });
    private readonly typedName = new TypedFor();
    private shown: readonly Uint8Array[] | null = null;

    connectedCallback(): void {
        this.name.addEventListener('input', () => this.typedName.type());
        this.name.addEventListener('change', () => this.rename());
        this.name.addEventListener('keydown', event => event.key === 'Enter' && this.rename());
        this.replaceChildren(
            this.choice,
            this.name,
            make('button', { title: TEXTS.steps.createHint, onclick: () => this.newPage() }, TEXTS.steps.create),
            make('span', { class: 'space' }),
            make(
                'span',
                { class: 'plays' },
                this.play,
                make('button', { class: 'stop', onclick: () => void this.session.command('stop') }, TEXTS.page.stop),
            ),
            this.library,
        );
        this.library.append(
            make('span', {}, TEXTS.steps.ofLibrary),
            make('button', { onclick: () => this.editCopy() }, TEXTS.steps.editsCopy),
            make('button', { onclick: () => this.agree() }, TEXTS.steps.editsItself),
        );
        this.watch(() => this.render(), this.session.editor.state, this.session.state);
    }

    private render(): void {
        const { editor } = this.session;
        const {
            page,
            document: { pages },
        } = editor.state.get();
        if (this.shown !== pages) this.list(pages);
        this.choice.value = String(page);
        this.library.classList.toggle('away', AGREED.has(pageOf(editor.state.get().document, page)) || !editor.isOfLibrary(page));
        if (!this.typedName.isHalfTyped(editor.state.get())) this.showName();
        setDisabled(this.play, editor.page(page).steps.length === 0);
        this.play.classList.toggle('primary', !this.play.disabled);
    }

    private list(pages: readonly Uint8Array[]): void {
        if (!this.shown) this.choice.replaceChildren(...pages.slice(1).map((_, i) => make('option', { value: i + 1 })));
        for (const [i, option] of [...this.choice.options].entries()) {
            const { name, steps } = this.session.editor.page(i + 1);
            setText(option, `${i + 1} ${name || (steps.length > 0 ? TEXTS.motion.nameless : '–')}`);
        }
        this.shown = pages;
    }

    private agree(): void {
        const { document: motions, page } = this.session.editor.state.get();
        AGREED.add(pageOf(motions, page));
        this.render();
        this.choice.focus();
    }

    private editCopy(): void {
        const { editor } = this.session;
        const { page, document } = editor.state.get();
        const copy = editor.edits.copyForEditing(document, page);
        if (!copy.ok) return void editor.dispatch(copy);
        if (editor.dispatch({ ok: true, value: copy.value.edit })) editor.select({ page: copy.value.page });
        this.name.focus();
    }

    /** The same text is not set again: that would move the cursor to its end. */
    private showName(): void {
        const { editor } = this.session;
        const { name } = editor.page(editor.state.get().page);
        if (this.name.value !== name) this.name.value = name;
    }

    private rename(): void {
        if (!this.typedName.take()) return;
        const { editor } = this.session;
        const { page, document } = editor.state.get();
        editor.dispatch(editor.edits.rename(document, page, this.name.value.trim()));
        this.showName(); // the current name: trimmed, or unchanged after a refusal
    }

    private newPage(): void {
        const { editor } = this.session;
        const { pages } = editor.state.get().document;
        const free = pages.findIndex((bytes, page) => page > 0 && page < PAGE_COUNT && editor.format.isEmpty(bytes));
        if (free < 0) return this.session.say({ text: TEXTS.steps.allUsed, tone: 'bad' });
        editor.select({ page: free, step: 0, steps: new Set([0]), joints: new Set() });
        this.name.focus();
    }
}

define('page-head', PageHead);
