// SPDX-License-Identifier: MIT

/** Ends as the action does, but rejects with the signal's reason if it is aborted first. For an action that does not look at the signal,
 *  which may outlive many of them. */
export async function orAborted<T>(action: Promise<T>, signal: AbortSignal): Promise<T> {
    let forget = (): void => undefined;
    const aborted = new Promise<never>((_, reject) => {
        const abort = (): void => reject(signal.reason as Error);
        signal.addEventListener('abort', abort);
        forget = () => signal.removeEventListener('abort', abort);
    });
    return Promise.race([action, aborted]).finally(forget);
}
