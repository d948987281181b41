// SPDX-License-Identifier: MIT
// Shows a motion in the picture before a robot plays it, and switches the figure between step, motion and robot.
import { expect, test } from 'vitest';
import { DocumentEditor } from '../app/editor.ts';
import { MotionPreview } from '../app/preview.ts';
import { AS_STORED, JOINTS } from '../model/motion.ts';
import type { Where } from '../robot/protocol.ts';
import type { SessionState } from '../view/session/session.ts';
import { Store } from '../view/store.ts';
import { BODY as body, libraryDocument, makeFormat, makeMotion } from './motion-bench.ts';

const { format } = await makeFormat();
const WAVE = 3;
const WALK = 20;
const TRUNK = { pos: [2, 1, 0.3], quat: [Math.SQRT1_2, 0, 0, Math.SQRT1_2] } as const; // turned to the left

async function shown() {
    const events = { changed: () => undefined, refused: () => undefined, opened: () => undefined };
    const editor = new DocumentEditor(body, { format, player: await makeMotion(), document: await libraryDocument() }, events);
    const state = new Store<SessionState>({ where: null, shownPage: null, tab: 'steps' } as SessionState);
    const hand = { holds: false };
    const follow = { isOn: false };
    let frames: ((nowMs: number) => void)[] = [];
    let nowMs = 1000;
    const preview = new MotionPreview({
        body,
        editor,
        state,
        trunk: () => TRUNK,
        isFollowing: () => follow.isOn,
        isStoodUp: () => hand.holds,
        pageChanged: () => undefined,
        nextFrame: call => void frames.push(call),
    });
    const pass = (ms: number): void => {
        const due = frames;
        frames = [];
        nowMs += ms;
        for (const call of due) call(nowMs);
    };
    const where = (change: Partial<Where>): void => state.set({ where: { state: 'idle', page: 0, step: 0, ...change } as Where });
    return { editor, state, preview, pass, where, hand, follow };
}

test("the first pose is there at once, and 0.3 s later the motion is 0.3 s on: the curve of the firmware's own player", async () => {
    const { editor, preview, pass, state } = await shown();
    const curve = editor.curve(WAVE, { shape: AS_STORED });
    expect(preview.start(WAVE)).toBe(true);
    expect(state.get().shownPage).toBe(WAVE);
    expect(Array.from(preview.pose()?.positions ?? [])).toEqual(Array.from(curve?.goals.subarray(0, 31) ?? []));
    pass(0);
    pass(300);
    const tick = Math.floor(0.3 * 128);
    expect(preview.state.get().tick).toBe(tick);
    expect(Array.from(preview.pose()?.positions ?? [])).toEqual(Array.from(curve?.goals.subarray(31 * tick, 31 * (tick + 1)) ?? []));
});

test('it begins where the robot stands, as the robot is turned', async () => {
    const { preview } = await shown();
    preview.start(WAVE);
    const trunk = preview.pose()?.trunk;
    expect(trunk?.pos.slice(0, 2)).toEqual([2, 1]);
    expect(Math.atan2(trunk?.quat[3] ?? 0, trunk?.quat[0] ?? 0) * 2).toBeCloseTo(Math.PI / 2, 2);
});

test('at its end it stands still; looping, it goes on', async () => {
    const { preview, pass } = await shown();
    preview.start(WAVE);
    pass(0);
    pass(60_000);
    const { tick, ticks, isRunning } = preview.state.get();
    expect([tick, isRunning]).toEqual([ticks - 1, false]);
    preview.setLooping(true);
    preview.resume();
    expect(preview.state.get().tick).toBe(0);
    pass(0);
    pass(60_000);
    expect(preview.state.get().isRunning).toBe(true);
});

test('whoever leaves the steps after a motion was shown sees the robot; a motion that still runs is shown to its end', async () => {
    const { state, preview, pass } = await shown();
    preview.start(WAVE);
    pass(0);
    pass(60_000);
    state.set({ tab: 'curves' });
    expect(preview.state.get().figure).toBe('shown');
    state.set({ tab: 'robot' });
    expect(preview.pose()).toBe(null);
    expect(state.get().shownPage).toBe(null);

    preview.start(WAVE);
    pass(0);
    pass(300);
    state.set({ tab: 'remote' });
    expect(preview.pose()).not.toBe(null);
    pass(60_000);
    expect(preview.pose()).toBe(null);
});

