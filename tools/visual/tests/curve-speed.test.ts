// SPDX-License-Identifier: MIT
// Finds goals that are too fast, and checks that shaping changes curves as SHAPING.md says.
import { expect, test } from 'vitest';
import { tooFast } from '../model/curve-speed.ts';
import { AS_STORED, JOINTS } from '../model/motion.ts';
import type { Curve } from '../model/motion.ts';
import { libraryDocument, makeMotion } from './motion-bench.ts';

function curveOf(goals: readonly number[], joint: number): Curve {
    const all = new Uint16Array(goals.length * JOINTS).fill(512);
    for (const [tick, goal] of goals.entries()) all[tick * JOINTS + joint] = goal;
    return { ticks: goals.length, goals: all, marks: new Uint8Array(3 * goals.length), ended: true };
}

test('a ramp of 8 units a tick is too fast for 7.5, not for 8; others stand', () => {
    const goals = [
        ...Array.from({ length: 10 }, () => 300),
        ...Array.from({ length: 20 }, (_, i) => 308 + 8 * i),
        ...Array.from({ length: 10 }, () => 460),
    ];
    expect(tooFast(curveOf(goals, 5), 5, 7.5)).toEqual([[expect.closeTo(8, -1), expect.closeTo(32, -1)]]);
    expect(tooFast(curveOf(goals, 5), 5, 8)).toEqual([]);
    expect(tooFast(curveOf(goals, 5), 6, 0.5)).toEqual([]);
});

test('the top speed is 90 % of 8.7 units a tick at 11.1 V, in proportion (body/README.md)', async () => {
    const motion = await makeMotion();
    for (const volts of [8, 9.6, 11.1, 12]) expect(motion.topSpeed(volts)).toBeCloseTo((0.9 * 8.7 * volts) / 11.1, 0);
    expect(motion.topSpeed(0)).toBe(0);
});

test('a wave at half speed takes twice as long, at amplitude 0 it stands in the pose of page 1', async () => {
    const motion = await makeMotion();
    for (const [page, bytes] of (await libraryDocument()).pages.entries()) motion.setPage(page, bytes);
    const play = (shape: Parameters<typeof motion.setShape>[0]): Curve => {
        motion.setShape(shape);
        const pose = motion.firstPose(3, new Uint16Array(JOINTS).fill(512));
        expect(motion.start(3, pose)).toBe(true);
        return motion.curve(4096);
    };
    const stored = play(AS_STORED);
    expect(play({ ...AS_STORED, rate: 50 }).ticks / stored.ticks).toBeCloseTo(2, 1);
    const still = play({ ...AS_STORED, amplitude: 0 });
    motion.setShape(AS_STORED);
    const ready = motion.firstPose(1, new Uint16Array(JOINTS).fill(512));
    for (let servo = 1; servo <= 18; servo++) expect(still.goals[(still.ticks >> 1) * JOINTS + servo]).toBe(ready[servo]);
    expect(() => motion.setShape({ ...AS_STORED, rate: 5 })).toThrow(RangeError);
});
