// SPDX-License-Identifier: MIT
// The documents of this browser: the list, the open one, and the autosave. Every finished edit is passed to the storage at once. Only one
// tab can have a document open. A second tab gets a copy, which is kept from its first edit on.

import { copyName, documentFrom, freeName, imageOf } from '../model/document.ts';
import type { MotionDocument } from '../model/document.ts';
import { DROP_ALL, EMPTY_LOG, advance, positionOf, restored } from '../model/history-log.ts';
import type { HistoryLog, StepsChange } from '../model/history-log.ts';
import type { Edited } from '../model/history.ts';
import { NO_HISTORY } from '../model/history.ts';
import type { Backup, DocumentStorage, KeptDocument } from '../view/document-storage.ts';
import type { DocumentEntry, Documents, DocumentsState } from '../view/session/documents.ts';
import { Store } from '../view/store.ts';
import { TEXTS } from '../view/texts/texts.ts';
import type { DocumentEditor } from './editor.ts';
import type { Release } from './hold-document.ts';
import { Turns } from './turns.ts';

/** Locks a document for this tab until the returned function is called. null: it is locked already. */
export type Hold = (id: string) => Promise<Release | null>;

export interface DocumentsParts {
    readonly storage: DocumentStorage;
    /** false: this browser stores nothing, and documents are lost when the page closes. */
    readonly isKept: boolean;
    /** The content of a new document. */
    readonly empty: MotionDocument;
    readonly hold: Hold;
    readonly nowMs: () => number;
    readonly newId: () => string;
    /** Another tab has the document. This tab continues with a copy of that name. */
    readonly copied: (name: string) => void;
    /** The document of that name is not stored any more. */
    readonly gone: (name: string) => void;
    readonly failed: (error: unknown) => void;
}

const NEWEST_FIRST = (a: { savedMs: number }, b: { savedMs: number }): number => b.savedMs - a.savedMs;

export class KeptDocuments implements Documents {
    readonly state = new Store<DocumentsState>({ documents: [], openId: '', backups: [], unreadable: [], forgotten: 0, saving: 'saved' });
    private readonly parts: DocumentsParts;
    /** Shows the open document. */
    private readonly editor: Pick<DocumentEditor, 'open' | 'rename' | 'state'>;
    private log: HistoryLog = EMPTY_LOG;
    /** The last version of each document that is not stored yet, by id. */
    private readonly unstored = new Map<string, KeptDocument>();
    /** Those of them that the storage has refused. They are tried again when it takes something. */
    private readonly refused = new Set<string>();
    /** The open document is an unedited copy. It is dropped when the tab closes or another document opens. */
    private isUntouched = false;
    /** Counts what is opened or created. The last request wins, even if the storage answers an earlier one later. */
    private chosen = 0;
    /** Locks of the open document and of those that are not stored yet: another tab would read an older version. */
    private readonly locks = new Map<string, Release>();
    /** What is opened takes its lock one after the other. Nobody gets a lock twice, not even this tab. */
    private readonly turns = new Turns();

    constructor(editor: Pick<DocumentEditor, 'open' | 'rename' | 'state'>, parts: DocumentsParts) {
        this.editor = editor;
        this.parts = parts;
        if (!parts.isKept) this.state.set({ saving: 'off' });
    }

    /** Opens the document that was edited last, or `first` if there is none or storage cannot be read. */
    async start(first: MotionDocument): Promise<void> {
        const kept = await this.load();
        this.state.set({ backups: [...kept.backups].sort((a, b) => b.takenMs - a.takenMs), unreadable: kept.unreadable });
        const [newest] = [...kept.documents].sort(NEWEST_FIRST);
        this.state.set({ documents: numbered(kept.documents.map(entryOf)) });
        if (!newest) return this.create(first.name, first);
        await this.turns.run(() => this.take(newest.id));
        if (this.state.get().openId === '') await this.create(first.name, first); // another tab has just deleted it
    }

    /** The new document is open when this returns, so the next edit belongs to it. The promise only waits for the lock. */
    create(name: string, from?: MotionDocument): Promise<void> {
        const id = this.begin(name, from ?? this.parts.empty);
        this.keep();
        return this.turns.run(() => this.holdNew(id));
    }

