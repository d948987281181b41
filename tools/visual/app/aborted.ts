// SPDX-License-Identifier: MIT

/** Rejects with the signal's reason when it is aborted. For Promise.race() with an action that does not look at the signal. */
export function aborted(signal: AbortSignal): Promise<never> {
    return new Promise((_, reject) => signal.addEventListener('abort', () => reject(signal.reason as Error), { once: true }));
}
