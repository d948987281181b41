// SPDX-License-Identifier: MIT
// Which limb a motion moves most.

import type { Step } from './page.ts';

export interface Limb {
    readonly servos: readonly number[];
}

/** Servos of the limb of which a joint goes farthest through these steps; the first one when nothing moves; none when there is no step. */
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
