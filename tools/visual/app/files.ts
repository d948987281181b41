// SPDX-License-Identifier: MIT
// Files and links: joins m512's formats with the editor's document.

import { HASH, MOST_CHARACTERS, decodeMotion, encodeMotion, pagesToSend } from '../files/motion-link.ts';
import { documentFrom, imageOf } from '../model/document.ts';
import type { MotionDocument } from '../model/document.ts';
import { MOST_BYTES } from '../model/file-formats.ts';
import type { FileFormats, NoRoom, Opened, Refused, Suffix } from '../model/file-formats.ts';
import { PAGE_BYTES, PAGE_COUNT } from '../model/motion.ts';
import { readPage } from '../model/page.ts';
import { TEXTS } from '../view/texts/texts.ts';
import type { ChosenFile, Files, FilesState, LookedAt, SavedFile } from '../view/session/files.ts';
import { Store } from '../view/store.ts';
import type { DocumentEditor } from './editor.ts';

const NOTHING: Omit<FilesState, 'busy'> = { opened: null, tooLarge: null, sent: null, trouble: null, done: null };

function noPython(error: unknown): string {
    return TEXTS.files.noPython(error instanceof Error ? error.message : String(error));
}

/** Returns the bytes, or a sentence that says why the file cannot be read. */
function bytesOf(file: ChosenFile): Promise<Uint8Array | string> {
    if (file.size > MOST_BYTES) return Promise.resolve(TEXTS.files.tooManyBytes(file.name));
    return file.arrayBuffer().then(
        buffer => new Uint8Array(buffer),
        () => TEXTS.files.unreadable(file.name),
    );
}

export interface FilesParts {
    /** Cancels the file operation that runs. */
    cancel(): void;
    create(name: string, document: MotionDocument): Promise<void>;
}

export class DocumentFiles implements Files {
    readonly state = new Store<FilesState>({ ...NOTHING, busy: null });
    private readonly editor: DocumentEditor;
    readonly formats: FileFormats;
    private last: { readonly name: string; readonly bytes: Uint8Array } | null = null;

    private readonly parts: FilesParts;
    private isCancelled = false;
    /** Counts what is read or written. `busy` describes the last. */
    private begun = 0;
    /** Ends the reading of a file that is only viewed; null: none is read. */
    private endLook: (() => void) | null = null;
    /** Counts chosen files. The last one is opened, even if an earlier one comes later. */
    private chosen = 0;

    constructor(editor: DocumentEditor, formats: FileFormats, parts: FilesParts) {
        this.editor = editor;
        this.formats = formats;
        this.parts = parts;
    }

    async choose(file: ChosenFile, ...others: readonly ChosenFile[]): Promise<void> {
        const mine = ++this.chosen;
        this.last = null; // what is still being read is not shown any more
        const end = this.begin(TEXTS.files.reading(file.name));
        const bytes = others.length > 0 ? TEXTS.files.oneOnly(others.length + 1) : await bytesOf(file);
        if (mine !== this.chosen) return;
        if (typeof bytes !== 'string') return this.open(file.name, bytes);
        end();
        this.state.set({ trouble: bytes });
    }

    async look(file: ChosenFile): Promise<LookedAt> {
        let end = (): void => undefined;
        const cancelled = new Promise<LookedAt>(resolve => (end = () => resolve({ kind: 'cancelled' })));
        this.endLook = end;
        try {
            return await Promise.race([this.lookAt(file), cancelled]);
        } finally {
            if (this.endLook === end) this.endLook = null;
        }
    }

    cancel(): void {
        if (this.state.get().busy === null && !this.endLook) return;
        this.isCancelled = true;
        this.chosen++; // a file that has not come yet, as from a network drive that is gone, is not opened later
        this.begun++;
        this.state.set({ busy: null });
        this.endLook?.();
        this.parts.cancel();
    }

    open(name: string, bytes: Uint8Array): Promise<void> {
        this.last = { name, bytes };
        return this.read(name, bytes, false);
    }

    async openWithoutRest(): Promise<void> {
        if (this.last) await this.read(this.last.name, this.last.bytes, true);
    }

    addOpened(): void {
        const { opened } = this.state.get();
        if (!opened) return;
        const pages = new Map(Array.from({ length: PAGE_COUNT - 1 }, (_, i) => [i + 1, this.pageIn(opened.image, i + 1)] as const));
        for (const [page, bytes] of pages) if (!this.holdsSteps(bytes) || this.editor.format.fault(bytes) !== null) pages.delete(page);
        if (pages.size === 0) this.state.set({ ...NOTHING, trouble: TEXTS.files.nothingWhole });
        else this.addPages(opened.name, pages);
    }

    async createFromOpened(): Promise<void> {
        const { opened } = this.state.get();
        if (!opened) return;
        const name = opened.name.replace(/\.[^.]*$/, '');
        this.dismiss();
        await this.parts.create(name, documentFrom(opened.image, name));
    }

    replaceAll(withTrim: boolean): void {
        const { opened } = this.state.get();
        if (!opened) return;
        const { document } = this.editor.state.get();
        const pages = new Map(Array.from({ length: PAGE_COUNT }, (_, page) => [page, this.pageIn(opened.image, page)]));
        if (!withTrim) pages.delete(0);
        if (this.editor.dispatch(this.editor.edits.replacePages(document, pages))) this.dismiss();
    }

    dismiss(): void {
        this.state.set(NOTHING);
    }

