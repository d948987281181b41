// SPDX-License-Identifier: MIT
// Left and right of the body: which joint is the other side's, and what its position is there. Read off the body's names
// (right_knee, left_knee) and axes; a joint without a partner is its own.

import type { Body, Joint } from './body.ts';
import { POSITION_MAX } from './body.ts';

export interface MirrorPartner {
  readonly servo: number;
  /** Position there = zero there + sign (position here - zero here). */
  readonly sign: 1 | -1;
  readonly zero: number;
  readonly ownZero: number;
}

export type MirrorMap = ReadonlyMap<number, MirrorPartner>;

function otherName(name: string): string {
  if (name.startsWith('right_')) return name.replace('right_', 'left_');
  return name.startsWith('left_') ? name.replace('left_', 'right_') : name;
}

/** Seen in a mirror that stands between left and right, a turn about (x, y, z) is the same turn about (-x, y, -z). */
function turnSign(joint: Joint, partner: Joint): 1 | -1 {
  const dot = -joint.axis[0] * partner.axis[0] + joint.axis[1] * partner.axis[1] - joint.axis[2] * partner.axis[2];
  return dot >= 0 ? 1 : -1;
}

export function mirrorMap(body: Body): MirrorMap {
  const byName = new Map(body.joints.map((joint) => [joint.name, joint]));
  return new Map(body.joints.map((joint) => {
    const partner = byName.get(otherName(joint.name)) ?? joint;
    const sign = turnSign(joint, partner) * joint.direction * partner.direction;
    return [joint.servo, { servo: partner.servo, sign: sign > 0 ? 1 : -1, zero: partner.zero, ownZero: joint.zero }];
  }));
}

/** The position that the partner has in the mirror, kept within what a servo knows. */
export function mirroredPosition(partner: MirrorPartner, position: number): number {
  const there = partner.zero + partner.sign * (position - partner.ownZero);
  return Math.min(Math.max(Math.round(there), 0), POSITION_MAX);
}
