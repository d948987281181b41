// SPDX-License-Identifier: MIT
// A database of the browser that stays open. The browser closes it when a person deletes the data of the page; the next request then opens it
// anew, and it is empty.

import { openedDatabase } from './opened-database.ts';

export class LastingDatabase {
    private readonly ask: () => IDBOpenDBRequest;
    /** null: the browser has closed it. */
    private database: IDBDatabase | null = null;
    private opening: Promise<IDBDatabase> | null = null;

    private constructor(ask: () => IDBOpenDBRequest) {
        this.ask = ask;
    }

    /** Rejects as openedDatabase() does. */
    static async open(ask: () => IDBOpenDBRequest): Promise<LastingDatabase> {
        const lasting = new LastingDatabase(ask);
        await lasting.reopen();
        return lasting;
    }

    /** Calls `action` before it returns, unless the browser has closed the database. Rejects if it cannot be opened again. */
    async use<T>(action: (database: IDBDatabase) => Promise<T>): Promise<T> {
        return action(this.database ?? (await this.reopen()));
    }

    /** What a store answers to one request. */
    read<T>(store: string, ask: (from: IDBObjectStore) => IDBRequest<T>): Promise<T> {
        const answered = (database: IDBDatabase): Promise<T> =>
            new Promise((resolve, reject) => {
                const asked = ask(database.transaction(store).objectStore(store));
                asked.onsuccess = () => resolve(asked.result);
                asked.onerror = () => reject(asked.error);
            });
        return this.use(answered);
    }

    private reopen(): Promise<IDBDatabase> {
        this.opening ??= this.opened().finally(() => (this.opening = null));
        return this.opening;
    }

    private async opened(): Promise<IDBDatabase> {
        const database = await openedDatabase(this.ask());
        database.onclose = () => (this.database = null);
        database.onversionchange = ({ newVersion }) => {
            database.close(); // a newer page needs it; this one can store nothing more and says so
            if (newVersion === null) this.database = null; // unless it is deleted
        };
        this.database = database;
        return database;
    }
}
