// SPDX-License-Identifier: MIT
// What the elements of the page have in common: a session, and what ends when the element is removed.

import type { Session } from './session/session.ts';

export class SessionElement extends HTMLElement {
    session!: Session; // set before it is connected
    /** Called when the element is removed. */
    protected readonly disposals: (() => void)[] = [];

    disconnectedCallback(): void {
        for (const dispose of this.disposals.splice(0)) dispose();
    }

    /** Gives the session to an element in this one. more: other properties to set before that one is connected. */
    protected give<E extends SessionElement>(element: E, more: Partial<E> = {}): E {
        return Object.assign(element, { session: this.session }, more);
    }

    /** Calls `render` now and after every change of a store, until the element is removed. */
    protected watch(render: () => void, ...stores: readonly { watch(listener: () => void): () => void }[]): void {
        this.disposals.push(...stores.map(store => store.watch(render)));
    }

    /** Listens until the element is removed. */
    protected listenTo<K extends keyof WindowEventMap>(
        target: Document | Window,
        type: K,
        listener: (event: WindowEventMap[K]) => void,
        options: AddEventListenerOptions = {},
    ): void {
        target.addEventListener(type, listener as EventListener, options);
        this.disposals.push(() => target.removeEventListener(type, listener as EventListener, options));
    }
}
