// SPDX-License-Identifier: MIT
// Actions on whole pages with their dialogs: copy, move, swap, rename, clear.

import { pageOf } from '../../model/document.ts';
import type { MotionDocument } from '../../model/document.ts';
import { freePage } from '../../model/page-edits.ts';
import type { Documents } from '../session/documents.ts';
import type { Editor } from '../session/editor.ts';
import { make } from '../element.ts';
import { ask, askText } from './ask-dialog.ts';
import { dispatchAsked } from './asked.ts';
import { titleOf } from '../texts/editor.ts';
import { TEXTS } from '../texts/texts.ts';

/** What a dialog takes, as the pattern of its field. A name has more than blanks. */
export const MOTION_NAME = '[ -~]*[!-~][ -~]*';
export const MOTION_NUMBER = '0*([1-9][0-9]?|1[01][0-9]|12[0-7])';

export class PageActions {
    private readonly editor: Editor;
    private readonly documents: Pick<Documents, 'state'>;
    /** The page taken by Ctrl+C or Ctrl+X, a motion of that document; 0: none. */
    private taken = { page: 0, from: '' };

    constructor(editor: Editor, documents: Pick<Documents, 'state'>) {
        this.editor = editor;
        this.documents = documents;
    }

    async rename(page: number): Promise<void> {
        const { document } = this.editor.state.get();
        const name = await askText(
            TEXTS.motions.renameTitle(titleOf(this.editor, page)),
            TEXTS.document.name,
            this.editor.page(page).name,
            {
                maxLength: 13,
                pattern: MOTION_NAME,
                hint: TEXTS.motions.nameHint,
            },
        );
        if (name !== null) dispatchAsked(this.editor, document, [page], now => this.editor.edits.rename(now, page, name));
    }

    async clear(page: number): Promise<void> {
        if (this.isEmpty(page)) return;
        const { motions } = TEXTS;
        const { document } = this.editor.state.get();
        const title = titleOf(this.editor, page);
        const answer = await ask(motions.clearTitle(title), motions.clearMeans(title), [[motions.clears, 'clear']]);
        if (answer) dispatchAsked(this.editor, document, [page], now => this.editor.edits.clearPages(now, [page]));
    }

    take(page: number): void {
        this.taken = { page, from: this.documents.state.get().openId };
    }

    async putTaken(onto: number): Promise<void> {
        const { page, from } = this.taken;
        if (page !== 0 && from === this.documents.state.get().openId) await this.transfer(page, onto);
    }

    /** Asks for the target page's number, as an alternative to dragging. */
    async transferByNumber(page: number): Promise<void> {
        const { document } = this.editor.state.get();
        const free = freePage(this.editor.format, document, page);
        const answer = await askText(TEXTS.motions.transferTo(titleOf(this.editor, page)), TEXTS.motions.toNumber, String(free || page), {
            maxLength: 3,
            pattern: MOTION_NUMBER,
            hint: TEXTS.motions.numberHint,
        });
        if (answer !== null) await this.transfer(page, Number(answer));
    }

    /** Asks whether to copy, move or swap, and whether links follow. */
    async transfer(from: number, to: number): Promise<void> {
        if (from === to) return;
        const { editor } = this;
        const { document } = editor.state.get();
        const isFree = this.isEmpty(to);
        const follow = make('input', { type: 'checkbox', checked: true });
        const { motions } = TEXTS;
        const question = isFree ? motions.transferAsk : motions.transferReplaces;
        const answer = await ask(
            motions.transferTitle,
            question(titleOf(editor, from), titleOf(editor, to)),
            [[motions.copy, 'copy'], [motions.move, 'move'], ...(isFree ? [] : [[motions.swap, 'swap'] as const])],
            make('label', {}, follow, motions.linksFollow),
        );
        const options = { linksFollow: follow.checked, replace: true };
        const edit = {
            copy: (now: MotionDocument) => editor.edits.copyPage(now, from, to, options),
            move: (now: MotionDocument) => editor.edits.movePage(now, from, to, options),
            swap: (now: MotionDocument) => editor.edits.swapPages(now, from, to, options),
        }[answer ?? ''];
        if (edit && dispatchAsked(editor, document, [from, to], edit)) editor.select({ page: to });
    }

    private isEmpty(page: number): boolean {
        return this.editor.format.isEmpty(pageOf(this.editor.state.get().document, page));
    }
}
