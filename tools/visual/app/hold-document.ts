// SPDX-License-Identifier: MIT
// One tab for one document, and one for what the robot in the page keeps: locks of the browser, given back when the tab closes.

/** A page that is loaded anew may find itself, still leaving. */
const RELOAD_MS = 1000;

let release: () => void = () => undefined;

/** Takes a document for this tab and gives back the one taken before. false: another tab has it; what was taken stays taken. */
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

/** Takes what the robot in the page keeps for this tab, for good. false: another tab has it. */
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
