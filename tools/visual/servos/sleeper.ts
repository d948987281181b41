// SPDX-License-Identifier: MIT
// Sleep in a worker, accurate to a millisecond, that an event can end early.

/** A timer fires up to a millisecond late, so the last millisecond is spent in turns of the message loop. */
const TURNS_MS = 1;

export class Sleeper {
    /** Nested timers wait at least 4 ms. Timers set inside a message handler do not. */
    private readonly turn = new MessageChannel();
    private timer: ReturnType<typeof setTimeout> | undefined;
    private untilMs = 0;
    private isOver = false;
    private resolve: (() => void) | null = null;

    constructor() {
        this.turn.port1.onmessage = () => this.look();
    }

    sleep(untilMs: number): Promise<void> {
        this.untilMs = untilMs;
        this.isOver = false;
        return new Promise(resolve => {
            this.resolve = resolve;
            this.turn.port2.postMessage(null);
        });
    }

    wake(): void {
        clearTimeout(this.timer);
        this.resolve?.();
        this.resolve = null;
    }

    private look(): void {
        if (!this.resolve) return; // already woken
        const leftMs = this.untilMs - performance.now();
        const next = (): void => this.turn.port2.postMessage(null);
        if (leftMs <= 0) {
            if (this.isOver) return this.wake();
            this.isOver = true;
            return next(); // handle what arrived while the computer was busy before the sleep ends
        }
        clearTimeout(this.timer);
        if (leftMs > TURNS_MS) this.timer = setTimeout(next, leftMs - TURNS_MS);
        else next();
    }
}
