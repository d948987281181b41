// SPDX-License-Identifier: MIT
// Compares the document with a robot, a backup, another document or a file, page by page, in pictures and in m512's words. Pages can be
// copied into the document or written to the robot.

import { documentFrom, imageOf, pageOf } from '../../model/document.ts';
import type { MotionDocument } from '../../model/document.ts';
import type { EditorState } from '../../model/editor-state.ts';
import { readPage } from '../../model/page.ts';
import { define, make } from '../element.ts';
import type { TransferState } from '../session/transfer.ts';
import { comparables, pagesOf } from './compared.ts';
import { ghosts } from './ghosts.ts';
import { transferText } from '../texts/editor.ts';
import { TEXTS } from '../texts/texts.ts';
import { SessionElement } from '../session-element.ts';
import './compare-dialog.css';

/** Lines of text that a page shows before it is expanded. */
const LINES = 4;

export class CompareDialog extends SessionElement {
    private readonly which = make('select', { 'aria-label': TEXTS.compare.withLabel, onchange: () => void this.choose() });
    private readonly chooser = make('input', {
        type: 'file',
        hidden: true,
        'aria-label': TEXTS.compare.fileLabel,
        onchange: () => void this.chosenFile(),
    });
    private readonly another = make('button', { onclick: () => this.chooser.click() }, TEXTS.compare.file);
    private readonly rows = make('ul', { class: 'rows', 'aria-label': TEXTS.compare.differing });
    private readonly status = make('p', { class: 'status', role: 'status', 'aria-label': TEXTS.compare.transfer });
    private readonly bar = make('progress', { hidden: true, 'aria-label': TEXTS.compare.progress });
    private readonly go = make('button', { class: 'primary', onclick: () => void this.action() });
    private readonly stop = make('button', { hidden: true, onclick: () => this.cancel() }, TEXTS.page.stop);
    private readonly again = make('button', { hidden: true, onclick: () => void this.tryAgain() }, TEXTS.compare.tryAgain);
    private readonly shut = make('button', { onclick: () => this.dialog.close() }, TEXTS.page.close);
    private readonly reread = make('button', { onclick: () => void this.readAgain() }, TEXTS.compare.readAgain);
    private readonly dialog = make('dialog', {
        class: 'compare',
        'aria-label': TEXTS.compare.title,
        onclose: () => this.reading !== null && this.session.files.cancel(),
    });
    private file: { readonly title: string; readonly pages: readonly Uint8Array[] } | null = null;
    /** Text on the file being read, and why the last one could not be read; null: none. */
    private reading: string | null = null;
    private trouble: string | null = null;
    private other: readonly (Uint8Array | null)[] = [];
    /** The document that the list is of. */
    private shown!: MotionDocument;
    /** What was last known of the robot's pages, and the document's. */
    private robot: readonly (Uint8Array | null)[] = [];
    private ours: readonly Uint8Array[] = [];
    private readonly ticks = new Map<number, HTMLInputElement>();
    private readonly marks = new Map<number, HTMLElement>();
    private looked = 0;

    connectedCallback(): void {
        this.dialog.replaceChildren(
            make(
                'header',
                {},
                make('h2', {}, TEXTS.compare.title),
                make('label', {}, TEXTS.compare.with, ' ', this.which),
                this.another,
                this.chooser,
                this.reread,
            ),
            make('p', { class: 'purpose' }, TEXTS.compare.purpose),
            this.rows,
            make('footer', {}, this.status, this.bar, this.stop, this.again, this.go, this.shut),
        );
        this.replaceChildren(this.dialog);
        const { transfer, editor } = this.session;
        this.disposals.push(
            transfer.state.watch(state => this.dialog.open && this.renderTransfer(state)),
            editor.state.watch(state => this.sidesChanged(state)),
        );
    }

    async open(): Promise<void> {
        this.trouble = null;
        this.fillWhich('robot');
        this.looked++; // what is read for an earlier comparison is for that one
        this.clear();
        if (!this.dialog.open) this.dialog.showModal();
        await this.readRobot();
    }

    private get key(): string {
        return this.which.value;
    }

    private fillWhich(key: string): void {
        const all = [...comparables(this.session), ...(this.file ? [{ key: 'file', title: this.file.title }] : [])];
        this.which.replaceChildren(...all.map(one => make('option', { value: one.key }, one.title)));
        this.which.value = key;
    }

