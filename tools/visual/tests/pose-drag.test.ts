// SPDX-License-Identifier: MIT
// Drags in the picture, checked by the resulting places of placeLinks().
import { expect, test } from 'vitest';
import { ORIGIN, trunkOn } from '../model/balance.ts';
import { angleIn, placeLinks } from '../model/body.ts';
import type { Angles } from '../model/body.ts';
import { dragged, flattened, grab, partOf } from '../model/pose-drag.ts';
import type { Grab } from '../model/pose-drag.ts';
import { add, length, rotate, scale, subtract, turn } from '../model/space.ts';
import type { Place, Vector } from '../model/space.ts';
import { present } from './present.ts';
import { randomNumbers } from './robot-bench.ts';
import { BODY as body } from './motion-bench.ts';

const READY: Angles = new Map(
    body.joints.map(joint => [joint.servo, { 11: 0.4, 12: 0.4, 13: -0.8, 14: -0.8, 15: 0.4, 16: 0.4 }[joint.servo] ?? 0]),
);
const AT: Place = { pos: [0.5, 0.2, 0], quat: turn([0, 0, 1], 0.7) };
const STANCE = { keep: 'right', at: AT } as const;
const placesOf = (angles: Angles, held: Grab) => placeLinks(body, trunkOn(body, held.stance.keep, angles, held.stance.at), angleIn(angles));
const pointOf = (angles: Angles, held: Grab): Vector => {
    const place = present(placesOf(angles, held).get(held.link));
    return add(place.pos, rotate(place.quat, held.point));
};
const changed = (angles: Angles): number[] =>
    [...angles].filter(([servo, angle]) => Math.abs(angle - (READY.get(servo) ?? 0)) > 1e-9).map(([servo]) => servo);

test('what one takes hold of', () => {
    expect(partOf(body, 'right_hand', 'right_forearm')).toEqual({ kind: 'hand', side: 'right' });
    expect(partOf(body, 'right_forearm', 'right_forearm')).toMatchObject({ kind: 'joint', joint: { servo: 5 } });
    expect(partOf(body, 'left_sole', 'left_foot')).toEqual({ kind: 'foot', side: 'left' });
    expect(partOf(body, null, 'left_thigh')).toMatchObject({ joint: { servo: 12 } });
    expect(partOf(body, 'chest', 'trunk')).toEqual({ kind: 'trunk' });
    expect(partOf(body, 'face', 'head')).toEqual({ kind: 'trunk' });
});

test('a hand follows the mouse; only its arm moves', () => {
    const random = randomNumbers(31);
    for (let i = 0; i < 30; i++) {
        const held = grab(body, 'left_hand', 'left_forearm', [0.01, 0, -0.09], READY, STANCE);
        const somewhere = new Map(READY).set(2, random()).set(4, random()).set(6, -random());
        const wanted = pointOf(somewhere, held);
        const angles = dragged(body, held, wanted, true);
        expect(length(subtract(pointOf(angles, held), wanted)), `case ${i}`).toBeLessThan(1e-4);
        for (const servo of changed(angles)) expect([2, 4, 6]).toContain(servo);
    }
});

test('one joint turns until the point lies in the direction of the mouse, and no farther than it can', () => {
    const held = grab(body, 'right_forearm', 'right_forearm', [0.019, 0, -0.02], READY, STANCE);
    const axis = rotate(present(held.places.get('right_forearm')).quat, [-1, 0, 0]);
    const elbow = present(held.places.get('right_forearm')).pos;
    for (const by of [0.3, -0.5, 0.8, -1.4]) {
        const wanted = add(elbow, rotate(turn(axis, by), subtract(held.world, elbow)));
        const angles = dragged(body, held, wanted, true);
        expect(changed(angles)).toEqual([5]);
        expect(length(subtract(pointOf(angles, held), wanted))).toBeLessThan(1e-9);
    }
    const beyond = dragged(body, held, add(elbow, rotate(turn(axis, 1.5), subtract(held.world, elbow))), true);
    expect(((beyond.get(5) ?? 0) * 180) / Math.PI).toBeCloseTo(50, 6); // the elbow's limit: humanoid.xml
});

