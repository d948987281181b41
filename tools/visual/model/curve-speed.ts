// SPDX-License-Identifier: MIT
// Where a curve asks more of a servo than it can do.

import { JOINTS } from './motion.ts';
import type { Curve } from './motion.ts';

/** Ticks [from, to) of a curve. */
export type TickSpan = readonly [from: number, to: number];

/** Where a joint is asked to go faster than `unitsPerTick`: the spans between whose ticks it hurries. A goal is a whole number:
 *  speeds are taken over four ticks, so that rounding does not count. */
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