    private choose(): Promise<void> {
        this.trouble = null;
        return this.look();
    }

    private async readRobot(): Promise<void> {
        const { isDone } = await this.session.transfer.read();
        if (!isDone) await this.look(); // otherwise sidesChanged() has
    }

    /** The page reads the robot by itself, too, when the cable leads to another one; and the document changes by a file that is dropped on
     *  the dialog. The list is then made anew, except during a write, which shows what became of each page. */
    private sidesChanged({ robot, document }: EditorState): void {
        const isRobot = this.key === 'robot';
        const isSame = document.pages === this.ours && (robot === this.robot || !isRobot);
        this.robot = robot;
        this.ours = document.pages;
        if (isSame || !this.dialog.open || (isRobot && this.session.transfer.state.get().phase === 'writing')) return;
        void this.look();
    }

    private readAgain(): Promise<void> {
        this.trouble = null;
        return this.readRobot();
    }

    private async tryAgain(): Promise<void> {
        this.trouble = null;
        await this.session.transfer.tryAgain();
        await this.look();
    }

    private async chosenFile(): Promise<void> {
        const file = this.chooser.files?.[0];
        this.chooser.value = '';
        if (!file) return;
        this.reading = TEXTS.files.reading(file.name);
        this.trouble = null;
        this.renderTransfer(this.session.transfer.state.get());
        const found = await this.session.files.look(file);
        this.reading = null;
        if (found.kind === 'read') {
            this.file = { title: file.name, pages: documentFrom(found.image, file.name).pages };
            this.fillWhich('file');
            return this.choose();
        }
        this.trouble = found.kind === 'refused' ? found.text : TEXTS.files.notRead(file.name);
        this.renderTransfer(this.session.transfer.state.get());
    }

    private cancel(): void {
        if (this.reading !== null) this.session.files.cancel();
        else this.session.transfer.cancel();
    }

    private async look(): Promise<void> {
        const mine = ++this.looked;
        const { session, key } = this;
        const found = key === 'file' ? this.file?.pages : await pagesOf(session, key);
        if (mine !== this.looked) return;
        this.clear();
        this.other = found ?? [];
        const { document } = session.editor.state.get();
        this.shown = document;
        const pages = this.other.flatMap((bytes, page) =>
            bytes && !session.editor.format.isSame(bytes, pageOf(document, page)) ? [page] : [],
        );
        this.rows.append(...pages.map(page => this.row(page)));
        if (pages.length === 0 && found) this.rows.append(make('li', { class: 'same' }, TEXTS.compare.same));
        this.renderTransfer(session.transfer.state.get());
        if (pages.length > 0) void this.addWords(mine);
    }

    private clear(): void {
        this.other = [];
        this.ticks.clear();
        this.marks.clear();
        this.rows.replaceChildren();
    }

    private row(page: number): HTMLElement {
        const { session } = this;
        const { format } = session.editor;
        const ours = pageOf(this.shown, page);
        const theirs = this.other[page] ?? format.empty;
        const [mine, other] = [readPage(format, ours), readPage(format, theirs)];
        const isRobot = this.key === 'robot';
        const source = isRobot ? ours : theirs;
        const tick = make('input', {
            type: 'checkbox',
            checked: page > 0,
            disabled: (isRobot && page === 0) || format.fault(source) !== null,
        });
        if (tick.disabled) tick.checked = false;
        tick.addEventListener('change', () => this.renderTransfer(session.transfer.state.get()));
        this.ticks.set(page, tick);
        const title = TEXTS.motion.title(page, (isRobot ? mine.name : other.name) || mine.name || other.name);
        const mark = make('span', { class: 'account' });
        this.marks.set(page, mark);
        const pictures = page === 0 ? null : isRobot ? ghosts(session.body, other, mine) : ghosts(session.body, mine, other);
        const { compare } = TEXTS;
        const [words, label] = isRobot ? [compare.takeRobots, compare.takeRobotsNamed(title)] : [compare.take, compare.takeNamed(title)];
        const take = make(
            'button',
            { 'aria-label': label, disabled: format.fault(theirs) !== null, onclick: () => void this.takeOver([page]) },
            words,
        );
        const note = page === 0 ? TEXTS.links.trimStays : format.fault(source) !== null ? TEXTS.compare.damagedStays : '';
        return make(
            'li',
            { 'data-page': page },
            make('label', {}, tick, make('b', {}, title)),
            mark,
            take,
            pictures,
            make('div', { class: 'words' }, note || TEXTS.compare.wordsComing),
        );
    }

