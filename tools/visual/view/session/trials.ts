// SPDX-License-Identifier: MIT
// Interface of the views to trials of motions in physics. app/trials.ts implements it.

import type { Shape } from '../../model/motion.ts';
import type { StepTouch, Touch, Verdict } from '../../model/trial.ts';
import type { Store } from '../store.ts';

/** Result for one page. */
export interface PageTrial {
    readonly verdict: Verdict;
    /** Pages played, in order of their start. */
    readonly pages: readonly number[];
    /** Limbs that collide in the page's own steps, in commanded poses; without mere brushes. */
    readonly touches: readonly StepTouch[];
}

export interface TrialsState {
    /** loading: loads physics, at the first trial. */
    readonly phase: 'idle' | 'loading' | 'trying' | 'failed';
    /** Page under trial; null: none. */
    readonly page: number | null;
    readonly done: number;
    readonly total: number;
    readonly trials: ReadonlyMap<number, PageTrial>;
    /** Error text when trials are impossible; null: no error. */
    readonly trouble: string | null;
}

export interface Trials {
    readonly state: Store<TrialsState>;
    /** Plays these pages one after the other in physics. Pages whose trial is still valid are skipped. */
    run(pages: readonly number[]): Promise<void>;
    /** Stops run(). The page under trial gets no result; earlier results stay. */
    cancel(): void;
    /** The page was tried, and nothing that its play reaches has changed since. */
    isFresh(page: number): boolean;
    /** As isFresh(), and it was played to its end. */
    isJudged(page: number): boolean;
    /** Servo positions in a play of this page, tick by tick (31 servo units by ID; NaN: no such servo). null: it cannot be played, the
     *  robot does not stand in its first pose, or there is no physics. Rejects when aborted. */
    follow(page: number, ticks: number, shape: Shape, signal: AbortSignal): Promise<Float32Array | null>;
    /** Links that intersect in a pose (servo units by ID). Without physics: none. */
    touching(pose: ArrayLike<number>): Promise<readonly Touch[]>;
}
