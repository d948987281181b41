// SPDX-License-Identifier: MIT
// The camera follows a driven robot from behind. The floor moves along in whole tile patterns.
import { expect, test } from 'vitest';
import { chaseTurn, headingOf } from '../view/chase.ts';
import { wholePatterns } from '../view/room.ts';

const TURN = 2 * Math.PI;
/** A trunk turned about the vertical (yaw), then about its own lateral axis (pitch). */
function trunk(yaw: number, pitch: number) {
    const [cy, sy, cp, sp] = [Math.cos(yaw / 2), Math.sin(yaw / 2), Math.cos(pitch / 2), Math.sin(pitch / 2)];
    return { pos: [0, 0, 0.2], quat: [cy * cp, -sy * sp, cy * sp, sy * cp] } as const;
}

test('the heading is the yaw, whatever the lean; a robot on its face or back has none', () => {
    for (const yaw of [-3, -1, 0, 0.5, 2]) {
        for (const pitch of [-0.6, 0, 0.6]) expect(headingOf(trunk(yaw, pitch))).toBeCloseTo(yaw, 9);
        for (const pitch of [-Math.PI / 2, Math.PI / 2]) expect(headingOf(trunk(yaw, pitch))).toBeNull();
    }
});

test('from everywhere the camera comes behind within a metre, the short way round, and rests where the robot does', () => {
    for (let start = -3; start <= 3; start += 0.5) {
        for (const heading of [-3, 0, 1.5]) {
            let [camera, turned] = [start, 0];
            for (let i = 0; i < 100; i++) {
                const by = chaseTurn(camera, heading, 0.01);
                [camera, turned] = [camera + by, turned + Math.abs(by)];
            }
            expect(Math.cos(camera - heading - Math.PI)).toBeGreaterThan(0.999);
            expect(turned).toBeLessThanOrEqual(TURN / 2 + 1e-9);
            expect(chaseTurn(start, heading, 0)).toBeCloseTo(0, 12);
        }
    }
});

test('the floor is never farther from the robot than half a pattern, and moves by whole ones', () => {
    for (let way = -40; way < 40; way += 0.37) {
        expect(Math.abs(wholePatterns(way) - way)).toBeLessThanOrEqual(0.1 + 1e-9);
        expect(Math.abs(Math.round(wholePatterns(way) / 0.2) * 0.2 - wholePatterns(way))).toBeLessThan(1e-9);
    }
});