    /** Adds m512's descriptions of the differences. Loading m512 the first time takes some seconds. */
    private async addWords(mine: number): Promise<void> {
        const { format } = this.session.editor;
        const ours = imageOf(this.shown);
        const theirs = imageOf({ name: '', pages: this.other.map(bytes => bytes ?? format.empty) });
        const images = this.key === 'robot' ? ([theirs, ours] as const) : ([ours, theirs] as const);
        const differences = await this.session.files.formats.differences(...images).catch(() => null);
        if (mine !== this.looked) return;
        for (const [page] of this.ticks) {
            const words = this.rows.querySelector(`[data-page="${page}"] .words`);
            const lines = differences?.filter(one => one.page === page).map(one => one.text.replace(/^page \d+( "[^"]*")?(, |: ?)?/, ''));
            if (!lines) words?.replaceChildren(TEXTS.compare.noWords);
            else if (lines.length > 0) words?.replaceChildren(...this.wordsOf(lines));
        }
    }

    private wordsOf(lines: readonly string[]): HTMLElement[] {
        const list = (some: readonly string[]): HTMLElement => make('ul', { lang: 'en' }, ...some.map(line => make('li', {}, line)));
        if (lines.length <= LINES + 1) return [list(lines)];
        return [
            list(lines.slice(0, LINES)),
            make('details', {}, make('summary', {}, TEXTS.compare.more(lines.length - LINES)), list(lines.slice(LINES))),
        ];
    }

    private get chosen(): number[] {
        return [...this.ticks].filter(([, tick]) => tick.checked).map(([page]) => page);
    }

    private async action(): Promise<void> {
        this.trouble = null;
        if (this.key !== 'robot') return this.takeOver(this.chosen);
        const { shown } = this;
        const end = await this.session.transfer.write(this.chosen, this.other, shown);
        this.fillWhich(this.key); // adds the new backup
        if (end.isDone || end.error.code === 'page-changed' || shown.pages !== this.ours) await this.look();
    }

    private async takeOver(pages: readonly number[]): Promise<void> {
        const { editor } = this.session;
        const taken = new Map(pages.map(page => [page, this.other[page] ?? editor.format.empty]));
        editor.dispatch(editor.edits.replacePages(editor.state.get().document, taken));
        await this.look();
    }

    /** If the focused control was removed, hidden or disabled, the focus moves to the next useful one. */
    private keepFocus(): void {
        const { activeElement } = document;
        const isThere = activeElement !== null && this.dialog.contains(activeElement) && !activeElement.matches(':disabled, [hidden]');
        if (!this.dialog.open || isThere) return;
        const isDone = this.session.transfer.state.get().phase === 'written';
        const row = isDone ? null : this.rows.querySelector<HTMLElement>('button:enabled');
        const next = [this.stop, this.again].find(button => !button.hidden) ?? row ?? this.shut;
        next.focus({ preventScroll: true });
    }

    private renderTransfer(state: TransferState): void {
        const isRobot = this.key === 'robot';
        const isMoving = state.phase === 'reading' || state.phase === 'writing';
        const isBusy = isMoving || this.reading !== null;
        const count = this.chosen.length;
        const isBad = this.reading === null && (this.trouble !== null || (isRobot && state.phase === 'stopped'));
        this.status.textContent = this.reading ?? this.trouble ?? (isRobot ? transferText(state, this.session.state.get()) : '');
        this.status.dataset.tone = isBad ? 'bad' : 'calm';
        this.bar.hidden = !isMoving;
        this.bar.max = Math.max(1, state.total);
        this.bar.value = state.done;
        this.another.disabled = this.reading !== null;
        this.stop.hidden = !isBusy;
        this.stop.textContent = this.reading === null ? TEXTS.page.stop : TEXTS.page.cancel;
        this.again.hidden = !isRobot || state.phase !== 'stopped';
        this.reread.hidden = !isRobot;
        this.go.disabled = isBusy || count === 0;
        this.go.textContent = isRobot ? TEXTS.compare.writeCount(count) : TEXTS.compare.takeCount(count);
        for (const [page, mark] of this.marks) {
            const account = isRobot ? state.account.get(page) : undefined;
            mark.textContent = account ? TEXTS.compare.accounts[account] : '';
        }
        this.keepFocus();
    }
}

define('compare-dialog', CompareDialog);
