// SPDX-License-Identifier: MIT
// Pushes the simulated robot at the chest, by key or button: the same as a drag with the mouse.

import { headingOf } from './chase.ts';
import type { Session } from './session/session.ts';
import { TEXTS } from './texts/texts.ts';

const PUSH_TICKS = 38; // 0.3 s
const REACH_M = 0.2;
const CHEST_M = 0.03; // above the origin of the trunk

/** direction: 1 forwards, -1 backwards. false: a real robot is not pushed, nor one without physics, where a message says why. */
export function pushRobot(session: Session, direction: 1 | -1): boolean {
    const { source, physics } = session.state.get();
    if (source !== 'simulated') return false;
    if (physics === 'off') {
        session.say({ text: TEXTS.robot.noPush, tone: 'bad' });
        return false;
    }
    const trunk = session.body.links[0]?.name ?? 'trunk';
    const stop = session.onFrame(state => {
        stop();
        const [x, y, z] = state.trunk.pos;
        const heading = headingOf(state.trunk) ?? 0;
        const reach = direction * REACH_M;
        const target = [x + reach * Math.cos(heading), y + reach * Math.sin(heading), z + CHEST_M] as const;
        session.sim.pull({ link: trunk, point: [0, 0, CHEST_M], target }, PUSH_TICKS);
    });
    return true;
}