test('a motion that is stopped where nothing is edited gives the picture back', async () => {
    const { state, preview, pass } = await shown();
    state.set({ tab: 'remote' });
    preview.start(WAVE);
    pass(0);
    pass(300);
    preview.pause();
    expect(preview.pose()).toBe(null);
});

test('from a step: its first tick; the scrubber stands still where it is put', async () => {
    const { preview } = await shown();
    preview.start(WAVE, 2);
    expect(preview.state.get().at).toEqual({ page: WAVE, step: 3 });
    expect(preview.sinceStep()).toBe(0);
    preview.seek(WAVE, 40);
    expect(preview.state.get()).toMatchObject({ tick: 40, isRunning: false, figure: 'shown' });
});

test('a motion that is long has its whole length and its last step; one that loops is cut at 32 s', async () => {
    const { editor, preview } = await shown();
    const { edits } = editor;
    const joints = (position: number) => Array.from({ length: JOINTS }, (_, id) => (id === 3 ? position : null));
    const steps = [400, 420, 440, 460, 480, 500, 520].map(position => ({ positions: joints(position), time: 255, pause: 255 }));
    const page = 100; // free in the library
    editor.dispatch(edits.insertSteps(editor.state.get().document, page, 0, steps));
    editor.dispatch(edits.setHeader(editor.state.get().document, page, { speed: 255 }));
    preview.start(page, 6);
    expect(preview.state.get().at).toEqual({ page, step: 7 });
    // 7 steps of 255 + 255 ticks at nominal speed 32
    expect(preview.state.get().ticks / ((7 * 510 * 255) / 32)).toBeCloseTo(1, 2);
    preview.start(WALK);
    expect(preview.state.get().ticks).toBe(32 * 128);
});

test('while a robot plays, and behind it, the figure is the robot, until somebody edits or chooses a step', async () => {
    const { editor, preview, where, state } = await shown();
    expect(preview.state.get().figure).toBe('step');
    where({});
    where({ state: 'playing', page: WAVE, step: 1 });
    expect(preview.state.get().figure).toBe('robot');
    where({});
    expect(preview.state.get().figure).toBe('robot');
    editor.select({ page: WAVE, step: 1 });
    expect(preview.state.get().figure).toBe('step');
    preview.start(WAVE);
    where({ state: 'approach', page: WAVE });
    expect(preview.state.get()).toMatchObject({ figure: 'robot', isRunning: false });
    expect([preview.pose(), state.get().shownPage]).toEqual([null, null]);
});

test('who opens another area when the robot has ended looks at the step', async () => {
    const { preview, where, state } = await shown();
    where({ state: 'playing', page: 20, step: 1 });
    state.set({ tab: 'curves' });
    expect(preview.state.get().figure).toBe('robot'); // it is still moving
    where({});
    state.set({ tab: 'steps' });
    expect(preview.state.get().figure).toBe('step');
});

test("a robot that begins to play does not take a step out of somebody's hand", async () => {
    const { editor, preview, where } = await shown();
    const gesture = editor.gesture('set-joints');
    where({ state: 'playing', page: 20, step: 1 });
    expect(preview.state.get().figure).toBe('step');
    gesture.cancel();
});

test('a robot that follows the edited step does not take it out of the picture', async () => {
    const { preview, where, follow } = await shown();
    follow.isOn = true;
    where({ state: 'approach' });
    expect(preview.state.get().figure).toBe('step');
});

test('a motion that is shown goes on while a hand stands the robot up, and gives way when the robot plays', async () => {
    const { preview, where, hand } = await shown();
    preview.start(WAVE);
    hand.holds = true;
    where({ state: 'playing', page: 1, step: 1 });
    where({});
    expect(preview.state.get()).toMatchObject({ figure: 'shown', isRunning: true });
    hand.holds = false;
    where({ state: 'playing', page: WAVE, step: 1 });
    expect(preview.state.get().figure).toBe('robot');
});

test('a play that is asked of a robot that moves does not take the robot out of the picture; one that is stood up is asked early', async () => {
    const { preview, where, hand } = await shown();
    where({ state: 'playing', page: 20, step: 1 });
    preview.playAsked(WAVE);
    expect(preview.state.get().figure).toBe('robot');
    hand.holds = true;
    preview.playAsked(WAVE);
    expect(preview.state.get().figure).toBe('shown');
});
