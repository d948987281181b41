// SPDX-License-Identifier: MIT
// Sleeping in a worker, to a millisecond, until something comes.

/** A timer comes up to a millisecond late, so the last one is waited for in turns of the post box. */
const TURNS_MS = 1;

export class Sleeper {
    /** Timers that are set within timers wait for 4 ms at least; those that are set within a message do not. */
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
        if (!this.resolve) return; // woken meanwhile
        const leftMs = this.untilMs - performance.now();
        const next = (): void => this.turn.port2.postMessage(null);
        if (leftMs <= 0) {
            if (this.isOver) return this.wake();
            this.isOver = true;
            return next(); // what came while a busy computer was elsewhere is heard before the time is said to be over
        }
        clearTimeout(this.timer);
        if (leftMs > TURNS_MS) this.timer = setTimeout(next, leftMs - TURNS_MS);
        else next();
    }
}
