// SPDX-License-Identifier: MIT
// Motions tried in physics, as the views see it. app/trials.ts is behind it.

import type { Shape } from '../../model/motion.ts';
import type { StepTouch, Touch, Verdict } from '../../model/trial.ts';
import type { Store } from '../store.ts';

/** What came of one page. */
export interface PageTrial {
    readonly verdict: Verdict;
    /** Pages that were played, in the order of their beginnings. */
    readonly pages: readonly number[];
    /** Limbs that meet in its own steps, as they are asked for; none that only brush. */
    readonly touches: readonly StepTouch[];
}

export interface TrialsState {
    /** loading: physics, at the first trial. */
    readonly phase: 'idle' | 'loading' | 'trying' | 'failed';
    /** Tried now; null: none. */
    readonly page: number | null;
    readonly done: number;
    readonly total: number;
    readonly trials: ReadonlyMap<number, PageTrial>;
    /** Why nothing can be tried, in the words of what failed; null: nothing failed. */
    readonly trouble: string | null;
}

export interface Trials {
    readonly state: Store<TrialsState>;
    /** Plays these pages one after the other in physics; those whose trial still holds are left out. */
    run(pages: readonly number[]): Promise<void>;
    /** Ends run() behind the page under way; what is known stays. */
    cancel(): void;
    /** Nothing that the play of this page reaches has changed since it was tried. */
    isFresh(page: number): boolean;
    /** Where the servos are in a play of this page, tick by tick (31 servo units by ID; NaN: no such servo); null when it cannot be
     *  played, does not stand in its first pose, or there is no physics. Rejects when it is aborted. */
    follow(page: number, ticks: number, shape: Shape, signal: AbortSignal): Promise<Float32Array | null>;
    /** Links that are in each other in a pose (servo units by ID). Without physics: none. */
    touching(pose: ArrayLike<number>): Promise<readonly Touch[]>;
}
