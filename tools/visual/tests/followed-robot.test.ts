// SPDX-License-Identifier: MIT
// A servo of your robot that does not answer for a moment, as a loose plug makes it. The middle is not its position.
import { expect, test, vi } from 'vitest';
import { FollowedRobot } from '../app/followed-robot.ts';
import type { RobotState } from '../robot/robot-state.ts';
import { BytePort } from '../sim/byte-port.ts';
import { robotPositions } from '../view/editor/editing.ts';
import { BODY } from './motion-bench.ts';

test('a servo that does not answer keeps its place in the picture, and is not taught', async () => {
    const nothing = (): void => undefined;
    let pose = '1:600:0 2:700:0';
    const port: BytePort = new BytePort('a robot', bytes => {
        const word = /@\w+/.exec(String.fromCharCode(...bytes))?.[0];
        const words = word === '@ver' ? 'image=edit version=1.0.0 board=cm5 protocol=1 can=page' : pose;
        setTimeout(() => port.push(new TextEncoder().encode(`\x1e${word} ${words} OK\r\n`)), 2);
    });
    let frame: RobotState | null = null;
    const events = { frame: (state: RobotState) => (frame = state), text: nothing, connection: nothing, change: nothing, motions: nothing };
    const robot = new FollowedRobot(BODY, events, () => robot.connection?.state === 'ready');
    robot.connect(port);
    const positions = (): (number | null)[] => (frame ? robotPositions(frame).slice(1, 3) : []);
    await vi.waitFor(() => expect(positions()).toEqual([600, 700]));
    pose = '1:610:0 2:?:0';
    await vi.waitFor(() => expect(positions()).toEqual([610, null]));
    expect((frame as RobotState | null)?.servos.map(({ position }) => position)).toEqual([610, 700]);
    await robot.close();
});
