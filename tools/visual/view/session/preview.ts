// SPDX-License-Identifier: MIT
// Interface of the views to the preview: a motion of the document, computed by the firmware's own player and shown only in the picture.
// Nothing is written and no robot moves.

import type { Place } from '../../model/space.ts';
import type { Store } from '../store.ts';

/** What the figure in the picture shows: the edited step, a previewed motion or the robot. */
export type Figure = 'step' | 'shown' | 'robot';

export interface PreviewState {
    readonly figure: Figure;
    /** The page shown now or last; 0: none. */
    readonly page: number;
    readonly isRunning: boolean;
    readonly isLooping: boolean;
    /** Ticks of 1/128 s since the beginning. The motion and what it leads to last `ticks`. */
    readonly tick: number;
    readonly ticks: number;
    /** Page and step at that tick; steps count from 1. */
    readonly at: { readonly page: number; readonly step: number };
}

/** positions: servo units by ID. */
export interface ShownPose {
    readonly positions: ArrayLike<number>;
    readonly trunk: Place;
}

export interface Preview {
    readonly state: Store<PreviewState>;
    /** Shows a motion from its beginning, or from a step (0..6) of its page. false: the page has no action. */
    start(page: number, step?: number): boolean;
    /** Continues; from the end, starts over. */
    resume(): void;
    /** Outside the areas in which steps are edited, the picture goes back to the robot. */
    pause(): void;
    /** Shows this tick and pauses. */
    seek(page: number, tick: number): void;
    /** First tick of a step (0..6) of the page; 0: it is not played. */
    tickOf(page: number, step: number): number;
    /** Ticks since the start of the step shown. */
    sinceStep(): number;
    setLooping(isLooping: boolean): void;
    /** Switches the figure back to the edited step. */
    showStep(): void;
    /** The pose shown now; null: no motion is shown. */
    pose(): ShownPose | null;
}
