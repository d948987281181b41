// SPDX-License-Identifier: MIT
// Opens a database of the browser, with a time limit: a storage that hangs sends no event at all.

const OPEN_MS = 5000;

/** Rejects if it cannot be opened, while a tab with an older page still holds it, and after OPEN_MS. What is opened later is closed again. */
export function openedDatabase(asked: IDBOpenDBRequest): Promise<IDBDatabase> {
    return new Promise((resolve, reject) => {
        const fail = (why: unknown): void => {
            clearTimeout(timer);
            asked.onsuccess = () => asked.result.close();
            reject(why);
        };
        const timer = setTimeout(() => fail(new Error('the storage does not answer')), OPEN_MS);
        asked.onblocked = () => fail(new Error('another tab has an older page open'));
        asked.onerror = () => fail(asked.error);
        asked.onsuccess = () => {
            clearTimeout(timer);
            resolve(asked.result);
        };
    });
}
