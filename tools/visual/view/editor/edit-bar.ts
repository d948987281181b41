// SPDX-License-Identifier: MIT
// Toolbar of the editor's areas: the open document, state of the autosave, undo and redo with their names, transfer to the robot.

import { copyName, freeName } from '../../model/document.ts';
import { dirtyPages } from '../../model/editor-state.ts';
import type { MotionDocument } from '../../model/document.ts';
import type { EditorState } from '../../model/editor-state.ts';
import type { DocumentsState } from '../session/documents.ts';
import { onChoice } from '../choice.ts';
import { keyOf } from '../key-of.ts';
import { define, isTyping, make, setDisabled, setText } from '../element.ts';
import { ask, askText, awaited } from './ask-dialog.ts';
import { editText, transferText } from '../texts/editor.ts';
import { TEXTS } from '../texts/texts.ts';
import { SessionElement } from '../session-element.ts';
import './edit-bar.css';

const NEW = 'new';
const COPY = 'copy';
const FROM_ROBOT = 'robot';
const RENAME = 'rename';
const REMOVE = 'remove';

export class EditBar extends SessionElement {
    onTransfer: () => void = () => undefined;
    private readonly documents = make('select', { 'aria-label': TEXTS.document.document });
    private readonly saving = make('span', { class: 'saving', role: 'status', 'aria-label': TEXTS.document.autosave });
    private readonly undo = make('button', { onclick: () => this.session.editor.undo() }, '↶');
    private readonly redo = make('button', { onclick: () => this.session.editor.redo() }, '↷');
    private readonly transfer = make('button', { onclick: () => this.onTransfer() }, TEXTS.document.toRobot);

    connectedCallback(): void {
        this.setAttribute('role', 'toolbar');
        this.setAttribute('aria-label', TEXTS.document.document);
        this.replaceChildren(this.documents, this.saving, this.undo, this.redo, this.transfer);
        onChoice(this.documents, value => void this.chooseDocument(value));
        this.listenTo(document, 'keydown', event => this.key(event));
        this.disposals.push(
            this.session.documents.state.watch(state => this.renderDocuments(state)),
            this.session.editor.state.watch(state => this.renderEdits(state)),
            this.session.documents.state.watch(() => this.renderEdits(this.session.editor.state.get())),
        );
    }

    private renderDocuments({ documents, openId, saving, unreadable }: DocumentsState): void {
        const { document: texts } = TEXTS;
        const options = documents.map(({ id, name }) => make('option', { value: id, selected: id === openId }, name));
        const damaged = unreadable.map(name => make('option', { disabled: true }, TEXTS.document.unreadable(name)));
        const actions = [
            [NEW, texts.create],
            [COPY, texts.copy],
            [FROM_ROBOT, texts.fromRobot],
            [RENAME, texts.rename],
            [REMOVE, texts.remove],
        ].map(([value = '', title = '']) => make('option', { value }, title));
        this.documents.replaceChildren(...options, ...damaged, make('hr'), ...actions);
        this.documents.value = openId;
        this.saving.textContent = { saved: texts.saved, saving: texts.saving, off: texts.savesNot }[saving];
        this.saving.dataset.state = saving;
    }

    private renderEdits(state: EditorState): void {
        const { done, undone } = state.history;
        const show = (button: HTMLButtonElement, way: 'undo' | 'redo', edit: (typeof done)[number] | undefined, without: string): void => {
            setDisabled(button, edit === undefined);
            button.title = edit ? editText(edit, `${way}es`) : without;
            button.setAttribute('aria-label', button.title);
        };
        const { forgotten } = this.session.documents.state.get();
        show(this.undo, 'undo', done.at(-1), forgotten > 0 ? TEXTS.document.forgotten(forgotten) : TEXTS.document.undo);
        show(this.redo, 'redo', undone.at(-1), TEXTS.document.redo);
        const count = dirtyPages(state, this.session.editor.format).size;
        this.transfer.textContent = count > 0 ? TEXTS.document.toRobotCount(count) : TEXTS.document.toRobot;
    }

    private async chooseDocument(value: string): Promise<void> {
        const { documents, editor } = this.session;
        const { name } = editor.state.get().document;
        const { openId } = documents.state.get(); // another one may be open when a question is answered
        this.documents.value = openId;
        switch (value) {
            case NEW:
                return this.create(TEXTS.document.createTitle, TEXTS.document.mine);
            case COPY:
                return this.create(
                    TEXTS.document.copyTitle,
                    copyName(name, this.names(), TEXTS.document.copyWord),
                    () => editor.state.get().document,
                );
            case FROM_ROBOT:
                return this.createFromRobot();
            case RENAME: {
                const given = await askText(TEXTS.document.renameTitle, TEXTS.document.name, name);
                if (!given) return;
                if (openId === documents.state.get().openId) documents.rename(given);
                else this.session.say({ text: TEXTS.document.notRenamed(name), tone: 'bad' });
                return;
            }
            case REMOVE:
                return (await ask(TEXTS.document.removeTitle, TEXTS.document.removal(name), [[TEXTS.document.removes, 'delete']]))
                    ? documents.remove(openId)
                    : undefined;
            default:
                return documents.open(value);
        }
    }

    /** from: called after the name is entered, because the document may have changed meanwhile. */
    private async create(title: string, proposal: string, from?: () => MotionDocument): Promise<void> {
        const name = await askText(title, TEXTS.document.name, freeName(proposal, this.names()));
        if (name) await this.session.documents.create(name, from?.());
    }

    private names(): string[] {
        return this.session.documents.state.get().documents.map(one => one.name);
    }

    /** Reading takes seconds. The name is asked for meanwhile, then a dialog waits: nothing opens over what somebody types by then. */
    private async createFromRobot(): Promise<void> {
        const { document: texts } = TEXTS;
        const reading = this.robotPages();
        const name = await askText(texts.fromRobotTitle, texts.name, freeName(texts.ofMyRobot, this.names()));
        if (!name) return;
        const status = make('p', { role: 'status', tabindex: -1, autofocus: true }); // an Enter that is held does not cancel
        const unwatch = this.session.transfer.state.watch(state => setText(status, transferText(state, this.session.state.get())));
        const isRead = await awaited(texts.fromRobotTitle, reading, status);
        unwatch();
        if (!isRead) return;
        const pages = await reading;
        if (pages) await this.session.documents.create(name, { name: '', pages });
        else this.onTransfer(); // shows the reason and offers to try again
    }

    /** null: they could not be read. */
    private async robotPages(): Promise<Uint8Array[] | null> {
        const { transfer, editor } = this.session;
        if (!(await transfer.read()).isDone) return null;
        return editor.state.get().robot.map(bytes => bytes ?? editor.format.empty);
    }

    /** Ctrl+Z, Ctrl+Shift+Z and Ctrl+Y, except while typing. */
    private key(event: KeyboardEvent): void {
        const isInDialog = event.target instanceof Element && event.target.closest('dialog') !== null;
        if (!(event.ctrlKey || event.metaKey) || event.altKey || isTyping(event) || isInDialog || this.closest('[hidden]')) return;
        const { editor } = this.session;
        const action = { z: () => editor.undo(), Z: () => editor.redo(), y: () => editor.redo() }[keyOf(event)];
        if (!action) return;
        event.preventDefault();
        action();
    }
}

define('edit-bar', EditBar);
