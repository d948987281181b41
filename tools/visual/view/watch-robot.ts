// SPDX-License-Identifier: MIT
// The last state that the robot in use has reported. What the robot before has reported is not true of the next one.

import type { RobotState } from '../robot/robot-state.ts';
import type { Session } from './session/session.ts';

/** take: receives each state; null: nothing is known of the robot in use any more. The returned function ends it. */
export function watchRobot(session: Pick<Session, 'state' | 'onFrame'>, take: (robot: RobotState | null) => void): () => void {
    let { source: before } = session.state.get();
    const unwatch = session.state.watch(({ source, connection }) => {
        if (source !== before || (source !== 'simulated' && connection === 'closed')) take(null);
        before = source;
    });
    const unlisten = session.onFrame(take);
    return () => {
        unwatch();
        unlisten();
    };
}
