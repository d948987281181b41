// SPDX-License-Identifier: MIT
// What physics says of a motion: the record of one trial and the verdict on it, and limbs that meet. Pure; sim/trial.ts
// makes the records.

import { JOINTS, MARK_BYTES, TICKS_PER_SECOND } from './motion.ts';
import type { Curve, Law, Shape } from './motion.ts';

/** Two links of the body, by name, in the order of the alphabet. */
export type LinkPair = readonly [string, string];

export interface Touch {
    readonly links: LinkPair;
    /** How far one would be in the other. Metres. */
    readonly depthM: number;
}

/** One motion to be tried, from standing in its first pose. */
export interface TrialRequest {
    /** 65,536 bytes, as they lie in flash. */
    readonly image: Uint8Array;
    readonly page: number;
    readonly law: Law;
    readonly shape: Shape;
    /** Where the joints stand first: servo units by ID. */
    readonly pose: ArrayLike<number>;
    /** Of 1/128 s, that are recorded. */
    readonly ticks: number;
    /** What still plays then is told to stop, as by a remote, and looked at until it has; else it is broken off. */
    readonly toTheEnd: boolean;
    readonly volts: number;
}

/** A moment of a play: tick since its beginning, page 1..127, step 0..6. */
export interface TrialMoment {
    readonly tick: number;
    readonly page: number;
    readonly step: number;
}

export interface TrialRecord {
    /** It stood in its first pose for a quarter of a second; if not, it was not played. */
    readonly stood: boolean;
    /** That were recorded. */
    readonly ticks: number;
    /** Of each of these ticks, servo units by ID: JOINTS numbers. NaN: no such servo. */
    readonly positions: Float32Array;
    /** Pages that were played, in the order of their beginnings. */
    readonly pages: readonly number[];
    /** When its trunk was tilted by more than 60 degrees for the first time. */
    readonly fell: TrialMoment | null;
    /** The play came to its end: by itself, or when it was told to. */
    readonly ended: boolean;
    /** In the end it stood upright, and nothing but its soles touched the floor. */
    readonly onFeet: boolean;
}

/** stands: on its feet. rises: was on the floor on the way, and is on its feet in the end. falls: stays on the floor.
 *  low: upright, but not on its soles alone in the end (sits, kneels, leans). no-start: does not stand in its first pose. */
export type VerdictKind = 'stands' | 'rises' | 'falls' | 'low' | 'no-start';

export interface Verdict {
    readonly kind: VerdictKind;
    /** Of the fall, or of going down; null where there was none. */
    readonly at: TrialMoment | null;
    /** That it was played for. */
    readonly seconds: number;
}

export function verdictOf({ stood, fell, ended, onFeet, ticks }: TrialRecord): Verdict {
    const kind = !stood ? 'no-start' : fell ? (onFeet ? 'rises' : 'falls') : onFeet || !ended ? 'stands' : 'low';
    return { kind, at: fell, seconds: ticks / TICKS_PER_SECOND };
}

/** Less than this is brushing: the reach of a hand and the bend of a bracket are not known better. Metres. */
export const BRUSH_M = 0.003;

/** Limbs that meet in a step of a page, or on the way to it. */
export interface StepTouch extends Touch {
    /** 0..6 */
    readonly step: number;
}

/** Of the ticks of a curve every so many are looked at. */
export const TOUCH_STRIDE = 4;

/** The poses of one page in its curve that are to be looked at: JOINTS numbers each, and the step of each. */
export function posesOf({ ticks, goals, marks }: Curve, page: number): { readonly poses: Uint16Array; readonly steps: readonly number[] } {
    const seen = Array.from({ length: Math.ceil(ticks / TOUCH_STRIDE) }, (_, i) => i * TOUCH_STRIDE).filter(
        tick => marks[MARK_BYTES * tick] === page,
    );
    const poses = new Uint16Array(seen.length * JOINTS);
    for (const [i, tick] of seen.entries()) poses.set(goals.subarray(tick * JOINTS, (tick + 1) * JOINTS), i * JOINTS);
    return { poses, steps: seen.map(tick => (marks[MARK_BYTES * tick + 1] ?? 1) - 1) };
}

/** The deepest touch of each step. touches: of each pose, in the order of `steps`. */
export function deepestTouches(steps: readonly number[], touches: readonly (readonly Touch[])[]): StepTouch[] {
    const worst = new Map<number, StepTouch>();
    for (const [i, found] of touches.entries()) {
        const step = steps[i] ?? 0;
        for (const touch of found) if (touch.depthM > (worst.get(step)?.depthM ?? BRUSH_M)) worst.set(step, { ...touch, step });
    }
    return [...worst.values()].sort((a, b) => a.step - b.step);
}
