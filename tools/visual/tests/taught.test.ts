// SPDX-License-Identifier: MIT
// Teaching by hand: which servos are still being taught when some hold again, and when the robot's pose is known.
import { expect, test } from 'vitest';
import { isPoseKnown, stillTaught } from '../view/editor/editing.ts';

const taught = new Set([1, 3, 5, 11]);

test('a servo that was limp and holds is taught no more; one that goes limp, or has not done it yet, is', () => {
    expect([...stillTaught(taught, [1, 3, 5], [])]).toEqual([11]);
    expect([...stillTaught(taught, [1, 3, 5], [3])]).toEqual([3, 11]);
    expect([...stillTaught(taught, [], [1, 3])]).toEqual([1, 3, 5, 11]);
});

test('servos that nobody teaches change nothing', () => {
    expect([...stillTaught(taught, [2, 4], [])]).toEqual([1, 3, 5, 11]);
});

test('a pose is added as a step only from a robot that answers; the one in the page has it always', () => {
    expect(isPoseKnown('simulated', 'asking')).toBe(true);
    expect(['ready', 'silent', 'waiting', 'closed'].map(state => isPoseKnown('yours', state as 'ready'))).toEqual([
        true,
        false,
        false,
        false,
    ]);
    expect(isPoseKnown('servos', 'closed')).toBe(false);
});
