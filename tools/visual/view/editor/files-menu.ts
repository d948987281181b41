// SPDX-License-Identifier: MIT
// Opens files, also by drag and drop; saves files; makes links. A file that was read is shown first and imported only on request. The dialog
// is there from the press on: after the seconds that a file takes it would open over what somebody types by then.

import { SUFFIXES } from '../../model/file-formats.ts';
import type { Suffix } from '../../model/file-formats.ts';
import { onChoice } from '../choice.ts';
import { copyText } from '../clipboard.ts';
import { define, make } from '../element.ts';
import type { FilesState } from '../session/files.ts';
import { TEXTS } from '../texts/texts.ts';
import { SessionElement } from '../session-element.ts';
import './files-menu.css';

const ACCEPTED = '.m512,.bin,.img,.hex,.ihex,.mtn';
const FORGET_MS = 60_000; // a download has started by then

export class FilesMenu extends SessionElement {
    private readonly chooser = make('input', {
        type: 'file',
        accept: ACCEPTED,
        hidden: true,
        'aria-label': TEXTS.files.file,
        onchange: () => this.chosen(),
    });
    private readonly dialog = make('dialog', { 'aria-labelledby': 'files-title', oncancel: () => this.leave() });
    private shown: FilesState | null = null;

    connectedCallback(): void {
        const save = make(
            'select',
            { 'aria-label': TEXTS.files.saveLabel },
            make('option', { value: '' }, TEXTS.files.saveAs),
            ...SUFFIXES.map(suffix => make('option', { value: suffix }, `${TEXTS.files.types[suffix]} (${suffix})`)),
        );
        onChoice(save, suffix => {
            if (suffix !== '') void this.save(suffix as Suffix); // one of the options
            save.value = '';
        });
        this.replaceChildren(
            make('button', { onclick: () => this.chooser.click() }, TEXTS.files.open),
            save,
            make('button', { title: TEXTS.files.sendHint, onclick: () => void this.send() }, TEXTS.files.send),
            this.chooser,
            this.dialog,
        );
        this.listenTo(window, 'dragover', event => this.isFile(event) && event.preventDefault());
        this.listenTo(window, 'drop', event => void this.dropped(event));
        this.disposals.push(this.session.files.state.watch(state => this.render(state)));
    }

    private isFile(event: DragEvent): boolean {
        return event.dataTransfer?.types.includes('Files') ?? false;
    }

    private async dropped(event: DragEvent): Promise<void> {
        const [file, ...others] = event.dataTransfer?.files ?? [];
        if (!file || !this.isFile(event)) return;
        event.preventDefault();
        await this.session.files.choose(file, ...others);
    }

    private chosen(): void {
        const file = this.chooser.files?.[0];
        this.chooser.value = ''; // allows choosing the same file again
        if (file) void this.session.files.choose(file);
    }

    private async save(suffix: Suffix): Promise<void> {
        const saved = await this.session.files.save(suffix);
        if (!saved) return;
        const address = URL.createObjectURL(new Blob([saved.bytes as Uint8Array<ArrayBuffer>]));
        make('a', { href: address, download: saved.name }).click();
        setTimeout(() => URL.revokeObjectURL(address), FORGET_MS);
        if (saved.losses.length > 0)
            this.show(
                saved.name,
                [make('p', {}, TEXTS.files.losses(saved.name)), lines(saved.losses)],
                [this.closing(TEXTS.files.understood)],
            );
    }

    /** Copies a link to the selected page to the clipboard and shows it. */
    async send(): Promise<void> {
        const hash = await this.session.files.link();
        if (hash === null) return;
        const address = addressOf(hash);
        const isCopied = await copyText(address);
        const field = make('input', { type: 'text', readonly: true, value: address, 'aria-label': TEXTS.files.link });
        this.show(
            TEXTS.files.linkTitle,
            [make('p', {}, isCopied ? TEXTS.files.linkCopied : TEXTS.files.linkShown), field],
            [this.closing(TEXTS.page.close)],
        );
        field.select();
    }

