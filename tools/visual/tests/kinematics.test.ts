// SPDX-License-Identifier: MIT
// Hands, feet, mirror and balance. Reached poses are checked with placeLinks() (body.test.ts checks that against the drawings), the bent
// knee with the law of cosines, the centre of mass with MuJoCo, which reads the body file itself.
import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import { ORIGIN, centreOfMass, hull, lowerFoot, marginInside, supportPolygon, trunkOn } from '../model/balance.ts';
import { angleIn, jointAngle, jointPairs, nearestPosition, placeLinks } from '../model/body.ts';
import type { Angles, Body, Side } from '../model/body.ts';
import { footLimb, handLimb, reach } from '../model/ik.ts';
import { STILL, add, length, rotate, subtract } from '../model/space.ts';
import type { Vector } from '../model/space.ts';
import { OBJECT, makeMujoco } from '../sim/mujoco.ts';
import { makeFormat } from './motion-bench.ts';
import { present } from './present.ts';
import { randomNumbers } from './robot-bench.ts';

const BUILD = new URL('../../../build/wasm/', import.meta.url);
const body = JSON.parse(readFileSync(new URL('body.json', BUILD), 'utf8')) as Body;
const SEED = 16;
const STRAIGHT: Angles = new Map(body.joints.map(joint => [joint.servo, 0]));
const among = (random: () => number, share = 1): Angles =>
    new Map(body.joints.map(joint => [joint.servo, share * (joint.low + random() * (joint.high - joint.low))]));
const tipOf = (side: Side, angles: Angles): Vector => {
    const limb = handLimb(body, side);
    const place = present(placeLinks(body, ORIGIN, angleIn(angles)).get(`${side}_forearm`));
    return add(place.pos, rotate(place.quat, limb.point));
};
const staysWithin = (angles: Angles): boolean =>
    body.joints.every(joint => {
        const a = angles.get(joint.servo) ?? 0;
        return a >= joint.low - 1e-12 && a <= joint.high + 1e-12;
    });

test('a hand hangs 97 mm below its elbow (humanoid.xml), and reaches every place that it can reach, to 0.1 mm', () => {
    expect(tipOf('right', STRAIGHT)).toEqual([0, -0.076, -0.014 - 0.0675 - 0.097].map(v => expect.closeTo(v, 6)));
    const random = randomNumbers(SEED);
    const missed: number[] = [];
    for (let i = 0; i < 400; i++) {
        const side = i % 2 ? 'left' : 'right';
        const wanted = tipOf(side, among(random));
        const { angles, offM } = reach(among(random), handLimb(body, side), { pos: wanted });
        expect(staysWithin(angles)).toBe(true);
        expect(length(subtract(tipOf(side, angles), wanted))).toBeCloseTo(offM, 9);
        if (offM > 1e-4) missed.push(offM);
    }
    expect(missed.length, `seed ${SEED}: ${missed.join()}`).toBe(0);
});

test('a hand that is wanted too far away stretches towards it and says what is missing', () => {
    const from = tipOf('right', STRAIGHT);
    const { angles, offM } = reach(STRAIGHT, handLimb(body, 'right'), { pos: [0.5, from[1], 0] });
    expect(staysWithin(angles)).toBe(true);
    expect(offM).toBeGreaterThan(0.28); // the arm is 0.18 m long
    expect(offM).toBeLessThan(0.36);
    expect(tipOf('right', angles)[0]).toBeGreaterThan(0.14);
});

test('feet: from a standing pose to any place near by, the sole flat, to 0.1 mm and 0.1 degrees', () => {
    const random = randomNumbers(SEED + 1);
    const ready = new Map(STRAIGHT);
    for (const [servo, angle] of [
        [11, 0.4],
        [12, 0.4],
        [13, -0.8],
        [14, -0.8],
        [15, 0.4],
        [16, 0.4],
    ] as const)
        ready.set(servo, angle);
    const before = placeLinks(body, ORIGIN, angleIn(ready));
    for (let i = 0; i < 200; i++) {
        const side = i % 2 ? 'left' : 'right';
        const foot = present(before.get(`${side}_foot`));
        const way = (size: number): number => (random() - 0.5) * 2 * size;
        const target = { pos: add(foot.pos, [way(0.03), way(0.01), random() * 0.03]), quat: STILL };
        const found = reach(ready, footLimb(body, side), target);
        expect(staysWithin(found.angles)).toBe(true);
        expect(found.offM, `seed ${SEED + 1}, case ${i}`).toBeLessThan(1e-4);
        expect(found.offRad).toBeLessThan(0.002);
        const there = present(placeLinks(body, ORIGIN, angleIn(found.angles)).get(`${side}_foot`));
        expect(length(subtract(there.pos, target.pos))).toBeLessThan(1e-4);
        expect(rotate(there.quat, [0, 0, 1])[2]).toBeGreaterThan(0.999998);
    }
});

test('a straight leg that shall be 20 mm shorter bends its knee as the law of cosines says', () => {
    const foot = present(placeLinks(body, ORIGIN, angleIn(STRAIGHT)).get('left_foot'));
    const { angles } = reach(STRAIGHT, footLimb(body, 'left'), { pos: add(foot.pos, [0, 0, 0.02]), quat: STILL });
    const bone = Math.hypot(75, 14.5);
    const inner = (between: number): number => Math.acos((2 * bone * bone - between * between) / (2 * bone * bone));
    // At 0 the knee is behind the line from hip to ankle. Bending moves it through the line to the front.
    expect(-(angles.get(14) ?? 0)).toBeCloseTo(Math.PI - inner(150) + (Math.PI - inner(130)), 3);
});

