// SPDX-License-Identifier: MIT
// Which servos are still being taught when some servos hold again.
import { expect, test } from 'vitest';
import { stillTaught } from '../view/editor/editing.ts';

const taught = new Set([1, 3, 5, 11]);

test('a servo that was limp and holds is taught no more; one that goes limp, or has not done it yet, is', () => {
    expect([...stillTaught(taught, [1, 3, 5], [])]).toEqual([11]);
    expect([...stillTaught(taught, [1, 3, 5], [3])]).toEqual([3, 11]);
    expect([...stillTaught(taught, [], [1, 3])]).toEqual([1, 3, 5, 11]);
});

test('servos that nobody teaches change nothing', () => {
    expect([...stillTaught(taught, [2, 4], [])]).toEqual([1, 3, 5, 11]);
});
