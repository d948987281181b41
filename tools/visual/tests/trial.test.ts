// SPDX-License-Identifier: MIT
// Trials in physics. Expected values are plain mechanics and figures calculated by hand from the data of body and servos.
// tests/test_same_physics.py checks that falls and their times are those of the PC's physics.
import { expect, test } from 'vitest';
import { emptyDocument, imageOf, withChanges } from '../model/document.ts';
import type { MotionDocument } from '../model/document.ts';
import { AS_STORED, JOINTS, STANDING_PAGE } from '../model/motion.ts';
import type { Step } from '../model/page.ts';
import { deepestTouches, posesOf, verdictOf } from '../model/trial.ts';
import type { TrialRequest } from '../model/trial.ts';
import { libraryDocument, makeFormat, makeMotion, must } from './motion-bench.ts';
import { played, trialBench } from './trial-bench.ts';

const { body, stand, posed } = await trialBench();
const { format, edits } = await makeFormat();
const motion = await makeMotion();
const STANDING: Readonly<Record<number, number>> = Object.fromEntries(body.joints.map(({ servo, zero }) => [servo, Math.round(zero)]));
const servoOf = (name: string): number => body.joints.find(joint => joint.name === name)?.servo ?? 0;

/** Times in ticks of 1/128 s. */
function step(change: Readonly<Record<number, number>>, time = 100): Step {
    const positions: Record<number, number> = { ...STANDING, ...change };
    return { positions: Array.from({ length: JOINTS }, (_, id) => positions[id] ?? null), time, pause: 0 };
}

function pageOf(steps: readonly Step[], accelTime = 0): MotionDocument {
    const empty = emptyDocument(format, '');
    const filled = withChanges(empty, must(edits.insertSteps(empty, 5, 0, steps)).changes);
    return withChanges(filled, must(edits.setHeader(filled, 5, { accelTime })).changes);
}

function request(document: MotionDocument, change: Partial<TrialRequest> = {}): TrialRequest {
    const image = imageOf(document);
    for (const [page, bytes] of document.pages.entries()) motion.setPage(page, bytes);
    const pose = motion.firstPose(5, new Uint16Array(JOINTS).fill(512));
    return { image, page: 5, law: 'exact', shape: AS_STORED, pose, ticks: 600, toTheEnd: true, volts: 9.6, ...change };
}

test('who stands still stands; who leans far over the toes falls there, and stays on the floor', () => {
    const still = played(stand, request(pageOf([step({}), step({ [servoOf('right_elbow')]: 560 })])));
    expect(verdictOf(still)).toMatchObject({ kind: 'stands', at: null });
    expect(still.pages).toEqual([5]);
    expect(still.ended).toBe(true);
    // Both ankles by 46 degrees: the centre of mass at 0.2 m height moves 0.14 m ahead of soles that reach 0.05 m.
    const lean = { [servoOf('right_ankle_pitch')]: 512 + 160, [servoOf('left_ankle_pitch')]: 512 - 160 };
    const falling = pageOf([step({}), step({}), step(lean, 60), step(lean, 200)]);
    const { kind, at } = verdictOf(played(stand, request(falling)));
    expect(kind).toBe('falls');
    expect([2, 3]).toContain(at?.step);
    expect(at?.tick).toBeGreaterThan(200); // the first two steps take that long
    expect(at?.tick).toBeLessThan(360);
    // It is stopped at 150, and falls before it ends.
    expect(verdictOf(played(stand, request(falling, { ticks: 150 }))).at).toEqual(at);
});

test.each([
    ['the left ankle by 13 degrees', [[16, -45]]],
    [
        'both ankles by 10',
        [
            [15, 33],
            [16, -33],
        ],
    ],
] as const)('who tips slowly over the toes is upright for a second after the play, and falls all the same: %s', async (_, changes) => {
    const library = await libraryDocument();
    for (const [page, bytes] of library.pages.entries()) motion.setPage(page, bytes);
    const ready = motion.firstPose(STANDING_PAGE, new Uint16Array(JOINTS).fill(512));
    const lean = ready.slice();
    for (const [servo, units] of changes) lean[servo] = (ready[servo] ?? 0) + units;
    const copied = withChanges(library, must(edits.copyPage(library, STANDING_PAGE, 64)).changes);
    const longer = withChanges(copied, must(edits.duplicateSteps(copied, 64, [0])).changes);
    const posed = withChanges(longer, must(edits.setJoints(longer, 64, [1], new Map(changes.map(([id]) => [id, lean[id] ?? 0])))).changes);
    const document = withChanges(posed, must(edits.setTime(posed, 64, [1], 64)).changes);
    const ask = { image: imageOf(document), page: 64, pose: ready };
    expect(verdictOf(played(stand, request(document, ask)))).toMatchObject({ kind: 'falls', at: { page: 64, step: 1 } });
});

