// SPDX-License-Identifier: MIT
// Decides when the browser is asked for a frame of the picture. A picture at rest asks for none, which saves battery and leaves the
// processor to the robot.
//
//            ask(): something shown has changed
//   AT REST ------------------------------------> ASKED --+
//      ^                                          ^  |    | new, moving, not on the screen yet, or its quality is lowered
//      |                   nothing new            |  |    |
//      +-------------------------------------------- + <--+

import type { PictureQuality } from './picture-quality.ts';

/** Time that the first frame after a rest stands for. What glides must not leap by the length of the rest. */
const FIRST_MS = 1000 / 60;

export interface FrameParts {
    /** The last picture drawn is not visible yet. */
    isBusy(): boolean;
    /** elapsedMs: since the last call. isNew: the picture has changed and was drawn. isMoving: it will change by itself. */
    draw(elapsedMs: number): { readonly isNew: boolean; readonly isMoving: boolean };
    /** The picture that was drawn last is visible. */
    shown(): void;
    /** The quality has changed. */
    resize(): void;
}

export class PictureFrames {
    private readonly parts: FrameParts;
    private readonly quality: PictureQuality;
    private request = 0;
    private isFirst = true;
    private beforeMs = 0;
    private tookMs = 0;
    private wasNew = false;

    constructor(quality: PictureQuality, parts: FrameParts) {
        this.quality = quality;
        this.parts = parts;
    }

    /** Something shown has changed, or may have. */
    ask(): void {
        if (this.request === 0) this.request = requestAnimationFrame(nowMs => this.frame(nowMs));
    }

    get isAtRest(): boolean {
        return this.request === 0;
    }

    dispose(): void {
        cancelAnimationFrame(this.request);
    }

    private frame(nowMs: number): void {
        this.request = 0;
        if (this.step(nowMs)) this.ask();
        this.isFirst = this.isAtRest;
    }

    /** true: another frame is needed. */
    private step(nowMs: number): boolean {
        if (this.parts.isBusy()) return true;
        const sinceMs = nowMs - this.beforeMs;
        if (this.wasNew) {
            this.tookMs = sinceMs; // the browser calls again when it has finished drawing
            this.parts.shown();
        }
        this.wasNew = false;
        if (sinceMs < this.quality.restMs(this.tookMs)) return true;
        if (!this.isFirst && this.quality.take(sinceMs)) this.parts.resize();
        this.beforeMs = nowMs;
        const { isNew, isMoving } = this.parts.draw(this.isFirst ? FIRST_MS : sinceMs);
        this.wasNew = isNew;
        return isNew || isMoving || this.quality.isLowered;
    }
}
