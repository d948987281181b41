// SPDX-License-Identifier: MIT
// The page's body against tools/body/README.md and the public descriptions.
import { expect, test } from 'vitest';
import { jointAngle, placeLinks, servoPosition, soleCorners } from '../model/body.ts';
import { Standing } from '../sim/standing.ts';
import { STILL } from '../model/space.ts';
import type { Place } from '../model/space.ts';
import { present } from './present.ts';
import { BODY as body } from './motion-bench.ts';

const HERE: Place = { pos: [0, 0, 0], quat: STILL };
const joint = (servo: number) => present(body.joints.find(one => one.servo === servo));

test('18 joints, all links carried by one trunk, parents first', () => {
    expect(body.joints.map(one => one.servo).sort((a, b) => a - b)).toEqual(Array.from({ length: 18 }, (_, i) => i + 1));
    const seen = new Set<string | null>([null]);
    for (const link of body.links) {
        expect(seen.has(link.parent)).toBe(true);
        seen.add(link.name);
    }
    expect(soleCorners(body, 'left_sole')).toHaveLength(4);
});

test('angles: 300 degrees are 1024 positions, 512 is straight, and back again', () => {
    expect(jointAngle(joint(13), 512)).toBeCloseTo(0, 12);
    expect((jointAngle(joint(11), 778) * 180) / Math.PI).toBeCloseTo(78, 0); // a bow: 78 degrees in the hips (demo.d/edit.txt)
    expect((jointAngle(joint(1), 512 + 256) * 180) / Math.PI).toBeCloseTo(75, 9); // a quarter of 300 degrees (tools/body/README.md)
    for (const one of body.joints) expect(servoPosition(one, jointAngle(one, 300))).toBeCloseTo(300, 9);
});

test('straight legs: ankles 150 below the hips, and mirrored', () => {
    const places = placeLinks(body, HERE, () => 0);
    const at = (name: string) => present(places.get(name)).pos;
    expect(at('right_thigh')[2] - at('right_ankle')[2]).toBeCloseTo(0.15, 6);
    expect(at('right_thigh')[0] - at('right_shank')[0]).toBeCloseTo(0.0145, 6);
    for (const part of ['hand', 'foot', 'thigh', 'forearm']) {
        const [right, left] = [places.get(`right_${part}`), places.get(`left_${part}`)];
        if (right && left) expect([left.pos[0], -left.pos[1], left.pos[2]]).toEqual(right.pos.map(v => expect.closeTo(v, 9)));
    }
});

test('positive angles: arms and thighs to the front, as the body says', () => {
    const lifted = placeLinks(body, HERE, one => (one.servo === 1 || one.servo === 11 ? 0.5 : 0));
    expect(present(lifted.get('right_forearm')).pos[0]).toBeGreaterThan(0.02);
    expect(present(lifted.get('right_shank')).pos[0]).toBeGreaterThan(0.02);
});

test('standing: the soles are on the floor, whatever the knees do', () => {
    const standing = new Standing(body);
    for (let bend = 0; bend <= 60; bend += 5) {
        const angle = (bend * Math.PI) / 180;
        const angles: Record<number, number> = { 11: angle, 12: angle, 13: -2 * angle, 14: -2 * angle, 15: angle, 16: angle };
        const trunk = standing.move(one => angles[one.servo] ?? 0);
        const places = placeLinks(body, trunk, one => angles[one.servo] ?? 0);
        expect(present(places.get('right_foot')).pos[2]).toBeCloseTo(0.032, 4);
        expect(present(places.get('left_foot')).pos[2]).toBeCloseTo(0.032, 3);
    }
});
