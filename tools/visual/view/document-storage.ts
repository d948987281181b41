// SPDX-License-Identifier: MIT
// Documents and backups of robots in the browser's IndexedDB. A put is issued completely and its transaction committed before the call
// returns, so it survives a tab that closes right afterwards, unless it waits for another one: leave() is for those.

import type { StepsChange } from '../model/history-log.ts';
import { PAGE_BYTES, PAGE_COUNT } from '../model/motion.ts';
import { LastPuts } from './last-puts.ts';
import { LastingDatabase } from './lasting-database.ts';
import { TEXTS } from './texts/texts.ts';

/** A stored document. */
export interface KeptDocument {
    readonly id: string;
    readonly name: string;
    /** 65,536 bytes. */
    readonly image: Uint8Array;
    readonly savedMs: number;
    /** How many steps of its history are done (not undone); absent: no history was stored. */
    readonly position?: number;
}

/** A robot's pages before something was written into it. */
export interface Backup {
    readonly id: string;
    /** Name of the robot's port. */
    readonly robot: string;
    readonly image: Uint8Array;
    readonly takenMs: number;
}

/** All stored entries. Unreadable ones are listed by name and left as they are. */
export interface Kept {
    readonly documents: readonly KeptDocument[];
    readonly backups: readonly Backup[];
    readonly unreadable: readonly string[];
}

export interface DocumentStorage {
    load(): Promise<Kept>;
    /** undefined: it is not stored, or unreadable. */
    readDocument(id: string): Promise<KeptDocument | undefined>;
    /** Stores the document and the changes to its history in one transaction. */
    putDocument(document: KeptDocument, steps: StepsChange): Promise<void>;
    /** The stored steps of a document's history, in any order. */
    readSteps(id: string): Promise<readonly unknown[]>;
    putBackup(backup: Backup): Promise<void>;
    removeDocument(id: string): Promise<void>;
    /** The page may be gone before all that was put is stored. */
    leave(): void;
}

interface Put {
    readonly document: KeptDocument;
    readonly steps: StepsChange;
}

/** Name of the simulated robot in backups. */
export const ROBOT_IN_PAGE = 'robot in the page';

const DATABASE = 'motion512-editor';
const DOCUMENTS = 'documents';
const BACKUPS = 'backups';
/** Steps of the documents' histories, by document and number. */
const STEPS = 'steps';
const KEYS = { [DOCUMENTS]: 'id', [BACKUPS]: 'id', [STEPS]: ['document', 'number'] };

function ask(): IDBOpenDBRequest {
    const asked = indexedDB.open(DATABASE, 2);
    asked.onupgradeneeded = () => {
        const there = asked.result.objectStoreNames;
        for (const [store, keyPath] of Object.entries(KEYS)) if (!there.contains(store)) asked.result.createObjectStore(store, { keyPath });
    };
    return asked;
}

function isImage(value: unknown): value is Uint8Array {
    return value instanceof Uint8Array && value.length === PAGE_BYTES * PAGE_COUNT;
}

/** Steps of a document with from <= number < below. */
function stepsIn(id: string, from: number, below: number): IDBKeyRange {
    return IDBKeyRange.bound([id, from], [id, below], false, true);
}

/** Splits the contents of a database into readable and unreadable entries. */
export function sortKept(documents: readonly unknown[], backups: readonly unknown[]): Kept {
    const readable = (entry: unknown): boolean => isImage((entry as { image?: unknown } | null)?.image);
    const nameOf = (entry: unknown): string => {
        const { name, robot, id } = (entry ?? {}) as Record<string, unknown>;
        return String(name ?? robot ?? id ?? TEXTS.document.nameless);
    };
    return {
        documents: documents.filter(readable) as KeptDocument[],
        backups: backups.filter(readable) as Backup[],
        unreadable: [...documents, ...backups].filter(entry => !readable(entry)).map(nameOf),
    };
}

export class BrowserStorage implements DocumentStorage {
    private readonly database: LastingDatabase;
    private readonly last: LastPuts<Put>;
    /** Not stored yet, oldest first. */
    private readonly waiting = new Set<Put>();

    private constructor(database: LastingDatabase, last: LastPuts<Put>) {
        this.database = database;
        this.last = last;
    }

    /** Rejects when the browser stores nothing (private window, full disk). */
    static async open(): Promise<BrowserStorage> {
        return new BrowserStorage(await LastingDatabase.open(ask), await LastPuts.open());
    }

    async load(): Promise<Kept> {
        await this.recover();
        const all = (from: IDBObjectStore): IDBRequest<unknown[]> => from.getAll();
        return sortKept(...(await Promise.all([this.database.read(DOCUMENTS, all), this.database.read(BACKUPS, all)])));
    }