    private render(state: FilesState): void {
        const { shown } = this;
        this.shown = state;
        const { busy, opened, tooLarge, trouble, done } = state;
        const isSame = (key: keyof FilesState): boolean => shown?.[key] === state[key];
        if ((['busy', 'opened', 'tooLarge', 'trouble', 'done'] as const).every(isSame)) return;
        this.dialog.setAttribute('aria-busy', String(busy !== null));
        if (busy !== null) this.showBusy(busy);
        else if (trouble !== null) this.show(TEXTS.files.failed, [make('p', {}, trouble)], [this.closing(TEXTS.page.close)]);
        else if (done) this.show(done.name, [make('p', {}, done.text)], [this.closing(TEXTS.page.close)]);
        else if (opened) this.showOpened(opened);
        else if (tooLarge)
            this.show(
                tooLarge.name,
                [make('p', {}, TEXTS.files.tooLarge(tooLarge.pages))],
                [
                    make('button', { onclick: () => void this.session.files.openWithoutRest() }, TEXTS.files.openWithoutRest),
                    this.closing(TEXTS.page.cancel),
                ],
            );
        else this.close();
    }

    /** The card in Motions that gets the focus back would choose its motion in place of one that was added. */
    private close(): void {
        const { editor } = this.session;
        const { page } = editor.state.get();
        this.dialog.close();
        if (editor.state.get().page !== page) editor.select({ page });
    }

    /** The focus is not on Cancel, or an Enter that is held a little too long would press it. */
    private showBusy(busy: string): void {
        this.show(busy, [], [make('button', { onclick: () => this.leave() }, TEXTS.page.cancel)]);
        this.dialog.querySelector('h2')?.focus();
    }

    private leave(): void {
        const { files } = this.session;
        if (files.state.get().busy === null) files.dismiss();
        else files.cancel();
    }

    private showOpened({ name, notes, losses, count, damaged, hasTrim }: NonNullable<FilesState['opened']>): void {
        const trim = make('input', { type: 'checkbox' });
        const { files } = this.session;
        const choices = [
            make('button', { class: 'primary', title: TEXTS.files.addHint, onclick: () => files.addOpened() }, TEXTS.files.add),
            make('button', { title: TEXTS.files.asDocumentHint, onclick: () => void files.createFromOpened() }, TEXTS.files.asDocument),
            make('button', { title: TEXTS.files.replaceHint, onclick: () => files.replaceAll(trim.checked) }, TEXTS.files.replace),
        ];
        this.show(
            name,
            [
                make('p', {}, TEXTS.files.opened(count, damaged)),
                lines([...notes, ...losses]),
                hasTrim ? make('label', {}, trim, ` ${TEXTS.files.trim}`) : null,
            ],
            [...choices.slice(count === 0 ? 1 : 0), this.closing(TEXTS.page.cancel)],
        );
    }

    private closing(title: string): HTMLButtonElement {
        return make(
            'button',
            {
                onclick: () => {
                    this.close();
                    this.session.files.dismiss();
                },
            },
            title,
        );
    }

    private show(title: string, content: (HTMLElement | null)[], buttons: HTMLButtonElement[]): void {
        this.dialog.replaceChildren(
            make('h2', { id: 'files-title', tabindex: -1 }, title),
            ...content.filter(part => part !== null),
            make('div', { class: 'buttons' }, ...buttons),
        );
        if (!this.dialog.open) this.dialog.showModal();
    }
}

/** Address without `lang`, so that the page opens in the recipient's language. */
function addressOf(hash: string): string {
    const address = new URL(hash, window.location.href);
    address.searchParams.delete('lang');
    return address.href;
}

/** Text of m512, in English. Focusable, so that a long list scrolls by keyboard too. */
function lines(texts: readonly string[]): HTMLElement | null {
    return texts.length === 0 ? null : make('ul', { tabindex: 0, lang: 'en' }, ...texts.map(text => make('li', {}, text)));
}

define('files-menu', FilesMenu);
