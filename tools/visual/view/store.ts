// SPDX-License-Identifier: MIT
// One value that views watch. Values are replaced, never changed in place.

export class Store<T extends object> {
    private value: T;
    private readonly listeners = new Set<(value: T) => void>();

    constructor(value: T) {
        this.value = value;
    }

    get(): T {
        return this.value;
    }

    set(change: Partial<T>): void {
        this.value = { ...this.value, ...change };
        for (const listener of this.listeners) listener(this.value);
    }

    /** Calls the listener now and after every change. The returned function stops that. */
    watch(listener: (value: T) => void): () => void {
        this.listeners.add(listener);
        listener(this.value);
        return () => this.listeners.delete(listener);
    }
}
