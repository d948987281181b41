// SPDX-License-Identifier: MIT
// What physics says of a motion: the record of one trial, the verdict on it, and limbs that touch. Pure. sim/trial.ts makes the records.

import { JOINTS, MARK_BYTES, TICKS_PER_SECOND } from './motion.ts';
import type { Curve, Law, Shape } from './motion.ts';

/** The names of two links of the body in alphabetical order. */
export type LinkPair = readonly [string, string];

export interface Touch {
    readonly links: LinkPair;
    /** How far one link would be inside the other. Metres. */
    readonly depthM: number;
}

/** A motion to try. The robot starts standing in the motion's first pose; joints that this does not use are where it stands otherwise. */
export interface TrialRequest {
    /** 65,536 bytes, as in flash. */
    readonly image: Uint8Array;
    readonly page: number;
    readonly law: Law;
    readonly shape: Shape;
    /** Start positions of the joints: servo units by ID. */
    readonly pose: ArrayLike<number>;
    /** Number of ticks (1/128 s) to record. */
    readonly ticks: number;
    /** What happens to a play that goes on after these ticks. true: it is stopped as by a remote and watched until it ends. false: it is
     *  cut off. */
    readonly toTheEnd: boolean;
    readonly volts: number;
}

/** A moment of a play: tick since its start, page 1..127, step 0..6. */
export interface TrialMoment {
    readonly tick: number;
    readonly page: number;
    readonly step: number;
}

export interface TrialRecord {
    /** It stood in its first pose for a quarter of a second. If not, it was not played. */
    readonly stood: boolean;
    /** Number of recorded ticks. */
    readonly ticks: number;
    /** For each recorded tick JOINTS servo positions by ID. NaN: no such servo. */
    readonly positions: Float32Array;
    /** The played pages in the order of their first play. */
    readonly pages: readonly number[];
    /** When the trunk first tilted by more than 60 degrees. */
    readonly fell: TrialMoment | null;
    /** The play ended, by itself or because it was stopped. */
    readonly ended: boolean;
    /** At the end the robot is upright and touches the floor only with its soles. */
    readonly onFeet: boolean;
}

/** stands: on its feet. rises: was on the floor, but is on its feet at the end. falls: stays on the floor. low: upright at the end, but not
 *  only on its soles (sits, kneels, leans). no-start: does not stand in its first pose. */
export type VerdictKind = 'stands' | 'rises' | 'falls' | 'low' | 'no-start';

export interface Verdict {
    readonly kind: VerdictKind;
    /** When it fell or went down; null if it did not. */
    readonly at: TrialMoment | null;
    /** Recorded length. */
    readonly seconds: number;
    /** false: the motion goes on longer than it was tried, and nobody knows how. */
    readonly isWhole: boolean;
}

/** isLonger: the play was stopped before all of it was played once. */
export function verdictOf({ stood, fell, ended, onFeet, ticks }: TrialRecord, isLonger = false): Verdict {
    const kind = !stood ? 'no-start' : fell ? (onFeet ? 'rises' : 'falls') : onFeet || !ended ? 'stands' : 'low';
    return { kind, at: fell, seconds: ticks / TICKS_PER_SECOND, isWhole: ended && !isLonger };
}

/** Less than this is a light touch: the length of a hand and the bend of a bracket are not known more precisely. Metres. */
export const BRUSH_M = 0.003;

/** Limbs that touch in a step of a page or on the way to it. */
export interface StepTouch extends Touch {
    /** 0..6 */
    readonly step: number;
}

/** Only every so many ticks of a curve are checked. */
export const TOUCH_STRIDE = 4;

/** The poses of one page of the curve to check, JOINTS numbers each, and the step of each. */
export function posesOf({ ticks, goals, marks }: Curve, page: number): { readonly poses: Uint16Array; readonly steps: readonly number[] } {
    const seen = Array.from({ length: Math.ceil(ticks / TOUCH_STRIDE) }, (_, i) => i * TOUCH_STRIDE).filter(
        tick => marks[MARK_BYTES * tick] === page,
    );
    const poses = new Uint16Array(seen.length * JOINTS);
    for (const [i, tick] of seen.entries()) poses.set(goals.subarray(tick * JOINTS, (tick + 1) * JOINTS), i * JOINTS);
    return { poses, steps: seen.map(tick => (marks[MARK_BYTES * tick + 1] ?? 1) - 1) };
}

/** The deepest touch of each step. touches: for each pose, in the order of `steps`. */
export function deepestTouches(steps: readonly number[], touches: readonly (readonly Touch[])[]): StepTouch[] {
    const worst = new Map<number, StepTouch>();
    for (const [i, found] of touches.entries()) {
        const step = steps[i] ?? 0;
        for (const touch of found) if (touch.depthM > (worst.get(step)?.depthM ?? BRUSH_M)) worst.set(step, { ...touch, step });
    }
    return [...worst.values()].sort((a, b) => a.step - b.step);
}
