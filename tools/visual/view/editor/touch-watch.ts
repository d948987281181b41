// SPDX-License-Identifier: MIT
// Which limbs of the figure intersect. Physics is asked in the background, one request at a time and always for the newest pose, so that a
// drag never waits.

import type { Touch } from '../../model/trial.ts';
import type { Trials } from '../session/trials.ts';

const NONE: readonly Touch[] = [];

export class TouchWatch {
    private readonly trials: Pick<Trials, 'touching'>;
    private readonly answered: () => void;
    private asked: readonly number[] | null = null;
    private wanted: readonly number[] | null = null;
    private isAsking = false;
    /** Result for the last pose that was answered. */
    touches = NONE;

    /** answered: there is a result, and look() may ask again. */
    constructor(trials: Pick<Trials, 'touching'>, answered: () => void) {
        this.trials = trials;
        this.answered = answered;
    }

    /** Takes the current pose (servo units by ID); null: clears the result. */
    look(pose: readonly number[] | null): void {
        this.wanted = pose;
        if (pose === null) {
            this.touches = NONE;
            this.asked = null;
        } else if (!this.isAsking && !isSame(pose, this.asked)) void this.ask(pose);
    }

    private async ask(pose: readonly number[]): Promise<void> {
        this.isAsking = true;
        this.asked = pose;
        const touches = await this.trials.touching(pose);
        this.isAsking = false;
        if (this.wanted !== null) this.touches = touches;
        this.answered();
    }
}

function isSame(a: readonly number[], b: readonly number[] | null): boolean {
    return b !== null && a.every((position, id) => position === b[id]);
}
