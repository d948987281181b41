// SPDX-License-Identifier: MIT
// How fine the picture is, from what its frames took: a picture by software stands in the way of keys while it is drawn.
import { expect, test } from 'vitest';
import { PictureQuality } from '../view/picture-quality.ts';

const SLOW = 150;
const FLUENT = 70;

/** So many looks at a robot that moves, drawn by software. */
function look(quality: PictureQuality, looks: number, drawMs: number | null): void {
    for (let i = 0; i < looks; i++) quality.take(quality.restMs(drawMs ?? 0), drawMs);
}

test('by software: pictures that take long lose their shadows, others keep them', () => {
    const quality = new PictureQuality(true);
    const first = quality.quality;
    look(quality, 100, FLUENT);
    expect(quality.quality).toBe(first);
    look(quality, 100, SLOW);
    expect(quality.quality.shadows).toBe(false);
    look(quality, 100, SLOW / 2); // what they take without shadows: no reason to swing
    expect(quality.quality.shadows).toBe(false);
});

test('by software: one slow picture, or a robot that stands still, changes nothing, nor is it ever finer than at the start', () => {
    const quality = new PictureQuality(true);
    const first = quality.quality;
    look(quality, 1, SLOW);
    look(quality, 1000, null);
    expect(quality.quality).toBe(first);
    look(quality, 1000, 5);
    expect(quality.quality).toBe(first);
    look(quality, 100, SLOW);
    look(quality, 1000, 5);
    expect(quality.quality).toBe(first);
});

test('by a graphics chip: what counts is the time from frame to frame', () => {
    const quality = new PictureQuality(false);
    const first = quality.quality;
    for (let i = 0; i < 100; i++) quality.take(60, null);
    expect(quality.quality.shadows).toBe(false);
    for (let i = 0; i < 1000; i++) quality.take(16, null);
    expect(quality.quality).toBe(first);
});
