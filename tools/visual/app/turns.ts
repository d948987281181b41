// SPDX-License-Identifier: MIT
// Actions that must not overlap: each begins when the one before it has ended.

export class Turns {
    private last: Promise<unknown> = Promise.resolve();

    /** Runs the action after those before it, whether they succeed or fail. Resolves or rejects as the action does. */
    run<T>(action: () => Promise<T>): Promise<T> {
        const done = this.last.then(action);
        this.last = done.catch(() => undefined); // the caller gets the error
        return done;
    }
}
