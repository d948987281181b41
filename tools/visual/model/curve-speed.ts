// SPDX-License-Identifier: MIT
// Finds where a curve asks for more speed than a servo has.

import { JOINTS, MARK_BYTES } from './motion.ts';
import type { Curve } from './motion.ts';

/** Ticks [from, to) of a curve. */
export type TickSpan = readonly [from: number, to: number];

/** The spans in which a joint is asked to move faster than `unitsPerTick`. Goals are whole numbers, so speed is measured over four ticks to
 *  exclude rounding. */
export function tooFast(curve: Curve, joint: number, unitsPerTick: number): TickSpan[] {
    const goal = (tick: number): number => curve.goals[tick * JOINTS + joint] ?? 0;
    const spans: [number, number][] = [];
    for (let tick = OVER_TICKS; tick < curve.ticks; tick++) {
        if (Math.abs(goal(tick) - goal(tick - OVER_TICKS)) <= unitsPerTick * OVER_TICKS + 1) continue;
        const last = spans.at(-1);
        if (last && last[1] >= tick - OVER_TICKS) last[1] = tick + 1;
        else spans.push([tick - OVER_TICKS, tick + 1]);
    }
    return spans;
}

const OVER_TICKS = 4;

export interface FastStep {
    readonly page: number;
    /** 0..6 */
    readonly step: number;
    /** ID of the joint with the highest demand. */
    readonly joint: number;
    /** Multiple of `unitsPerTick`. */
    readonly times: number;
}

/** The steps that ask a joint to move faster than `unitsPerTick`, with the worst joint of each. */
export function fastSteps(curve: Curve, unitsPerTick: number): FastStep[] {
    const worst = new Map<number, FastStep>();
    for (let joint = 0; joint < JOINTS; joint++) {
        const way = (from: number, to: number): number =>
            Math.abs((curve.goals[to * JOINTS + joint] ?? 0) - (curve.goals[from * JOINTS + joint] ?? 0));
        for (const [from, to] of tooFast(curve, joint, unitsPerTick)) {
            for (let tick = from + OVER_TICKS; tick < to; tick++) {
                // The four ticks may reach over the end of a step. Their fastest tick is in the step that is too fast.
                let fastest = tick;
                for (let one = tick - OVER_TICKS + 1; one < tick; one++) if (way(one - 1, one) > way(fastest - 1, fastest)) fastest = one;
                const [page = 0, step = 0] = curve.marks.subarray(MARK_BYTES * fastest);
                const times = way(tick - OVER_TICKS, tick) / OVER_TICKS / unitsPerTick;
                const key = (page << 3) | step;
                if (times > Math.max(1, worst.get(key)?.times ?? 0)) worst.set(key, { page, step: step - 1, joint, times });
            }
        }
    }
    return [...worst.values()];
}
