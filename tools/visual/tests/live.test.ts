// SPDX-License-Identifier: MIT
// Delays that a person notices, in simulated time with the real firmware: how soon the robot moves after a key press, and how many poses
// per second the picture of your robot gets. The limits, 150 ms and 20, come from the issue.
import { expect, test } from 'vitest';
import { Connection } from '../robot/connection.ts';
import { askWhere, command, play } from '../robot/protocol.ts';
import { PoseFollower } from '../robot/pose-follower.ts';
import { remotePacket } from '../robot/remote.ts';
import type { RemoteButton } from '../robot/remote.ts';
import { RobotBench, randomNumbers, settle } from './robot-bench.ts';

const SEED = 20261122;
const STANDS = 1; // the standing pose

async function ready(image: 'play' | 'edit', seed: number): Promise<{ bench: RobotBench; connection: Connection }> {
    const bench = await RobotBench.make(image, seed);
    const connection = new Connection(bench.port, bench.clock, { state: () => undefined, text: () => undefined });
    connection.connect();
    for (let ms = 0; connection.state !== 'ready'; ms += 50) {
        if (ms > 5000) throw new Error('the robot never answered');
        await bench.run(50);
    }
    return { bench, connection };
}

test('from a key to the first goal that moves: less than 150 ms, for every key that starts a page', async () => {
    const random = randomNumbers(SEED);
    const { bench, connection } = await ready('play', 1);
    const goals = (): string =>
        bench.board
            .servos()
            .map(({ goalPos }) => goalPos)
            .join();
    const press = (...held: RemoteButton[]): void => bench.board.send('remote', remotePacket(held));
    const untilIdle = async (): Promise<void> => {
        for (let ms = 0; (await bench.until(askWhere(connection.requests))).state !== 'idle'; ms += 200) {
            if (ms > 30_000) throw new Error('it never stood still');
            await bench.run(200);
        }
    };
    const taken: string[] = [];
    for (const key of ['up', 'down', 'left', 'right'] as const) {
        await bench.until(play(connection.requests, STANDS));
        await untilIdle();
        await bench.run(Math.floor(random() * 50)); // anywhere within a tick
        const before = goals();
        press(key);
        let ms = 0;
        for (; goals() === before && ms < 1000; ms++) await bench.run(1);
        taken.push(`${key} ${ms}`);
        press();
        await bench.until(command(connection.requests, 'stop'));
        await untilIdle();
    }
    console.log(`key to the first goal that moves: ${taken.join(', ')} ms of the robot's time (seed ${SEED})`);
    expect(Math.max(...taken.map(one => Number(one.split(' ')[1])))).toBeLessThan(150);
});

test.each(['play', 'edit'] as const)('%s: 20 poses a second and more, while the page asks where it is as well', async image => {
    const { bench, connection } = await ready(image, SEED);
    let poses = 0;
    const follower = new PoseFollower(
        connection,
        bench.clock,
        () => true,
        () => poses++,
    );
    follower.start();
    const SECONDS = 5;
    for (let ms = 0; ms < SECONDS * 1000; ms += 300) {
        // every 300 ms, as WHERE_MS in app/status.ts
        void askWhere(connection.requests);
        await bench.run(300);
    }
    follower.stop();
    await settle();
    console.log(`${image}: ${(poses / SECONDS).toFixed(1)} poses a second`);
    expect(poses).toBeGreaterThan(20 * SECONDS);
});
