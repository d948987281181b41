// SPDX-License-Identifier: MIT
// The pose of one robot is not shown as that of the next: until that has told its own, the picture has no robot, but the edited step.
import { expect, test } from 'vitest';
import { DocumentEditor } from '../app/editor.ts';
import type { RobotState } from '../robot/robot-state.ts';
import type { Session, SessionState } from '../view/session/session.ts';
import { EDITING_START } from '../view/editor/editing.ts';
import { PoseTool } from '../view/editor/pose-tool.ts';
import type { RobotScene } from '../view/robot-scene.ts';
import { Store } from '../view/store.ts';
import { watchRobot } from '../view/watch-robot.ts';
import { BODY, libraryDocument, makeFormat, makeMotion } from './motion-bench.ts';

const ROBOT = { trunk: { pos: [1, 2, 0.3], quat: [1, 0, 0, 0] }, servos: [], leds: 1 } as unknown as RobotState;
const nothing = (): void => undefined;

test.each([
    ['another robot is chosen', { source: 'yours' }, null],
    ['the robot in the page restarts', { connection: 'closed' }, ROBOT],
    ['yours is chosen again, on another cable', { source: 'yours', connection: 'closed' }, null],
    ['the cable of yours is pulled', { source: 'yours', connection: 'waiting' }, ROBOT],
] as const)('%s: the pose before is known or not', (_, change, known) => {
    const source = 'source' in change && 'connection' in change ? change.source : 'simulated';
    const state = new Store({ source, connection: 'ready' } as SessionState);
    let tell: (robot: RobotState) => void = nothing;
    let last: RobotState | null = null;
    const onFrame = (listener: typeof tell): (() => void) => {
        tell = listener;
        return nothing;
    };
    watchRobot({ state, onFrame }, robot => (last = robot));
    tell(ROBOT);
    state.set(change);
    expect(last).toBe(known);
});

test('of a robot that has told nothing yet no figure is shown, and no ghost; the edited step is', async () => {
    const parts = { format: (await makeFormat()).format, player: await makeMotion(), document: await libraryDocument() };
    const editor = new DocumentEditor(BODY, parts, { changed: nothing, refused: nothing, opened: nothing });
    editor.select({ page: 2 });
    const state = new Store({ tab: 'remote' } as SessionState);
    const preview = { pose: () => null, state: new Store({ figure: 'step' }) };
    const trials = { touching: () => Promise.resolve([]) };
    const session = { body: BODY, state, editor, preview, trials } as unknown as Session;
    const figure = { show: nothing, touch: nothing, light: nothing, choose: nothing };
    const tool = new PoseTool({ figure, add: nothing } as unknown as RobotScene, session, new Store(EDITING_START), nothing);
    tool.show(ROBOT, false);
    expect(tool.figureTrunk).toEqual(ROBOT.trunk);
    tool.show(null, false);
    expect(tool.figureTrunk).toBeNull();
    state.set({ tab: 'steps' });
    tool.show(null, false);
    expect(tool.figureTrunk).not.toBeNull();
    expect(tool.layer.hasGhost).toBe(false);
    tool.show(ROBOT, false);
    expect(tool.layer.hasGhost).toBe(true);
});
