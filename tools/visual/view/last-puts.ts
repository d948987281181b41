// SPDX-License-Identifier: MIT
// What was not stored yet when a page was left. The browser drops a transaction with the page if it still waits for another one, so this has
// a database of its own, in which none waits.

import { LastingDatabase } from './lasting-database.ts';

const DATABASE = 'motion512-last';
const STORE = 'pages';

function ask(): IDBOpenDBRequest {
    const asked = indexedDB.open(DATABASE, 1);
    asked.onupgradeneeded = () => asked.result.createObjectStore(STORE, { keyPath: 'page' });
    return asked;
}

/** What one page has left. */
export interface Left<Put> {
    readonly page: string;
    /** Oldest first. */
    readonly puts: readonly Put[];
}

export class LastPuts<Put> {
    private readonly page = `${Date.now()} ${Math.random()}`;
    private readonly database: LastingDatabase;
    private hasKept = false;

    private constructor(database: LastingDatabase) {
        this.database = database;
    }

    /** Rejects when the browser stores nothing. */
    static async open<Put>(): Promise<LastPuts<Put>> {
        return new LastPuts(await LastingDatabase.open(ask));
    }

    /** Keeps what this page has not stored yet, instead of what it has kept before. */
    keep(puts: readonly Put[]): void {
        if (puts.length === 0) return;
        this.hasKept = true;
        const left: Left<Put> = { page: this.page, puts };
        this.write(store => store.put(left));
    }

    /** This page has stored all. */
    clear(): void {
        if (!this.hasKept) return;
        this.hasKept = false;
        this.forget(this.page);
    }

    forget(page: string): void {
        this.write(store => store.delete(page));
    }

    /** Of all pages, open ones too. */
    all(): Promise<readonly Left<Put>[]> {
        return this.database.read(STORE, from => from.getAll() as IDBRequest<Left<Put>[]>);
    }

    private write(action: (store: IDBObjectStore) => unknown): void {
        void this.database.use(async database => {
            const transaction = database.transaction(STORE, 'readwrite');
            action(transaction.objectStore(STORE));
            transaction.commit();
        });
    }
}