test('the mirror of the edits is the mirror of this body: mirrored positions give mirrored places', async () => {
    const { format } = await makeFormat();
    const random = randomNumbers(SEED + 2);
    const positions = new Map(body.joints.map(one => [one.servo, 300 + Math.floor(random() * 420)]));
    const mirrored = new Map(
        jointPairs(body).flatMap(([right, left]) =>
            (
                [
                    [right, left],
                    [left, right],
                ] as const
            ).map(([to, from]) => [to, format.mirrored(present(positions.get(from)))] as const),
        ),
    );
    expect(mirrored.size).toBe(18);
    const places = (all: ReadonlyMap<number, number>) => placeLinks(body, ORIGIN, one => jointAngle(one, present(all.get(one.servo))));
    const [here, there] = [places(positions), places(mirrored)];
    for (const part of ['forearm', 'foot', 'shank']) {
        const right = present(here.get(`right_${part}`)).pos;
        expect(present(there.get(`left_${part}`)).pos).toEqual([right[0], -right[1], right[2]].map(v => expect.closeTo(v, 9)));
    }
});

test('the centre of mass is where MuJoCo sees it, in 20 poses', async () => {
    const wasm = readFileSync(new URL('../node_modules/@mujoco/mujoco/mujoco.wasm', import.meta.url));
    const mujoco = await makeMujoco(wasm.buffer.slice(wasm.byteOffset, wasm.byteOffset + wasm.byteLength));
    const model = mujoco.MjModel.from_xml_string(readFileSync(new URL('body.xml', BUILD), 'utf8'));
    const data = new mujoco.MjData(model) as InstanceType<typeof mujoco.MjData> & { readonly subtree_com: Float64Array };
    const random = randomNumbers(SEED + 3);
    for (let i = 0; i < 20; i++) {
        const angles = among(random);
        for (const joint of body.joints) {
            const index = mujoco.mj_name2id(model, OBJECT.joint, joint.name);
            data.qpos[present(model.jnt_qposadr[index])] = present(angles.get(joint.servo));
        }
        const trunk = { pos: [0.1, -0.2, 0.3] as const, quat: STILL };
        data.qpos.set([...trunk.pos, ...trunk.quat]);
        mujoco.mj_forward(model, data);
        const index = mujoco.mj_name2id(model, OBJECT.body, 'trunk');
        const theirs = [0, 1, 2].map(axis => present(data.subtree_com[3 * index + axis]));
        expect(centreOfMass(body, placeLinks(body, trunk, angleIn(angles)))).toEqual(theirs.map(v => expect.closeTo(v, 6)));
    }
    data.delete();
    model.delete();
});

test('straight on two feet: the soles cover 100 x 137 mm and the centre of mass is inside; on one foot it is not', () => {
    const trunk = trunkOn(body, 'right', STRAIGHT, ORIGIN);
    const places = placeLinks(body, trunk, angleIn(STRAIGHT));
    const polygon = supportPolygon(body, places);
    const wide = (axis: 0 | 1): number => Math.max(...polygon.map(p => p[axis])) - Math.min(...polygon.map(p => p[axis]));
    expect(wide(0)).toBeCloseTo(0.1, 6); // soles 100 x 60 mm, feet 77 mm apart: humanoid.xml
    expect(wide(1)).toBeCloseTo(0.077 + 0.06, 6);
    const [x, y] = centreOfMass(body, places);
    expect(marginInside(polygon, [x, y])).toBeGreaterThan(0.02);
    const lifted = reach(STRAIGHT, footLimb(body, 'left'), {
        pos: add(present(placeLinks(body, ORIGIN, angleIn(STRAIGHT)).get('left_foot')).pos, [0, 0, 0.03]),
        quat: STILL,
    }).angles;
    expect(lowerFoot(body, lifted)).toBe('right');
    const onOne = placeLinks(body, trunkOn(body, 'right', lifted, ORIGIN), angleIn(lifted));
    const [cx, cy] = centreOfMass(body, onOne);
    expect(supportPolygon(body, onOne)).toHaveLength(4);
    expect(marginInside(supportPolygon(body, onOne), [cx, cy])).toBeLessThan(0);
});

test('a hull leaves out what is inside; the nearest edge counts', () => {
    const square = hull([
        [0, 0],
        [2, 0],
        [2, 2],
        [0, 2],
        [1, 1],
        [1, 0],
    ]);
    expect(square).toEqual([
        [0, 0],
        [2, 0],
        [2, 2],
        [0, 2],
    ]);
    expect(marginInside(square, [0.5, 1])).toBeCloseTo(0.5, 12);
    expect(marginInside(square, [3, 1])).toBeCloseTo(-1, 12);
    expect(marginInside([], [0, 0])).toBe(-Infinity);
});

test('the kept foot stays where it is whatever the joints do', () => {
    const random = randomNumbers(SEED + 4);
    for (let i = 0; i < 20; i++) {
        const angles = among(random, 0.5);
        const at = { pos: [0.3, -0.1, 0] as const, quat: STILL };
        const foot = present(placeLinks(body, trunkOn(body, 'left', angles, at), angleIn(angles)).get('left_foot'));
        expect(foot.pos).toEqual([0.3, -0.1, 0.032].map(v => expect.closeTo(v, 9)));
        expect(rotate(foot.quat, [0, 0, 1])[2]).toBeCloseTo(1, 9);
    }
});

test('an angle becomes the nearest whole position, never one beyond a limit', () => {
    const knee = present(body.joints.find(joint => joint.name === 'right_knee'));
    expect(nearestPosition(knee, -0.5)).toBe(512 - Math.round((0.5 * 180) / Math.PI / (300 / 1024)));
    expect(nearestPosition(knee, 1)).toBe(512);
    expect(nearestPosition(knee, -9)).toBe(512 - Math.round(140 / (300 / 1024)));
});
