// SPDX-License-Identifier: MIT
// Finds the limb that a motion moves most.

import type { Step } from './page.ts';

export interface Limb {
    readonly servos: readonly number[];
}

/** Servo IDs of the limb whose joint travels farthest in these steps. The first limb if nothing moves; empty if there are no steps. */
export function busiestLimb(limbs: readonly Limb[], steps: readonly Pick<Step, 'positions'>[]): readonly number[] {
    if (steps.length === 0) return [];
    const travel = (servo: number): number => {
        const positions = steps.flatMap(step => step.positions[servo] ?? []);
        return positions.length === 0 ? -1 : Math.max(...positions) - Math.min(...positions);
    };
    let best: { servos: readonly number[]; travel: number } = { servos: [], travel: -1 };
    for (const { servos } of limbs) {
        const most = Math.max(-1, ...servos.map(travel));
        if (most > best.travel) best = { servos, travel: most };
    }
    return best.servos;
}