    private async holdNew(id: string): Promise<void> {
        await this.lock(id); // no other tab knows this id
        this.letGo(id);
    }

    /** Opens a new document and returns its id. */
    private begin(wanted: string, from: MotionDocument): string {
        this.chosen++;
        const id = this.parts.newId();
        const name = this.free(wanted, id);
        this.show(id, { document: { ...from, name }, history: NO_HISTORY, log: EMPTY_LOG });
        this.state.set({ documents: [...this.state.get().documents, { id, name, savedMs: this.parts.nowMs() }] });
        return id;
    }

    open(id: string): Promise<void> {
        const mine = ++this.chosen;
        return this.turns.run(async () => {
            if (mine === this.chosen && id !== this.state.get().openId) await this.take(id);
        });
    }

    rename(name: string): void {
        this.editor.rename(this.free(name, this.state.get().openId));
        this.keep();
    }

    /** A name that no other document has: nobody could tell them apart when one is to be deleted. */
    private free(name: string, id: string): string {
        const others = this.state.get().documents.filter(one => one.id !== id);
        return freeName(
            name,
            others.map(one => one.name),
        );
    }

    async remove(id: string): Promise<void> {
        this.drop(id);
        if (id === this.state.get().openId) await this.openOther(id);
        this.unstored.delete(id);
        this.refused.delete(id);
        this.letGo(id);
        this.tellSaving();
        await this.parts.storage.removeDocument(id).catch((error: unknown) => this.parts.failed(error));
    }

    private async openOther(than: string): Promise<void> {
        const mine = ++this.chosen;
        const { documents } = await this.load(); // another tab may have removed some as well
        const [next] = documents.filter(({ id }) => id !== than).sort(NEWEST_FIRST);
        if (next) await this.turns.run(async () => (mine === this.chosen ? this.take(next.id) : undefined));
        else if (mine === this.chosen) await this.create(TEXTS.document.mine);
    }

    async read(id: string): Promise<MotionDocument | null> {
        const kept = await this.find(id);
        return kept ? documentFrom(kept.image, kept.name) : null;
    }

    /** Stores a finished edit. The storage has it when this returns. */
    keep(): void {
        const { document, history } = this.editor.state.get();
        const { openId, documents } = this.state.get();
        const entry = { id: openId, name: document.name, savedMs: this.parts.nowMs() };
        this.state.set({ documents: documents.map(one => (one.id === openId ? entry : one)) });
        if (openId === '') return;
        this.isUntouched = false;
        const { log, change } = advance(this.log, history);
        this.log = log;
        this.unstored.set(openId, { ...entry, image: imageOf(document), position: positionOf(log, history) });
        void this.put(openId, change).then(isStored => (isStored ? this.tryRefused() : undefined));
    }

    /** Stores the last version of a document. false: the storage has refused it, which has been reported. */
    private async put(id: string, change: StepsChange): Promise<boolean> {
        this.tellSaving();
        try {
            await this.tryToPut(id, change);
            this.refused.delete(id);
            this.letGo(id);
            return true;
        } catch (error) {
            if (!this.unstored.has(id)) return true; // a later try has stored it
            this.refused.add(id);
            this.parts.failed(error);
            return false;
        } finally {
            this.tellSaving();
        }
    }

    /** The document matters more than its history: if both do not fit, the history is dropped. By then the document may have been edited
     *  again, stored or removed. */
    private async tryToPut(id: string, change: StepsChange): Promise<void> {
        const store = async (steps: StepsChange): Promise<void> => {
            const document = this.unstored.get(id);
            if (!document) return;
            await this.parts.storage.putDocument(document, steps);
            if (this.unstored.get(id) === document) this.unstored.delete(id);
        };
        await store(change).catch(() => store(DROP_ALL));
    }

    private async tryRefused(): Promise<void> {
        for (const id of [...this.refused]) if (!(await this.put(id, DROP_ALL))) return;
    }

