// SPDX-License-Identifier: MIT
// Computes how much simulated time is due. Pure: the wall clock is an argument.

import { CYCLES_PER_MS } from './board.ts';

/** A longer delay (a hidden tab, a computer that slept) is skipped: a robot must not leap to catch up. */
const FORGIVEN_MS = 250;

export class Pacer {
    private speed = 1;
    private startMs = 0;
    private startCycle = 0;

    /** speed: simulated seconds per second. 0 pauses, Infinity runs as fast as possible. */
    setSpeed(speed: number, nowMs: number, cycle: number): void {
        this.speed = speed;
        this.startMs = nowMs;
        this.startCycle = cycle;
    }

    get currentSpeed(): number {
        return this.speed;
    }

    get isPaused(): boolean {
        return this.speed === 0;
    }

    /** The cycle that should be reached by now. */
    dueCycle(nowMs: number, cycle: number): number {
        if (this.speed === 0) return cycle;
        if (this.speed === Infinity) return Infinity;
        const due = this.startCycle + (nowMs - this.startMs) * this.speed * CYCLES_PER_MS;
        if (due - cycle <= FORGIVEN_MS * CYCLES_PER_MS * Math.max(1, this.speed)) return due;
        this.setSpeed(this.speed, nowMs, cycle);
        return cycle;
    }

    /** Wall-clock milliseconds that the simulation is late; 0 if paused or unthrottled. */
    lateMs(nowMs: number, cycle: number): number {
        if (this.speed === 0 || this.speed === Infinity) return 0;
        const due = this.startCycle + (nowMs - this.startMs) * this.speed * CYCLES_PER_MS;
        return Math.max(0, (due - cycle) / CYCLES_PER_MS / this.speed);
    }
}
