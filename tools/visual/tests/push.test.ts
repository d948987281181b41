// SPDX-License-Identifier: MIT
// A forward push follows the robot's heading. Who cannot push is told so, and not that the robot was pushed.
import { expect, test, vi } from 'vitest';
import { pushRobot } from '../view/push.ts';
import type { RobotState } from '../robot/robot-state.ts';
import type { Hand, Session, SessionState } from '../view/session/session.ts';

function pushed(yaw: number, direction: 1 | -1): Promise<readonly number[]> {
    const trunk = { pos: [1, 2, 0.2], quat: [Math.cos(yaw / 2), 0, 0, Math.sin(yaw / 2)] };
    let target: readonly number[] = [];
    const session = {
        body: { links: [] },
        state: { get: () => ({ source: 'simulated', physics: 'on' }) },
        onFrame(listener: (state: RobotState) => void) {
            queueMicrotask(() => listener({ trunk } as unknown as RobotState));
            return () => undefined;
        },
        sim: { pull: (hand: Hand) => (target = hand.target) },
    };
    pushRobot(session as unknown as Session, direction);
    return new Promise(resolve => setTimeout(() => resolve(target)));
}

test.each([
    [0, 1, [1.2, 2]],
    [0, -1, [0.8, 2]],
    [Math.PI / 2, 1, [1, 2.2]],
    [Math.PI, -1, [1.2, 2]],
] as const)('turned by %f, direction %i', async (yaw, direction, [x, y]) => {
    const [atX, atY] = await pushed(yaw, direction);
    expect(atX).toBeCloseTo(x, 9);
    expect(atY).toBeCloseTo(y, 9);
});

/** What pushRobot() answers, and what is said. */
function tried(state: Partial<SessionState>): readonly [boolean, string | undefined] {
    const say = vi.fn<Session['say']>();
    const session = { body: { links: [] }, state: { get: () => state }, say, onFrame: () => () => undefined };
    return [pushRobot(session as unknown as Session, 1), say.mock.calls[0]?.[0]?.text];
}

test('without physics nothing is pushed, and that is the last word; a real robot is never pushed', () => {
    expect(tried({ source: 'simulated', physics: 'on' })).toEqual([true, undefined]);
    expect(tried({ source: 'simulated', physics: 'off' })).toEqual([false, expect.stringMatching(/^Physics could not be loaded/)]);
    expect(tried({ source: 'yours', physics: 'on' })).toEqual([false, undefined]);
});
