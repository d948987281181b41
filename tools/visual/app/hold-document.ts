// SPDX-License-Identifier: MIT
// Locks of the browser: one tab for each document, and one for the memory of the robot in the page. They are released when the tab closes.

/** How long the previous page may hold its lock while the page reloads. */
const RELOAD_MS = 1000;

let release: () => void = () => undefined;

/** Locks a document for this tab and releases the one locked before. false: another tab has it, and the previous lock stays. */
export function holdDocument(id: string): Promise<boolean> {
    if (!('locks' in navigator)) return Promise.resolve(true);
    return new Promise((resolve, reject) => {
        const held = navigator.locks.request(`motion512-document-${id}`, { ifAvailable: true }, lock => {
            resolve(lock !== null);
            if (!lock) return undefined;
            release();
            return new Promise<void>(done => {
                release = done;
            });
        });
        held.catch(reject);
    });
}

/** Locks the memory of the robot in the page for as long as this tab lives. false: another tab has it. */
export async function holdRobot(): Promise<boolean> {
    if (!('locks' in navigator)) return true;
    if (await tryRobot()) return true;
    await new Promise(resolve => setTimeout(resolve, RELOAD_MS));
    return tryRobot();
}

function tryRobot(): Promise<boolean> {
    return new Promise((resolve, reject) => {
        const held = navigator.locks.request('motion512-robot', { ifAvailable: true }, lock => {
            resolve(lock !== null);
            return lock ? new Promise<never>(() => undefined) : undefined;
        });
        held.catch(reject);
    });
}
