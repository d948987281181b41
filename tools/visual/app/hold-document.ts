// SPDX-License-Identifier: MIT
// Locks of the browser: one tab for each document, one for the memory of the robot in the page, one for that of My servos. They are released
// when the tab closes. Over plain http from another machine the browser has none, and where it may not store data it refuses them; the tabs
// then ask each other.

import { TabLocks } from './tab-locks.ts';

/** How long the previous page may hold its lock while the page reloads. */
const RELOAD_MS = 1000;
/** A tab that reloads takes its lock again within this time, also on a slow computer. */
const CLOSED_MS = 10_000;

const ROBOT = 'robot';

export type Release = () => void;

let tabLocks: TabLocks | null = null;

/** Locks a document until the returned function is called. null: it is locked already. */
export function holdDocument(id: string): Promise<Release | null> {
    return tryLock(`document-${id}`);
}

/** Locks the memory of the robot in the page for as long as this tab lives. false: another tab has it. */
export async function holdRobot(): Promise<boolean> {
    return (await lock(ROBOT)) !== null;
}

/** Resolves when the tab that has the memory of the robot in the page is closed. This tab then has the lock. */
export async function robotFreed(): Promise<void> {
    do {
        // Waits for it and lets go.
        if ('locks' in navigator) await navigator.locks.request(nameOf(ROBOT), () => undefined).catch(() => undefined);
        await new Promise(resolve => setTimeout(resolve, CLOSED_MS));
    } while (!(await tryLock(ROBOT)));
}

/** Locks the memory of My servos until the returned function is called. null: another tab has it. */
export function holdServos(): Promise<Release | null> {
    return lock('servos');
}

function nameOf(lock: string): string {
    return `motion512-${lock}`;
}

async function lock(name: string): Promise<Release | null> {
    const release = await tryLock(name);
    if (release) return release;
    await new Promise(resolve => setTimeout(resolve, RELOAD_MS));
    return tryLock(name);
}

async function tryLock(name: string): Promise<Release | null> {
    try {
        if ('locks' in navigator) return await browserLock(name);
    } catch {
        // Refused.
    }
    tabLocks ??= new TabLocks();
    return tabLocks.request(nameOf(name));
}

function browserLock(name: string): Promise<Release | null> {
    return new Promise((resolve, reject) => {
        const held = navigator.locks.request(nameOf(name), { ifAvailable: true }, async granted => {
            if (granted) await new Promise<void>(release => resolve(release));
            else resolve(null);
        });
        held.catch(reject);
    });
}
