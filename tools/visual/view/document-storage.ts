// SPDX-License-Identifier: MIT
// Documents and backups of robots in the browser's IndexedDB. A put is handed over whole, and its transaction committed, before
// the call returns: a tab that closes at the next moment does not take it along.

import { PAGE_BYTES, PAGE_COUNT } from '../model/motion.ts';

/** A document as it is kept. */
export interface KeptDocument {
  readonly id: string;
  readonly name: string;
  /** 65,536 bytes. */
  readonly image: Uint8Array;
  readonly savedMs: number;
}

/** A robot's pages before something was written into it. */
export interface Backup {
  readonly id: string;
  /** Which robot, as the port is called. */
  readonly robot: string;
  readonly image: Uint8Array;
  readonly takenMs: number;
}

/** What is kept, and what is there but cannot be read: kept as it is. */
export interface Kept {
  readonly documents: readonly KeptDocument[];
  readonly backups: readonly Backup[];
  readonly unreadable: readonly string[];
}

export interface DocumentStorage {
  load(): Promise<Kept>;
  putDocument(document: KeptDocument): Promise<void>;
  putBackup(backup: Backup): Promise<void>;
  removeDocument(id: string): Promise<void>;
}

const DATABASE = 'motion512-editor';
const DOCUMENTS = 'documents';
const BACKUPS = 'backups';

function isImage(value: unknown): value is Uint8Array {
  return value instanceof Uint8Array && value.length === PAGE_BYTES * PAGE_COUNT;
}

function done<T>(asked: IDBRequest<T>): Promise<T> {
  return new Promise((resolve, reject) => {
    asked.onsuccess = () => resolve(asked.result);
    asked.onerror = () => reject(asked.error);
  });
}

/** Sorts what a database holds into what can be read and what cannot. */
export function sortKept(documents: readonly unknown[], backups: readonly unknown[]): Kept {
  const readable = (entry: unknown): boolean => isImage((entry as { image?: unknown } | null)?.image);
  const nameOf = (entry: unknown): string => {
    const { name, robot, id } = (entry ?? {}) as Record<string, unknown>;
    return String(name ?? robot ?? id ?? 'without a name');
  };
  return {
    documents: documents.filter(readable) as KeptDocument[],
    backups: backups.filter(readable) as Backup[],
    unreadable: [...documents, ...backups].filter((entry) => !readable(entry)).map(nameOf),
  };
}

export class BrowserStorage implements DocumentStorage {
  private readonly database: IDBDatabase;

  private constructor(database: IDBDatabase) {
    this.database = database;
  }

  /** Rejects when the browser keeps nothing (a private window, a full disk). */
  static async open(): Promise<BrowserStorage> {
    const asked = indexedDB.open(DATABASE, 1);
    asked.onupgradeneeded = () => {
      for (const store of [DOCUMENTS, BACKUPS]) asked.result.createObjectStore(store, { keyPath: 'id' });
    };
    return new BrowserStorage(await done(asked));
  }

  async load(): Promise<Kept> {
    const transaction = this.database.transaction([DOCUMENTS, BACKUPS]);
    const [documents, backups] = await Promise.all([DOCUMENTS, BACKUPS].map((store) => done(transaction.objectStore(store).getAll() as IDBRequest<unknown[]>)));
    return sortKept(documents ?? [], backups ?? []);
  }

  putDocument(document: KeptDocument): Promise<void> {
    return this.write(DOCUMENTS, (store) => store.put(document));
  }

  putBackup(backup: Backup): Promise<void> {
    return this.write(BACKUPS, (store) => store.put(backup));
  }

  removeDocument(id: string): Promise<void> {
    return this.write(DOCUMENTS, (store) => store.delete(id));
  }

  private write(name: string, deed: (store: IDBObjectStore) => IDBRequest): Promise<void> {
    return new Promise((resolve, reject) => {
      const transaction = this.database.transaction(name, 'readwrite');
      transaction.oncomplete = () => resolve();
      transaction.onabort = transaction.onerror = () => reject(transaction.error ?? new Error('nothing was kept'));
      deed(transaction.objectStore(name));
      transaction.commit();
    });
  }
}

/** Where nothing can be kept: as long as the page is open. */
export class PassingStorage implements DocumentStorage {
  private readonly documents = new Map<string, KeptDocument>();
  private readonly backups = new Map<string, Backup>();

  load(): Promise<Kept> {
    return Promise.resolve(sortKept([...this.documents.values()], [...this.backups.values()]));
  }

  putDocument(document: KeptDocument): Promise<void> {
    this.documents.set(document.id, document);
    return Promise.resolve();
  }

  putBackup(backup: Backup): Promise<void> {
    this.backups.set(backup.id, backup);
    return Promise.resolve();
  }

  removeDocument(id: string): Promise<void> {
    this.documents.delete(id);
    return Promise.resolve();
  }
}
