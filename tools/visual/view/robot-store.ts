// SPDX-License-Identifier: MIT
// Non-volatile memory of robots, in IndexedDB. Simulated robot: flash, EEPROM and the servos' EEPROMs, under one key. My servos: motion
// pages, journal, EEPROM.

import { MEM_BOOT_END, MEM_EEPROM_BYTES } from '../model/facts.ts';
import { openedDatabase } from './opened-database.ts';

export interface KeptRobot {
    readonly flash: Uint8Array;
    readonly eeprom: Uint8Array;
    readonly servos: Uint8Array;
}

const DATABASE = 'motion512';
const STORE = 'robot';

function open(): Promise<IDBDatabase> {
    const asked = indexedDB.open(DATABASE, 1);
    asked.onupgradeneeded = () => asked.result.createObjectStore(STORE);
    return openedDatabase(asked);
}

/** Resolves when the transaction is complete: a disk that is full takes the request and refuses afterwards. */
async function withStore<T>(
    mode: IDBTransactionMode,
    action: (store: IDBObjectStore) => IDBRequest<T>,
    options: IDBTransactionOptions = {},
): Promise<T> {
    const database = await open();
    try {
        const transaction = database.transaction(STORE, mode, options);
        const asked = action(transaction.objectStore(STORE));
        await new Promise<void>((resolve, reject) => {
            transaction.oncomplete = () => resolve();
            transaction.onabort = () => reject(transaction.error);
        });
        return asked.result;
    } finally {
        database.close();
    }
}

/** null: nothing usable is stored. Rejects when the browser stores nothing. */
export async function loadRobot(key: string): Promise<KeptRobot | null> {
    const kept: unknown = await withStore('readonly', store => store.get(key) as IDBRequest<unknown>);
    const robot = kept as Partial<KeptRobot> | undefined;
    const isWhole =
        robot?.flash?.length === MEM_BOOT_END && robot.eeprom?.length === MEM_EEPROM_BYTES && robot.servos instanceof Uint8Array;
    return isWhole ? (robot as KeptRobot) : null;
}

export async function saveRobot(key: string, robot: KeptRobot): Promise<void> {
    await withStore('readwrite', store => store.put(robot, key));
}

export async function forgetRobot(key: string): Promise<void> {
    await withStore('readwrite', store => store.delete(key) as IDBRequest<undefined>);
}

const SERVOS = 'servos';

/** null: nothing usable is stored. Rejects when the browser stores nothing. */
export async function loadServos(): Promise<readonly Uint8Array[] | null> {
    const kept: unknown = await withStore('readonly', store => store.get(SERVOS) as IDBRequest<unknown>);
    return Array.isArray(kept) && kept.every(memory => memory instanceof Uint8Array) ? kept : null;
}

/** Resolves when the data is on disk and would survive a power failure. */
export async function saveServos(memories: readonly Uint8Array[]): Promise<void> {
    await withStore('readwrite', store => store.put(memories, SERVOS), { durability: 'strict' });
}
