// SPDX-License-Identifier: MIT
// How much robot time is due, for a wall clock set by the test. A millisecond of the board is 16,000 cycles.
import { expect, test } from 'vitest';
import { Pacer } from '../sim/pacer.ts';

const MS = 16_000;

test.each([
    [0.1, 1],
    [0.25, 2.5],
    [1, 10],
    [4, 40],
])('at %f x, 10 ms of the clock make %f ms of the robot due', (speed, dueMs) => {
    const pacer = new Pacer();
    pacer.setSpeed(speed, 1000, 500);
    expect(pacer.dueCycle(1010, 500)).toBeCloseTo(500 + dueMs * MS, 3);
});

test('a pause stands still, and what passed meanwhile is not caught up', () => {
    const pacer = new Pacer();
    pacer.setSpeed(1, 0, 0);
    pacer.setSpeed(0, 100, 100 * MS);
    expect(pacer.dueCycle(60_000, 100 * MS)).toBe(100 * MS);
    pacer.setSpeed(1, 60_000, 100 * MS);
    expect(pacer.dueCycle(60_010, 100 * MS)).toBe(110 * MS);
});

test('a tab that slept does not catch up: no more than a quarter of a second is due at once', () => {
    const pacer = new Pacer();
    pacer.setSpeed(1, 0, 0);
    expect(pacer.dueCycle(250, 0)).toBe(250 * MS);
    expect(pacer.dueCycle(3000, 0)).toBe(0); // the delay is skipped
    expect(pacer.dueCycle(3010, 0)).toBe(10 * MS);
});
