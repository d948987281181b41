// SPDX-License-Identifier: MIT
// The page's own versions. The browser keeps the open one (service-worker.js) and looks for a newer one when the page opens and whenever
// somebody returns to it. The newer one takes over when the person agrees.

import type { SessionState } from '../view/session/session.ts';
import type { Store } from '../view/store.ts';

export class PageVersion {
    private readonly state: Store<SessionState>;
    private registration: ServiceWorkerRegistration | null = null;

    constructor(state: Store<SessionState>) {
        this.state = state;
    }

    /** Stores the complete page in the browser. If the browser refuses (plain http from another machine), the page works, but not
     *  offline. */
    async keep(): Promise<void> {
        if (!('serviceWorker' in navigator)) return;
        const registration = await navigator.serviceWorker.register('./service-worker.js').catch(() => null);
        if (!registration) return;
        this.registration = registration;
        registration.addEventListener('updatefound', () => this.follow(registration.installing));
        this.follow(registration.waiting ?? registration.installing);
        document.addEventListener('visibilitychange', () => {
            if (!document.hidden) void registration.update().catch(() => undefined); // fails without a network
        });
    }

    take(): void {
        const waiting = this.registration?.waiting;
        if (!waiting) return window.location.reload(); // it has taken over already: another tab asked for it
        navigator.serviceWorker.addEventListener('controllerchange', () => window.location.reload());
        waiting.postMessage('take-over');
    }

    private follow(worker: ServiceWorker | null): void {
        const look = (): void => {
            if (worker?.state === 'installed' && navigator.serviceWorker.controller) this.state.set({ hasNewVersion: true });
        };
        worker?.addEventListener('statechange', look);
        look();
    }
}
