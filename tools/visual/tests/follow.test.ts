// SPDX-License-Identifier: MIT
// Live follow with the real Edit and Play: the robot ends in the last wanted pose and never exceeds the safe speed.
import { expect, test } from 'vitest';
import { FOLLOW_DEGREES_PER_SECOND, Follow } from '../app/follow.ts';
import { Connection } from '../robot/connection.ts';
import { askPose, setTorque } from '../robot/protocol.ts';
import { RobotBench } from './robot-bench.ts';

const UNITS_PER_DEGREE = 1024 / 300;

async function ready(seed: number, image: 'edit' | 'play' = 'edit', text: (bytes: Uint8Array) => void = () => undefined) {
    const bench = await RobotBench.make(image, seed);
    const connection = new Connection(bench.port, bench.clock, { state: () => undefined, text });
    connection.connect();
    for (let i = 0; i < 200 && connection.state !== 'ready'; i++) await bench.run(50);
    await bench.until(setTorque(connection.requests, true));
    return { bench, connection };
}

function poseWith(joints: Readonly<Record<number, number>>): (number | null)[] {
    return Array.from({ length: 31 }, (_, id) => joints[id] ?? null);
}

test('many poses in a hurry: the last one counts, slowly', async () => {
    const { bench, connection } = await ready(61);
    const failed: unknown[] = [];
    const follow = new Follow(
        () => connection,
        error => failed.push(error),
        bench.clock,
    );
    let before = 512;
    let fastest = 0;
    for (let i = 0; i < 60; i++) {
        if (i < 20) follow.set(poseWith({ 3: 512 + 10 * i, 5: 500 - 5 * i }));
        await bench.run(100);
        const { position } = (await bench.until(askPose(connection.requests))).find(({ id }) => id === 3) ?? {};
        fastest = Math.max(fastest, Math.abs((position ?? 0) - before) / 0.1);
        before = position ?? 0;
    }
    follow.set(null);
    expect(failed).toEqual([]);
    expect(Math.abs(before - 702)).toBeLessThan(5);
    expect(fastest).toBeGreaterThan(20); // units per second: it moved
    expect(fastest).toBeLessThan(FOLLOW_DEGREES_PER_SECOND * UNITS_PER_DEGREE * 1.5); // a request takes part of the time
    await connection.close();
});

test('a limp joint stays limp; a limp robot is left alone, it is said, and it follows no more', async () => {
    const { bench, connection } = await ready(62);
    const failed: unknown[] = [];
    const follow = new Follow(
        () => connection,
        error => failed.push(error),
        bench.clock,
    );
    await bench.until(setTorque(connection.requests, false, [3]));
    follow.set(poseWith({ 3: 600, 5: 600 }));
    await bench.run(3000);
    const pose = await bench.until(askPose(connection.requests));
    expect(pose.find(({ id }) => id === 3)).toMatchObject({ torque: false });
    expect(Math.abs((pose.find(({ id }) => id === 5)?.position ?? 0) - 600)).toBeLessThan(5);
    expect(failed).toEqual([]);
    await bench.until(setTorque(connection.requests, false));
    let ends = 0;
    follow.set(poseWith({ 5: 500 }), () => ends++);
    await bench.run(1500);
    expect(failed).toEqual([expect.objectContaining({ code: 'refused' })]);
    expect([ends, follow.isOn]).toEqual([1, false]); // the box is no longer ticked, so that the next edit moves nothing
    await connection.close();
});

test('stopped at its own panel: it stays where it is, also if another pose waits, and it follows no more', async () => {
    const { bench, connection } = await ready(63, 'play', bytes => follow.hear(bytes));
    const follow = new Follow(
        () => connection,
        error => expect(error).toBe('nothing'),
        bench.clock,
    );
    const at = async (): Promise<number> => (await bench.until(askPose(connection.requests))).find(({ id }) => id === 5)?.position ?? 0;
    for (const waits of [[], [poseWith({ 5: 300 })]]) {
        let ends = 0;
        const set = (pose: (number | null)[]): void => follow.set(pose, () => ends++);
        set(poseWith({ 5: 512 }));
        await bench.run(4000); // it follows: the end of a move alone ends nothing
        expect([Math.abs((await at()) - 512) < 5, follow.isOn]).toEqual([true, true]);
        set(poseWith({ 5: 800 }));
        await bench.run(600);
        for (const pose of waits) set(pose);
        bench.board.press('start', true);
        await bench.run(300);
        bench.board.press('start', false);
        const stopped = await at();
        await bench.run(3000);
        expect([ends, follow.isOn]).toEqual([1, false]);
        expect(stopped).toBeLessThan(700);
        expect(Math.abs((await at()) - stopped)).toBeLessThan(20); // it slows down
    }
    await connection.close();
});

test.each(['overload', 'silent'])(
    'Edit, a servo fails in a move (%s): no other pose is sent, which would switch it on again, and it is said',
    async fault => {
        const { bench, connection } = await ready(64);
        const failed: unknown[] = [];
        const follow = new Follow(
            () => connection,
            error => failed.push(error),
            bench.clock,
        );
        const elbow = async () => (await bench.until(askPose(connection.requests))).find(({ id }) => id === 5)?.position ?? 0;
        let ends = 0;
        const set = (pose: (number | null)[]): void => follow.set(pose, () => ends++);
        set(poseWith({ 3: 512, 5: 512 }));
        await bench.run(2000);
        set(poseWith({ 3: 800, 5: 800 }));
        await bench.run(500);
        bench.board.setFault(2, bench.board.faultNames().indexOf(fault), -1); // servo 3
        set(poseWith({ 3: 300, 5: 300 })); // a person drags on
        await bench.run(1500);
        expect([ends, follow.isOn]).toEqual([1, false]);
        expect(failed).toEqual([expect.objectContaining({ code: 'servo-failed', words: '3' })]);
        const stopped = await elbow();
        await bench.run(1000);
        expect(Math.abs((await elbow()) - stopped)).toBeLessThan(5);
        await connection.close();
    },
);