    async readDocument(id: string): Promise<KeptDocument | undefined> {
        await this.recover(); // another tab may have been closed meanwhile
        const found = await this.database.read(DOCUMENTS, from => from.get(id) as IDBRequest<unknown>);
        return sortKept([found], []).documents[0];
    }

    async putDocument(document: KeptDocument, steps: StepsChange): Promise<void> {
        const put = { document, steps };
        this.waiting.add(put);
        try {
            await this.write(store => issue(store, put));
        } finally {
            this.waiting.delete(put);
        }
        if (this.waiting.size === 0) this.last.clear();
    }

    leave(): void {
        this.last.keep([...this.waiting]);
    }

    /** Stores what pages had not stored when they were left. What cannot be stored stays for the next time. */
    private async recover(): Promise<void> {
        try {
            for (const { page, puts } of await this.last.all()) {
                for (const put of puts) await this.putAgain(put);
                this.last.forget(page);
            }
        } catch {
            return; // a full disk must not keep the documents from being read
        }
    }

    /** Unless it is stored, and something newer too. */
    private putAgain(put: Put): Promise<void> {
        return this.write(store => {
            const asked = store(DOCUMENTS).get(put.document.id) as IDBRequest<Partial<KeptDocument> | undefined>;
            asked.onsuccess = () => (asked.result?.savedMs ?? 0) <= put.document.savedMs && issue(store, put);
        }, false);
    }

    readSteps(id: string): Promise<readonly unknown[]> {
        return this.database.read(STEPS, from => from.getAll(stepsIn(id, 0, Infinity)) as IDBRequest<unknown[]>);
    }

    putBackup(backup: Backup): Promise<void> {
        return this.write(store => store(BACKUPS).put(backup));
    }

    removeDocument(id: string): Promise<void> {
        return this.write(store => {
            store(DOCUMENTS).delete(id);
            store(STEPS).delete(stepsIn(id, 0, Infinity));
        });
    }

    /** isAll: nothing is added when the first answers come. */
    private write(action: (store: Stores) => unknown, isAll = true): Promise<void> {
        const written = (database: IDBDatabase): Promise<void> =>
            new Promise((resolve, reject) => {
                const transaction = database.transaction(Object.keys(KEYS), 'readwrite');
                transaction.oncomplete = () => resolve();
                transaction.onabort = transaction.onerror = () => reject(transaction.error ?? new Error('nothing was kept'));
                action(name => transaction.objectStore(name));
                if (isAll) transaction.commit();
            });
        return this.database.use(written);
    }
}

type Stores = (name: string) => IDBObjectStore;

function issue(store: Stores, { document, steps: { dropBefore, dropFrom, add } }: Put): void {
    store(DOCUMENTS).put(document);
    store(STEPS).delete(stepsIn(document.id, dropFrom, Infinity));
    if (dropBefore > 0) store(STEPS).delete(stepsIn(document.id, 0, dropBefore)); // an empty range is an error
    for (const step of add) store(STEPS).put({ ...step, document: document.id });
}

/** For browsers that store nothing: keeps everything while the page is open. */
export class PassingStorage implements DocumentStorage {
    private readonly documents = new Map<string, KeptDocument>();
    private readonly backups = new Map<string, Backup>();
    private readonly steps = new Map<string, Map<number, unknown>>();

    load(): Promise<Kept> {
        return Promise.resolve(sortKept([...this.documents.values()], [...this.backups.values()]));
    }

    readDocument(id: string): Promise<KeptDocument | undefined> {
        return Promise.resolve(this.documents.get(id));
    }

    putDocument(document: KeptDocument, { dropBefore, dropFrom, add }: StepsChange): Promise<void> {
        this.documents.set(document.id, document);
        const steps = new Map([...(this.steps.get(document.id) ?? [])].filter(([number]) => number >= dropBefore && number < dropFrom));
        for (const step of add) steps.set(step.number, step);
        this.steps.set(document.id, steps);
        return Promise.resolve();
    }

    readSteps(id: string): Promise<readonly unknown[]> {
        return Promise.resolve([...(this.steps.get(id)?.values() ?? [])]);
    }

    putBackup(backup: Backup): Promise<void> {
        this.backups.set(backup.id, backup);
        return Promise.resolve();
    }

    removeDocument(id: string): Promise<void> {
        this.documents.delete(id);
        this.steps.delete(id);
        return Promise.resolve();
    }

    leave(): void {} // all is lost with the page, which asks
}
