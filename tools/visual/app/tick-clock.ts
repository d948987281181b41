// SPDX-License-Identifier: MIT
// The clock of the robot in the page: its time-outs count its own time, so that a slow or busy computer, slow motion and a
// pause are no silence of the robot.

import { TICKS_PER_SECOND } from '../model/motion.ts';
import type { Clock } from '../robot/clock.ts';

/** A page that was busy hears of more than this at once. What it asked meanwhile may not have reached the robot, and the answer
 *  not the page: so much counts as passed, and no more. */
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

    /** Resolves when so much of the robot's time has passed. */
    pass(delayMs: number): Promise<void> {
        return new Promise(resolve => this.after(delayMs, resolve));
    }

    /** The robot has come so far. */
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
