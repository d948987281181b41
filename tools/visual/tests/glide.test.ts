// SPDX-License-Identifier: MIT
import { expect, test } from 'vitest';
import { glide } from '../view/glide.ts';

/** The remaining distance of 1 after frames of these lengths in milliseconds. */
const left = (framesMs: readonly number[]): number => framesMs.reduce((way, ms) => way * (1 - glide(0.08, ms)), 1);

test('a camera that follows is as far after a second of 60 pictures, of 16, of 2, and of uneven ones', () => {
    const fluent = left(Array.from({ length: 60 }, () => 1000 / 60));
    expect(fluent).toBeCloseTo(0.92 ** 60, 10);
    for (const frames of [Array.from({ length: 16 }, () => 1000 / 16), [500, 500], [1000], [3, 700, 40, 257]])
        expect(left(frames)).toBeCloseTo(fluent, 10);
});

test('it stays where it is when no time has passed, and comes no further than there', () => {
    expect(glide(0.12, 0)).toBe(0);
    expect(glide(0.12, -5)).toBe(0);
    expect(glide(0.12, 3_600_000)).toBe(1);
});
