// SPDX-License-Identifier: MIT
// Teaching by hand: which servos are being taught, also when some do not obey, when the hand holds the body, and when the robot's pose is
// known.
import { expect, test } from 'vitest';
import type { RobotState } from '../robot/robot-state.ts';
import { EDITING_START, isPoseKnown, stillTaught } from '../view/editor/editing.ts';
import { Teaching } from '../view/editor/teaching.ts';
import { Store } from '../view/store.ts';

const taught = new Set([1, 3, 5, 11]);

test('a servo that was limp and holds is taught no more; one that goes limp, or has not done it yet, is', () => {
    expect([...stillTaught(taught, [1, 3, 5], [])]).toEqual([11]);
    expect([...stillTaught(taught, [1, 3, 5], [3])]).toEqual([3, 11]);
    expect([...stillTaught(taught, [], [1, 3])]).toEqual([1, 3, 5, 11]);
});

test('servos that nobody teaches change nothing', () => {
    expect([...stillTaught(taught, [2, 4], [])]).toEqual([1, 3, 5, 11]);
});

test('a pose is added as a step only from a robot that answers; the one in the page has it always', () => {
    expect(isPoseKnown('simulated', 'asking')).toBe(true);
    expect(['ready', 'silent', 'waiting', 'closed'].map(state => isPoseKnown('yours', state as 'ready'))).toEqual([
        true,
        false,
        false,
        false,
    ]);
    expect(isPoseKnown('servos', 'closed')).toBe(false);
});

const LEG = { title: 'leg', isLeg: true, servos: [7, 9, 11] };
const ARM = { title: 'arm', isLeg: false, servos: [1, 3] };

/** The robot in the page. Servos in `deaf` obey nothing; a robot with one of them refuses, but the others obey. */
function taughtInPage() {
    const deaf = new Set<number>();
    const robot = { isPowered: true, isHeld: false, limp: new Set<number>() };
    const listeners = new Set<(state: RobotState) => void>();
    const said: string[] = [];
    const frame = (): void => {
        const ids = [...LEG.servos, ...ARM.servos];
        const servos = ids.map(id => ({ id, torque: robot.isPowered && !robot.limp.has(id) }));
        for (const listener of [...listeners]) listener({ servos, isPowered: robot.isPowered } as unknown as RobotState);
    };
    const editing = new Store(EDITING_START);
    const teaching = new Teaching(
        {
            onFrame: listener => {
                listeners.add(listener);
                return () => listeners.delete(listener);
            },
            setTorque: async (on, ids = []) => {
                if (robot.isPowered) for (const id of ids) if (!deaf.has(id)) robot.limp[on ? 'delete' : 'add'](id);
                setTimeout(frame);
                return robot.isPowered && !ids.some(id => deaf.has(id));
            },
            say: notice => void said.push(notice?.text ?? ''),
            sim: { hold: held => (robot.isHeld = held) },
        },
        editing,
    );
    listeners.add(state => teaching.take(state));
    return { teaching, robot, deaf, frame, said, taught: () => [...editing.get().taught] };
}

test('one servo of a leg does not obey: the others are limp, so the leg is taught, and the hand holds the body', async () => {
    const { teaching, robot, deaf, said, taught } = taughtInPage();
    deaf.add(9);
    await teaching.toggle(LEG);
    expect([taught(), robot.isHeld]).toEqual([LEG.servos, true]);
    await teaching.toggle(LEG); // holds it
    expect([taught(), [...robot.limp], robot.isHeld]).toEqual([[], [], true]);
    expect(said).toHaveLength(1); // that the hand stays, because the legs were limp
    await teaching.toggle(LEG);
    await teaching.holdAll();
    expect([taught(), said.length]).toEqual([[], 2]);
});

test('none obeys, or the robot is off: nothing is taught, and the hand lets go again', async () => {
    const { teaching, robot, deaf, frame, said, taught } = taughtInPage();
    for (const servo of LEG.servos) deaf.add(servo);
    await teaching.toggle(LEG);
    expect([taught(), robot.isHeld]).toEqual([[], false]);
    robot.isPowered = false;
    frame();
    await teaching.toggle(ARM);
    expect([taught(), robot.isHeld, said]).toEqual([[], false, []]);
});

test('a limb that cannot be held stays taught, and the hand stays', async () => {
    const { teaching, robot, deaf, taught } = taughtInPage();
    await teaching.toggle(ARM);
    deaf.add(3);
    await teaching.toggle(ARM);
    expect([taught(), robot.isHeld]).toEqual([ARM.servos, true]);
    await teaching.holdAll();
    expect([taught(), robot.isHeld]).toEqual([ARM.servos, true]);
    robot.isPowered = false;
    await teaching.toggle(ARM);
    expect([taught(), robot.isHeld]).toEqual([ARM.servos, true]);
    deaf.clear();
    robot.isPowered = true;
    await teaching.holdAll();
    expect([taught(), robot.isHeld]).toEqual([[], false]);
});