test('a servo lags behind a steady ramp by slope x speed / top speed (servo_motion.h), and more when it is shaped to go faster', () => {
    const elbow = servoOf('right_elbow');
    const ramp = pageOf([step({ [elbow]: 512 }), step({ [elbow]: 512 + 200 }, 100), step({ [elbow]: 512 + 200 }, 100)]);
    const lagAt = (change: Partial<TrialRequest>): number => {
        const asked = request(ramp, change);
        motion.setShape(asked.shape);
        motion.start(5, asked.pose);
        const curve = motion.curve(asked.ticks);
        motion.setShape(AS_STORED);
        const { positions } = played(stand, asked);
        const tick = Math.round(150 / (asked.shape.rate / 100)); // the middle of the ramp
        return Math.abs((curve.goals[tick * JOINTS + elbow] ?? 0) - (positions[tick * JOINTS + elbow] ?? 0));
    };
    // 32 (slope) x 2 / 7.5 units per tick (an AX-12 at 9.6 V) = 8.5, plus the effect of the forearm's weight and friction.
    const lag = lagAt({});
    expect(lag).toBeGreaterThan(6);
    expect(lag).toBeLessThan(14);
    expect(lagAt({ shape: { ...AS_STORED, rate: 200 } }) / lag).toBeGreaterThan(1.4);
    expect(lagAt({ volts: 12 })).toBeLessThan(lag);
});

test('a joint that the robot has not is no number; what cannot be played says so', () => {
    const { positions, ticks } = played(stand, request(pageOf([step({}), step({})])));
    expect(positions.length).toBe(ticks * JOINTS);
    expect(positions[30]).toBeNaN();
    expect(positions[1]).toBeCloseTo(512, -1);
    expect(() => played(stand, request(pageOf([step({})]), { page: 6 }))).toThrow(/page 6/);
    expect(() => played(stand, request(pageOf([step({})]), { shape: { ...AS_STORED, rate: 5 } }))).toThrow(RangeError);
    expect(() => played(stand, request(pageOf([step({})]), { image: new Uint8Array(3) }))).toThrow(RangeError);
});

test('feet meet when both legs swing inward by 6 degrees, not by 1: 17 mm between soles, 18 cm below the hips', () => {
    const inward = (degrees: number) =>
        posed.touchingIn(servo => {
            const joint = body.joints.find(one => one.servo === servo);
            return joint?.name.endsWith('hip_roll') ? (-degrees * Math.PI) / 180 : 0; // positive is outward (tools/body)
        });
    expect(inward(1)).toEqual([]);
    expect(inward(6).map(({ links }) => links)).toContainEqual(['left_foot', 'right_foot']);
    expect(inward(6).find(({ links }) => links[0] === 'left_foot')?.depthM).toBeGreaterThan(0.005);
});

test('of a curve the poses of its own page are looked at; of each step the deepest touch is told, and brushing is not', () => {
    const marks = Uint8Array.from([5, 1, 1, 5, 1, 1, 5, 1, 1, 5, 1, 1, 5, 2, 1, 5, 2, 1, 5, 2, 1, 5, 2, 1, 6, 1, 1]);
    const goals = new Uint16Array(9 * JOINTS);
    goals[4 * JOINTS + 3] = 700;
    const { poses, steps } = posesOf({ ticks: 9, goals, marks, ended: true }, 5);
    expect(steps).toEqual([0, 1]);
    expect(poses[JOINTS + 3]).toBe(700);
    const touch = (depthM: number) => ({ links: ['a', 'b'] as const, depthM });
    expect(deepestTouches([0, 0, 1], [[touch(0.004)], [touch(0.009), touch(0.005)], [touch(0.001)]])).toEqual([
        { ...touch(0.009), step: 0 },
    ]);
});

test('the verdict: what stood, fell, rose, ended low or could not begin', () => {
    const at = { tick: 180, page: 5, step: 2 };
    const record = { stood: true, ticks: 256, positions: new Float32Array(), pages: [5], fell: null, ended: true, onFeet: true };
    const kindOf = (change: Partial<typeof record> | { fell: typeof at }): string => verdictOf({ ...record, ...change }).kind;
    expect(kindOf({})).toBe('stands');
    expect(kindOf({ ended: false, onFeet: false })).toBe('stands'); // does not end and has not fallen
    expect(kindOf({ onFeet: false })).toBe('low');
    expect(kindOf({ fell: at })).toBe('rises');
    expect(verdictOf({ ...record, fell: at, onFeet: false })).toEqual({ kind: 'falls', at, seconds: 2, isWhole: true });
    expect(kindOf({ stood: false, onFeet: false })).toBe('no-start');
    expect([verdictOf({ ...record, ended: false }).isWhole, verdictOf(record, true).isWhole]).toEqual([false, false]);
});