test('a foot moves with its sole flat while the other one stays; the kept foot can be taken too', () => {
    for (const side of ['left', 'right'] as const) {
        const held = grab(body, `${side}_sole`, `${side}_foot`, [0.03, 0, -0.03], READY, STANCE);
        expect(held.stance.keep).toBe(side === 'left' ? 'right' : 'left');
        const before = placesOf(READY, held);
        const angles = dragged(body, held, add(held.world, [0.02, 0.01, 0.02]), true);
        const after = placesOf(angles, held);
        expect(subtract(present(after.get(`${side}_foot`)).pos, present(before.get(`${side}_foot`)).pos)).toEqual(
            [0.02, 0.01, 0.02].map(v => expect.closeTo(v, 4)),
        );
        expect(rotate(present(after.get(`${side}_foot`)).quat, [0, 0, 1])[2]).toBeCloseTo(1, 5);
        const stays = `${held.stance.keep}_foot`;
        expect(present(after.get(stays)).pos).toEqual(present(before.get(stays)).pos.map(v => expect.closeTo(v, 4)));
    }
});

test('the foot that the robot stands on, taken while the other one is in the air and tilted: it is dragged as the figure then stands', () => {
    const raised = new Map(READY).set(12, 0.8).set(14, -1.2).set(16, 0.1);
    const held = grab(body, 'right_sole', 'right_foot', [0.03, 0, -0.03], raised, STANCE);
    expect(held.world).toEqual(pointOf(raised, held));
    const angles = dragged(body, held, add(held.world, [0, 0, 0.02]), true);
    const after = placesOf(angles, held);
    expect(rotate(present(after.get('right_foot')).quat, [0, 0, 1])[2]).toBeCloseTo(1, 4);
});

test('the trunk moves over feet that stay, and stops where the legs end', () => {
    const held = grab(body, 'chest', 'trunk', [0.02, 0, 0], READY, STANCE);
    const before = placesOf(READY, held);
    for (const by of [
        [0, 0, -0.02],
        [0.01, 0.01, -0.01],
        [0, 0, 0.5],
    ] as const) {
        const after = placesOf(dragged(body, held, add(held.world, by), true), held);
        for (const foot of ['right_foot', 'left_foot']) {
            expect(present(after.get(foot)).pos).toEqual(present(before.get(foot)).pos.map(v => expect.closeTo(v, 3)));
            expect(rotate(present(after.get(foot)).quat, [0, 0, 1])[2]).toBeCloseTo(1, 4);
        }
        if (by[2] < 0.1)
            expect(subtract(present(after.get('trunk')).pos, present(before.get('trunk')).pos)).toEqual(by.map(v => expect.closeTo(v, 3)));
    }
});

test.each([
    ['down', [0, 0, -1]],
    ['up', [0, 0, 1]],
    ['ahead', [1, 0, 0]],
] as const)('the trunk dragged %s farther and farther: it never goes back', (_, way) => {
    const held = grab(body, 'chest', 'trunk', [0.02, 0, 0], READY, STANCE);
    const along = (m: number): number => {
        const after = placesOf(dragged(body, held, add(held.world, scale(way, m)), true), held);
        const moved = subtract(present(after.get('trunk')).pos, present(held.places.get('trunk')).pos);
        return moved[0] * way[0] + moved[1] * way[1] + moved[2] * way[2];
    };
    const moved = Array.from({ length: 25 }, (__, i) => along(0.02 * i));
    const most = Math.max(...moved);
    expect(most).toBeGreaterThan(0.003);
    for (const [i, m] of moved.entries()) if (i > 0) expect(m, `${20 * i} mm`).toBeGreaterThan((moved[i - 1] ?? 0) - 0.006);
    expect(moved.at(-1)).toBeGreaterThan(most - 0.006);
});

test('both feet flat: whatever the ankles did, the soles lie on the floor', () => {
    const twisted = new Map(READY).set(15, 0.2).set(16, 0.6).set(17, 0.1).set(18, -0.1);
    const angles = flattened(body, twisted, { keep: 'right', at: ORIGIN });
    const places = placeLinks(body, trunkOn(body, 'right', angles, ORIGIN), angleIn(angles));
    for (const foot of ['right_foot', 'left_foot']) {
        expect(rotate(present(places.get(foot)).quat, [0, 0, 1])[2]).toBeCloseTo(1, 4);
        expect(present(places.get(foot)).pos[2]).toBeCloseTo(0.032, 3);
    }
    expect(rotate(present(places.get('trunk')).quat, [0, 0, 1])[2]).toBeCloseTo(1, 4);
});
