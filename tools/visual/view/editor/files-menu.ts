// SPDX-License-Identifier: MIT
// Open a file, save as a file, send as a link; files that are dropped anywhere on the page. What was read is shown first: nothing
// is taken over before a person says so.

import { SUFFIXES } from '../../model/file-formats.ts';
import type { Suffix } from '../../model/file-formats.ts';
import type { Session } from '../session/session.ts';
import { onChoice } from '../choice.ts';
import { define, make } from '../element.ts';
import type { FilesState } from '../session/files.ts';
import { FILE_TEXTS } from '../texts/files.ts';
import './files-menu.css';

const ACCEPTED = '.m512,.bin,.img,.hex,.ihex,.mtn';
const FORGET_MS = 60_000; // a download has begun by then

export class FilesMenu extends HTMLElement {
    session!: Session; // set before it is connected
    private readonly chooser = make('input', {
        type: 'file',
        accept: ACCEPTED,
        hidden: true,
        'aria-label': 'Motion file',
        onchange: () => this.chosen(),
    });
    private readonly dialog = make('dialog', { 'aria-labelledby': 'files-title', oncancel: () => this.session.files.dismiss() });
    private readonly busy = make('span', { class: 'busy', role: 'status' });
    private readonly stop = make('button', { hidden: true, onclick: () => this.session.files.cancel() }, 'Cancel');
    private shown: Pick<FilesState, 'opened' | 'tooLarge' | 'trouble'> | null = null;
    private readonly ends: (() => void)[] = [];

    connectedCallback(): void {
        const save = make(
            'select',
            { 'aria-label': 'Save as a file' },
            make('option', { value: '' }, 'Save as …'),
            ...Object.entries(SUFFIXES).map(([suffix, title]) => make('option', { value: suffix }, `${title} (${suffix})`)),
        );
        onChoice(save, suffix => {
            if (suffix !== '') void this.save(suffix as Suffix); // one of the options
            save.value = '';
        });
        this.replaceChildren(
            make('button', { onclick: () => this.chooser.click() }, 'Open …'),
            save,
            make(
                'button',
                { title: 'A link that holds this page and those that it leads to', onclick: () => void this.send() },
                'Send as link',
            ),
            this.busy,
            this.stop,
            this.chooser,
            this.dialog,
        );
        this.listen('dragover', event => this.isFile(event) && event.preventDefault());
        this.listen('drop', event => void this.dropped(event));
        this.ends.push(this.session.files.state.watch(state => this.render(state)));
    }

    disconnectedCallback(): void {
        for (const end of this.ends.splice(0)) end();
    }

    private listen(type: 'dragover' | 'drop', listener: (event: DragEvent) => void): void {
        window.addEventListener(type, listener);
        this.ends.push(() => window.removeEventListener(type, listener));
    }

    private isFile(event: DragEvent): boolean {
        return event.dataTransfer?.types.includes('Files') ?? false;
    }

    private async dropped(event: DragEvent): Promise<void> {
        const file = event.dataTransfer?.files[0];
        if (!file || !this.isFile(event)) return;
        event.preventDefault();
        await this.read(file);
    }

    private chosen(): void {
        const file = this.chooser.files?.[0];
        this.chooser.value = ''; // the same file may be chosen again
        if (file) void this.read(file);
    }

    private async read(file: File): Promise<void> {
        await this.session.files.choose(file);
    }

    private async save(suffix: Suffix): Promise<void> {
        const saved = await this.session.files.save(suffix);
        if (!saved) return;
        const address = URL.createObjectURL(new Blob([saved.bytes as Uint8Array<ArrayBuffer>]));
        make('a', { href: address, download: saved.name }).click();
        setTimeout(() => URL.revokeObjectURL(address), FORGET_MS);
        if (saved.losses.length > 0)
            this.show(saved.name, [make('p', {}, FILE_TEXTS.losses(saved.name)), lines(saved.losses)], [this.closing('Understood')]);
    }

    /** The selected page as a link, in the clipboard and to be copied. */
    async send(): Promise<void> {
        const hash = await this.session.files.link();
        if (hash === null) return;
        const address = new URL(hash, window.location.href).href;
        const isCopied = await navigator.clipboard.writeText(address).then(
            () => true,
            () => false,
        );
        const field = make('input', { type: 'text', readonly: true, value: address, 'aria-label': 'Link' });
        this.show(
            'A link with the motion in it',
            [make('p', {}, isCopied ? FILE_TEXTS.linkCopied : FILE_TEXTS.linkShown), field],
            [this.closing('Close')],
        );
        field.select();
    }

    private render(state: FilesState): void {
        this.busy.textContent = state.busy ?? '';
        this.stop.hidden = state.busy === null;
        const { opened, tooLarge, trouble } = state;
        const { shown } = this;
        if (shown && shown.opened === opened && shown.tooLarge === tooLarge && shown.trouble === trouble) return;
        this.shown = { opened, tooLarge, trouble };
        if (trouble !== null) this.show('That did not work', [make('p', {}, trouble)], [this.closing('Close')]);
        else if (opened) this.showOpened(opened);
        else if (tooLarge)
            this.show(
                tooLarge.name,
                [make('p', {}, FILE_TEXTS.tooLarge(tooLarge.pages))],
                [make('button', { onclick: () => void this.session.files.openWithoutRest() }, 'Open without them'), this.closing('Cancel')],
            );
        else this.dialog.close();
    }

    private showOpened({ name, notes, losses, count, damaged, hasTrim }: NonNullable<FilesState['opened']>): void {
        const trim = make('input', { type: 'checkbox' });
        const { files } = this.session;
        const choices = [
            make('button', { class: 'primary', title: FILE_TEXTS.addHint, onclick: () => files.addOpened() }, 'Add to free pages'),
            make('button', { title: FILE_TEXTS.documentHint, onclick: () => void files.createFromOpened() }, 'As a new document'),
            make('button', { title: FILE_TEXTS.replaceHint, onclick: () => files.replaceAll(trim.checked) }, 'Replace all pages'),
        ];
        this.show(
            name,
            [
                make('p', {}, FILE_TEXTS.opened(count, damaged)),
                lines([...notes, ...losses]),
                hasTrim ? make('label', {}, trim, ` ${FILE_TEXTS.trim}`) : null,
            ],
            [...choices.slice(count === 0 ? 1 : 0), this.closing('Cancel')],
        );
    }

    private closing(title: string): HTMLButtonElement {
        return make(
            'button',
            {
                onclick: () => {
                    this.dialog.close();
                    this.session.files.dismiss();
                },
            },
            title,
        );
    }

    private show(title: string, content: (HTMLElement | null)[], buttons: HTMLButtonElement[]): void {
        this.dialog.replaceChildren(
            make('h2', { id: 'files-title' }, title),
            ...content.filter(part => part !== null),
            make('div', { class: 'buttons' }, ...buttons),
        );
        if (!this.dialog.open) this.dialog.showModal();
    }
}

/** Scrolls when it is long, also by keyboard. */
function lines(texts: readonly string[]): HTMLElement | null {
    return texts.length === 0 ? null : make('ul', { tabindex: 0 }, ...texts.map(text => make('li', {}, text)));
}

define('files-menu', FilesMenu);