    async save(suffix: Suffix): Promise<SavedFile | null> {
        const { document } = this.editor.state.get();
        const name = `${document.name.replaceAll(/[^\p{L}\p{N} _-]/gu, '_')}${suffix}`;
        const saved = await this.busy(TEXTS.files.writing(name), () => this.formats.save(name, imageOf(document)));
        if (saved?.kind === 'refused') this.state.set({ trouble: saved.text });
        return saved?.kind === 'saved' ? { name, bytes: saved.file, losses: saved.losses } : null;
    }

    async link(): Promise<string | null> {
        const { document, page } = this.editor.state.get();
        const pages = pagesToSend(this.editor.format, document, page);
        if (pages.size === 0) {
            this.state.set({ trouble: TEXTS.files.nothingToSend });
            return null;
        }
        const text = HASH + (await encodeMotion(pages));
        const isTooLong = text.length > MOST_CHARACTERS;
        this.state.set({ trouble: isTooLong ? TEXTS.files.linkTooLong : null });
        return isTooLong ? null : text;
    }

    /** Reads the motion in the page's address. Does nothing if there is none. */
    async readAddress(hash: string): Promise<void> {
        if (!hash.startsWith(HASH)) return;
        const pages = await decodeMotion(hash.slice(HASH.length));
        const { format } = this.editor;
        const first = pages && [...pages.values()][0];
        if (!pages || !first || [...pages.values()].some(bytes => format.fault(bytes) !== null)) {
            this.state.set({ trouble: TEXTS.files.badLink });
            return;
        }
        this.state.set({ sent: { name: readPage(format, first).name || TEXTS.files.nameless, pages } });
    }

    addSent(): number {
        const { sent } = this.state.get();
        const page = sent ? this.adopt(sent.pages) : 0;
        if (page !== 0) this.dismiss();
        return page;
    }

    private addPages(name: string, pages: ReadonlyMap<number, Uint8Array>): void {
        const before = this.editor.state.get().document;
        if (this.adopt(pages) === 0) return;
        const isSame = this.editor.state.get().document === before;
        this.state.set({ ...NOTHING, done: isSame ? { name, text: TEXTS.files.allHere } : null });
    }

    /** Copies pages to free pages and selects the first. Returns it, or 0 if there is no room, which has then been reported. */
    private adopt(pages: ReadonlyMap<number, Uint8Array>): number {
        const adopted = this.editor.edits.adoptPages(this.editor.state.get().document, pages);
        if (!this.editor.dispatch(adopted.ok ? { ok: true, value: adopted.value.edit } : adopted) || !adopted.ok) return 0;
        const page = [...adopted.value.placed.values()][0] ?? 0;
        this.editor.select({ page });
        return page;
    }

    private async lookAt(file: ChosenFile): Promise<LookedAt> {
        const bytes = await bytesOf(file);
        if (typeof bytes === 'string') return { kind: 'refused', text: bytes };
        try {
            const answer = await this.formats.open(file.name, bytes, true);
            if (answer.kind === 'opened') return { kind: 'read', image: answer.image };
            return answer.kind === 'refused' ? answer : { kind: 'refused', text: TEXTS.files.tooLarge(answer.pages) };
        } catch (error) {
            return { kind: 'refused', text: noPython(error) };
        }
    }

    private async read(name: string, bytes: Uint8Array, leaveOut: boolean): Promise<void> {
        const answer = await this.busy(TEXTS.files.reading(name), () => this.formats.open(name, bytes, leaveOut));
        if (answer && bytes === this.last?.bytes) this.state.set({ ...NOTHING, ...this.judged(name, answer) }); // else another was chosen
    }

    private judged(name: string, answer: Opened | NoRoom | Refused): Partial<FilesState> {
        switch (answer.kind) {
            case 'refused':
                return { trouble: answer.text };
            case 'no-room':
                return { tooLarge: { name, pages: answer.pages } };
            case 'opened': {
                const { format } = this.editor;
                const { image, notes, losses } = answer;
                const pages = Array.from({ length: PAGE_COUNT - 1 }, (_, i) => this.pageIn(image, i + 1)).filter(bytes =>
                    this.holdsSteps(bytes),
                );
                const damaged = pages.filter(bytes => format.fault(bytes) !== null).length;
                const hasTrim = !format.isEmpty(this.pageIn(image, 0));
                if (pages.length === 0 && !hasTrim) return { trouble: TEXTS.files.noMotions(name) };
                return { opened: { name, image, notes, losses, count: pages.length, damaged, hasTrim } };
            }
            default:
                return answer satisfies never;
        }
    }

    /** The page has steps, or is damaged and may have had some. */
    private holdsSteps(bytes: Uint8Array): boolean {
        const { format } = this.editor;
        return !format.isErased(bytes) && (format.fault(bytes) !== null || readPage(format, bytes).steps.length > 0);
    }

    /** Runs one action. Reports trouble as text and never throws. Null: it failed or was cancelled. */
    private async busy<T>(words: string, action: () => Promise<T>): Promise<T | null> {
        const end = this.begin(words);
        this.isCancelled = false;
        try {
            return await action();
        } catch (error) {
            if (!this.isCancelled) this.state.set({ trouble: noPython(error) });
            return null;
        } finally {
            end();
        }
    }

    /** The returned function ends it. */
    private begin(words: string): () => void {
        const mine = ++this.begun;
        this.state.set({ ...NOTHING, busy: words });
        return () => mine === this.begun && this.state.set({ busy: null });
    }

    private pageIn(image: Uint8Array, page: number): Uint8Array {
        return image.subarray(page * PAGE_BYTES, (page + 1) * PAGE_BYTES);
    }
}