    /** Stores a robot's pages, not twice if its newest backup has the same content. Rejects if the storage does not take them. */
    async backUp(robot: string, pages: readonly Uint8Array[]): Promise<void> {
        const image = imageOf({ name: robot, pages });
        const { backups } = this.state.get();
        const last = backups.find(backup => backup.robot === robot);
        const isSame = last?.image.every((byte, i) => byte === image[i]);
        const backup: Backup = last && isSame ? last : { id: this.parts.newId(), robot, image, takenMs: this.parts.nowMs() };
        await this.parts.storage.putBackup(backup); // a stored one too: the browser's data may have been deleted since
        if (backup !== last) this.state.set({ backups: [backup, ...this.state.get().backups] });
    }

    /** Opens a stored document with its history, or a copy if another tab has it open. */
    private async take(id: string): Promise<void> {
        const mine = this.chosen;
        const isHeld = await this.lock(id);
        const kept = await this.find(id); // now that nobody else stores it
        if (!kept || mine !== this.chosen) return this.letGo(id);
        const document = documentFrom(kept.image, this.free(kept.name, id));
        if (!isHeld) {
            const name = copyName(
                document.name,
                this.state.get().documents.map(one => one.name),
                TEXTS.document.copyWord,
            );
            this.parts.copied(name);
            const copy = this.begin(name, document);
            this.isUntouched = true;
            return this.holdNew(copy);
        }
        const steps = await this.parts.storage.readSteps(id).catch(() => []); // the history is then lost, and the page says so
        if (mine !== this.chosen) return this.letGo(id);
        this.show(id, restored(document, kept.position ?? 0, steps));
    }

    private show(id: string, { document, history, log }: Edited & { readonly log: HistoryLog }): void {
        const { openId: before } = this.state.get();
        if (this.isUntouched) this.drop(before);
        this.isUntouched = false;
        this.log = log;
        this.state.set({ openId: id, forgotten: log.base });
        this.letGo(before);
        this.editor.open(document, history);
    }

    /** false: another tab has it. */
    private async lock(id: string): Promise<boolean> {
        const release = this.locks.get(id) ?? (await this.parts.hold(id));
        if (release) this.locks.set(id, release);
        return release !== null;
    }

    /** Lets another tab have a document, unless it is open or not stored yet. */
    private letGo(id: string): void {
        if (id === this.state.get().openId || this.unstored.has(id)) return;
        this.locks.get(id)?.();
        this.locks.delete(id);
    }

    private drop(id: string): void {
        this.state.set({ documents: this.state.get().documents.filter(one => one.id !== id) });
    }

    private async load(): ReturnType<DocumentStorage['load']> {
        const nothing = { documents: [], backups: [], unreadable: [] };
        try {
            return await this.parts.storage.load();
        } catch (error) {
            this.parts.failed(error);
            return nothing;
        }
    }

    /** undefined: it is not stored any more or could not be read, which has been reported. */
    private async find(id: string): Promise<KeptDocument | undefined> {
        const unstored = this.unstored.get(id);
        if (unstored) return unstored;
        try {
            const found = await this.parts.storage.readDocument(id);
            const entry = this.state.get().documents.find(one => one.id === id);
            if (!found && entry) {
                this.drop(id);
                this.parts.gone(entry.name);
            }
            return found;
        } catch (error) {
            this.parts.failed(error); // it may still be there, so it stays in the list
            return undefined;
        }
    }

    private tellSaving(): void {
        const isOff = !this.parts.isKept || this.refused.size > 0;
        this.state.set({ saving: isOff ? 'off' : this.unstored.size > 0 ? 'saving' : 'saved' });
    }
}

/** Two tabs may have given the same name. */
function numbered(entries: readonly DocumentEntry[]): DocumentEntry[] {
    const names = entries.map(({ name }) => name);
    for (const [i, name] of names.entries()) if (names.indexOf(name) < i) names[i] = freeName(name, names);
    return entries.map((entry, i) => ({ ...entry, name: names[i] ?? entry.name }));
}

function entryOf({ id, name, savedMs }: KeptDocument): DocumentEntry {
    return { id, name, savedMs };
}
