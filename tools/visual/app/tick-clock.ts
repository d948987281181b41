// SPDX-License-Identifier: MIT
// The clock of the robot in the page. Its time-outs count robot time, so that a slow or busy computer, slow motion or a pause does not
// count as silence.

import { TICKS_PER_SECOND } from '../model/motion.ts';
import type { Clock } from '../robot/clock.ts';

/** Most time that one report of the robot counts for. After a busy spell the page receives a longer jump, but its requests may not have
 *  reached the robot, nor the answers the page. */
const MOST_STEP_MS = 100;

export class TickClock implements Clock {
    private ms = 0;
    private reachedMs = 0;
    private nextId = 1;
    private readonly timers = new Map<number, { readonly atMs: number; readonly call: () => void }>();

    now(): number {
        return this.ms;
    }

    after(delayMs: number, call: () => void): () => void {
        const id = this.nextId++;
        this.timers.set(id, { atMs: this.ms + delayMs, call });
        return () => this.timers.delete(id);
    }

    pass(delayMs: number): Promise<void> {
        return new Promise(resolve => this.after(delayMs, resolve));
    }

    reach(ticks: number): void {
        const robotMs = (1000 * ticks) / TICKS_PER_SECOND;
        this.ms += Math.min(robotMs - this.reachedMs, MOST_STEP_MS);
        this.reachedMs = robotMs;
        for (const [id, timer] of [...this.timers]) {
            if (timer.atMs > this.ms || !this.timers.delete(id)) continue;
            timer.call();
        }
    }
}
