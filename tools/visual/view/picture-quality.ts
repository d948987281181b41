// SPDX-License-Identifier: MIT
// Picture quality, chosen from frame times so that the picture stays fluent on a weak GPU. It goes down fast and up slowly, so that it does
// not oscillate. Without a GPU it is fixed, and only the frame rate is limited.

export interface Quality {
    /** Factor for the resolution; 1: the screen's own pixels. */
    readonly pixels: number;
    readonly shadows: boolean;
}

const STEPS: readonly Quality[] = [
    { pixels: 1, shadows: true },
    { pixels: 0.75, shadows: true },
    { pixels: 0.6, shadows: true },
    { pixels: 0.45, shadows: false },
];
const SLOW_MS = 45;
const FAST_MS = 22;
const DOWN_AFTER = 8; // frames
const SOFTWARE_MS = 60;
const UP_AFTER = 240;

export class PictureQuality {
    private step: number;
    private slow = 0;
    private fast = 0;
    private readonly bySoftware: boolean;

    constructor(bySoftware: boolean) {
        this.bySoftware = bySoftware;
        this.step = bySoftware ? 2 : 0;
    }

    /** Least milliseconds between two pictures. Drawing in software takes at most half of the time, to leave the processor to the robot.
     *  frameMs: duration of the last picture. */
    restMs(frameMs: number): number {
        return this.bySoftware ? Math.max(SOFTWARE_MS, 2 * frameMs) : 0;
    }

    /** It goes up again by itself, but only in frames. */
    get isLowered(): boolean {
        return !this.bySoftware && this.step > 0;
    }

    get quality(): Quality {
        return STEPS[this.step] ?? { pixels: 1, shadows: true };
    }

    /** Takes the duration of a frame; true: the quality has changed. */
    take(frameMs: number): boolean {
        if (this.bySoftware) return false; // always slow
        this.slow = frameMs > SLOW_MS ? this.slow + 1 : 0;
        this.fast = frameMs < FAST_MS ? this.fast + 1 : 0;
        const change = this.slow >= DOWN_AFTER && this.step < STEPS.length - 1 ? 1 : this.fast >= UP_AFTER && this.step > 0 ? -1 : 0;
        if (change === 0) return false;
        this.step += change;
        this.slow = this.fast = 0;
        return true;
    }
}
