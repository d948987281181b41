// SPDX-License-Identifier: MIT
// The limb that Curves shows first.
import { expect, test } from 'vitest';
import { busiestLimb } from '../model/busiest-limb.ts';

const ARM = { servos: [1, 3, 5] };
const LEG = { servos: [7, 9] };
const step = (positions: Record<number, number>) => ({ positions: Array.from({ length: 31 }, (_, id) => positions[id] ?? null) });

test('the limb of which one joint goes farthest, not the one that moves most joints', () => {
    const steps = [step({ 1: 500, 3: 500, 5: 500, 7: 400, 9: 512 }), step({ 1: 540, 3: 540, 5: 540, 7: 500, 9: 512 })];
    expect(busiestLimb([ARM, LEG], steps)).toEqual([7, 9]);
});

test('a limb that the motion does not use is not chosen; nothing moves: the first one; no step: none', () => {
    expect(busiestLimb([ARM, LEG], [step({ 7: 512 }), step({ 7: 512 })])).toEqual([7, 9]);
    expect(busiestLimb([ARM, LEG], [step({ 1: 512, 7: 512 })])).toEqual([1, 3, 5]);
    expect(busiestLimb([ARM, LEG], [])).toEqual([]);
});
