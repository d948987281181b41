// SPDX-License-Identifier: MIT
// One tab for one document: a lock of the browser, which it gives back when the tab closes.

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
