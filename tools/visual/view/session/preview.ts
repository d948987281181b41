// SPDX-License-Identifier: MIT
// A motion of the document as the firmware's own player makes it, in the picture only: nothing is written and no robot moves.

import type { Place } from '../../model/space.ts';
import type { Store } from '../store.ts';

/** What the figure in the picture is: the step that is edited, a motion that is only shown, or the robot. */
export type Figure = 'step' | 'shown' | 'robot';

export interface PreviewState {
    readonly figure: Figure;
    /** The page that is shown, or was last; 0: none. */
    readonly page: number;
    readonly isRunning: boolean;
    readonly isLooping: boolean;
    /** Of 1/128 s, from the beginning; the whole motion lasts `ticks`, and what it leads to is in it. */
    readonly tick: number;
    readonly ticks: number;
    /** Where it is at that tick: page and step, which counts from 1. */
    readonly at: { readonly page: number; readonly step: number };
}

/** Servo units by ID, and where the trunk is. */
export interface ShownPose {
    readonly positions: ArrayLike<number>;
    readonly trunk: Place;
}

export interface Preview {
    readonly state: Store<PreviewState>;
    /** Shows a motion from its beginning, or from a step (0..6) of its page. false: it has no action. */
    start(page: number, step?: number): boolean;
    /** Goes on from where it stands; at its end, from the beginning. */
    resume(): void;
    pause(): void;
    /** Stands still at this tick. */
    seek(page: number, tick: number): void;
    /** The first tick of a step (0..6) of the page that is shown. */
    tickOf(page: number, step: number): number;
    /** Ticks since the step that is shown began. */
    sinceStep(): number;
    setLooping(isLooping: boolean): void;
    /** The figure is the edited step again. */
    showStep(): void;
    /** What is in the picture now; null: nothing is shown. */
    pose(): ShownPose | null;
}
