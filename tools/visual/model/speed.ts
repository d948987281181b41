// SPDX-License-Identifier: MIT
// What a servo can do, and where a motion asks for more, on the curve that the firmware's player made. The servo's speed comes
// with the body (m512's figure).

import type { ServoSheet } from './body.ts';
import { JOINTS, PLAYER_EVENT, TICKS_PER_SECOND } from './motion.ts';
import type { Curve } from './motion.ts';

/** 1024 units are 300 degrees; a minute has 60 s. */
const UNITS_PER_TURN = (360 / 300) * 1024;
/** Speed is measured over so many ticks, for goals are whole units. */
export const SPEED_WINDOW = 4;
/** 8 cells of 1.2 V. */
export const BATTERY_VOLTS = 9.6;

/** Servo units a tick that a servo without load turns at this supply. */
export function topSpeed({ noLoadRpm, sheetVolts }: ServoSheet, volts: number): number {
  return ((noLoadRpm / 60) * UNITS_PER_TURN * (volts / sheetVolts)) / TICKS_PER_SECOND;
}

export interface FastStep {
  readonly page: number;
  /** 0..6 */
  readonly step: number;
  /** The joint that is asked for most, by ID. */
  readonly joint: number;
  /** How many times the servo's top speed. */
  readonly times: number;
}

/** Speed of a joint at a tick, in units a tick, over the window that ends there. */
export function speedAt(curve: Curve, tick: number, joint: number): number {
  const from = Math.max(0, tick - SPEED_WINDOW);
  if (from === tick) return 0;
  const [now, before] = [curve.goals[tick * JOINTS + joint] ?? 0, curve.goals[from * JOINTS + joint] ?? 0];
  return Math.abs(now - before) / (tick - from);
}

/** Steps in which a joint is asked for more than `limit` (units a tick); the worst joint of each. */
export function fastSteps(curve: Curve, limit: number): FastStep[] {
  const found = new Map<number, FastStep>();
  for (let tick = SPEED_WINDOW; tick < curve.ticks; tick++) {
    const [page = 0, step = 0] = curve.marks.subarray(3 * tick);
    for (let joint = 0; joint < JOINTS; joint++) {
      const times = speedAt(curve, tick, joint) / limit;
      const worst = found.get(page * 8 + step);
      if (times > 1 && times > (worst?.times ?? 0)) found.set(page * 8 + step, { page, step: step - 1, joint, times });
    }
  }
  return [...found.values()];
}

/** Ticks until the play leaves the page that it began with, or has played it once. */
export function ticksOfPage(curve: Curve, page: number): number {
  for (let tick = 1; tick < curve.ticks; tick++) {
    const [on = 0, , events = 0] = curve.marks.subarray(3 * tick);
    if (on !== page || events & PLAYER_EVENT.page) return tick;
  }
  return curve.ticks;
}
