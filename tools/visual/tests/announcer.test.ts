// SPDX-License-Identifier: MIT
// What a screen reader announces while a robot walks for 12 seconds, falls and refuses a request.
import { expect, test, vi } from 'vitest';
import { Announcer } from '../view/announcer.ts';
import type { SessionState } from '../view/session/session.ts';
import { GetUp } from '../view/get-up.ts';

const START = {
    source: 'simulated',
    connection: 'ready',
    isPowered: true,
    isLate: false,
    stopped: null,
    shownPage: null,
    message: null,
    version: { image: 'play' },
    doing: { text: 'x', tone: 'calm' },
    where: null,
    pages: [
        { page: 20, name: 'walk' },
        { page: 21, name: 'walk_r' },
        { page: 22, name: 'walk_l' },
    ],
} as unknown as SessionState;
const at = (state: string, page: number, step: number): SessionState => ({ ...START, where: { state, page, step } }) as SessionState;

function heard() {
    vi.useFakeTimers();
    const message: (readonly [number, string])[] = [];
    const began = Date.now();
    const announcer = new Announcer({
        say: text => message.push([Date.now() - began, text]),
        after: (ms, call) => void setTimeout(call, ms),
    });
    return { announcer, message };
}

test('12 s of walking are two sentences: that it begins, and that it ends', async () => {
    const { announcer, message } = heard();
    announcer.look(at('idle', 0, 0), '');
    for (let i = 0; i < 40; i++) {
        announcer.look(at(i === 0 ? 'approach' : 'playing', i < 3 ? 20 : 21 + (i % 2), 1 + (i % 4)), '');
        await vi.advanceTimersByTimeAsync(300);
    }
    announcer.look(at('idle', 0, 0), '');
    expect(message.map(([, text]) => text)).toEqual(['Plays motion 20 (walk).', 'The robot stands and waits.']);
});

test('a fall and what went wrong are said, at most one sentence a second, the newest two', async () => {
    const { announcer, message } = heard();
    announcer.look(at('playing', 20, 1), '');
    announcer.look(at('playing', 20, 1), 'The robot lies on the floor.');
    announcer.look(at('idle', 0, 0), 'The robot lies on the floor.');
    announcer.look({ ...at('idle', 0, 0), message: { text: 'The robot refused.', tone: 'bad' } }, 'The robot lies on the floor.');
    await vi.advanceTimersByTimeAsync(5000);
    expect(message.map(([, text]) => text)).toEqual(['Plays motion 20 (walk).', 'The robot stands and waits.', 'The robot refused.']);
    const times = message.map(([ms]) => ms);
    for (const [i, ms] of times.slice(1).entries()) expect(ms - (times[i] ?? 0)).toBeGreaterThanOrEqual(1000);
});

const LIES = {
    face: { pos: [0, 0, 0.05], quat: [Math.SQRT1_2, 0, Math.SQRT1_2, 0] },
    back: { pos: [0, 0, 0.05], quat: [Math.SQRT1_2, 0, -Math.SQRT1_2, 0] },
} as const;

test('get up: one that has rolled over gets up from there, and gives up behind three tries; Stop ends it', async () => {
    const played: string[] = [];
    const getUp = new GetUp(motion => Promise.resolve(played.push(motion) > 0));
    const ends = async (lies: keyof typeof LIES, hasFallen = true): Promise<void> => {
        await Promise.resolve(); // it has begun
        getUp.look(true, LIES[lies], true);
        getUp.look(false, LIES[lies], hasFallen);
    };
    getUp.start(LIES.face);
    await ends('back');
    await ends('back', false); // it stands
    await ends('face'); // a later fall that nobody asked for
    expect(played).toEqual(['face', 'back']);
    played.length = 0;
    getUp.start(LIES.back);
    for (let i = 0; i < 5; i++) await ends('face');
    expect(played).toEqual(['back', 'face', 'face']);
    played.length = 0;
    getUp.start(LIES.back);
    getUp.stop();
    await ends('face');
    expect(played).toEqual(['back']);
});

test('a swing by code is announced, and again when a play over it has ended; then that it ends', async () => {
    const { announcer, message } = heard();
    const swings = (state: string, page: number): SessionState => {
        const { where } = at(state, page, 1);
        return { ...START, where: { ...where, aimed: 1 << 2 } } as SessionState;
    };
    for (const state of [
        at('idle', 0, 0),
        swings('idle', 0),
        swings('idle', 0),
        swings('playing', 20),
        swings('idle', 0),
        at('idle', 0, 0),
    ]) {
        announcer.look(state, '');
        await vi.advanceTimersByTimeAsync(5000);
    }
    const [moved, waits] = ['Moved by code: joint 2.', 'The robot stands and waits.'];
    expect(message.map(([, text]) => text)).toEqual([moved, 'Plays motion 20 (walk).', moved, waits]);
});

test('one that is switched off is told at once, and nothing of what it did', async () => {
    const { announcer, message } = heard();
    announcer.look(at('idle', 0, 0), '');
    await vi.advanceTimersByTimeAsync(5000);
    announcer.look({ ...START, isPowered: false }, '');
    await vi.advanceTimersByTimeAsync(5000);
    expect(message.at(-1)?.[1]).toMatch(/^The robot is switched off\./);
});

test('one that is asked again, or whose cable is out: what it did before is not said once more', async () => {
    const { announcer, message } = heard();
    const playing = { ...at('playing', 20, 2), doing: { text: 'Playing motion 20 (walk), step 2.', tone: 'calm' } } as SessionState;
    announcer.look(playing, '');
    await vi.advanceTimersByTimeAsync(5000);
    for (const connection of ['asking', 'waiting'] as const) {
        announcer.look({ ...playing, source: 'yours', connection, where: null }, ''); // what it does is told next
        await vi.advanceTimersByTimeAsync(5000);
    }
    expect(message.map(([, text]) => text)).toEqual([
        'Plays motion 20 (walk).',
        'Asking the robot who it is …',
        'The cable is unplugged. Plug it in again; the page reconnects by itself.',
    ]);
});

test('one that was told to be starting, or without a cable, is told when it answers', async () => {
    const { announcer, message } = heard();
    const starts: SessionState = { ...START, connection: 'asking' };
    announcer.look(starts, '');
    announcer.look({ ...starts, connection: 'ready' }, ''); // its state is asked next
    await vi.advanceTimersByTimeAsync(5000);
    announcer.look(at('idle', 0, 0), '');
    expect(message.map(([, text]) => text)).toEqual(['The robot is starting …', 'Ready.']);
    announcer.look({ ...starts, isPowered: false }, '');
    await vi.advanceTimersByTimeAsync(5000);
    announcer.look({ ...at('idle', 0, 0), version: { image: 'edit' } } as SessionState, '');
    await vi.advanceTimersByTimeAsync(5000);
    expect(message.map(([, text]) => text).slice(2)).toEqual([
        expect.stringMatching(/^The robot is switched off\./),
        'Edit runs: its screen is in the terminal.',
    ]);
});
