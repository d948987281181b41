// SPDX-License-Identifier: MIT
// What the page says of the robot in use. That Edit runs must stay while it is true, because a person who starts it looks for its screen.
import { expect, test } from 'vitest';
import type { PlayState, Where } from '../robot/protocol.ts';
import type { SessionState } from '../view/session/session.ts';
import { doingText, postureText, shapeText, startText } from '../view/texts/robot.ts';

const state = (image: string, board = 'cm5'): SessionState =>
    ({
        source: 'simulated',
        connection: 'ready',
        isPowered: true,
        shownPage: null,
        stopped: null,
        pages: [{ page: 2, name: 'bow', steps: 3, fault: '' }],
        version: { image, board },
    }) as unknown as SessionState;
const where = (now: PlayState): Where => ({ state: now, page: 2, step: 1 }) as Where;

test('Edit says where its screen is, before its first answer and after it, until something plays', () => {
    const said = [null, where('idle'), where('ready')].map(now => doingText(state('edit'), now));
    expect(said).toEqual(Array(3).fill('Edit runs: its screen is in the terminal.'));
    expect(doingText(state('edit'), where('playing'))).toBe('Playing motion 2 (bow), step 1.');
    expect(doingText(state('play'), where('idle'))).toBe('The robot stands and waits.');
});

test('a motion in the picture has the name of the document, not that of the robot, even if it has none', () => {
    const shown = (shownName: string): string => doingText({ ...state('play'), shownPage: 2, shownName }, where('idle'));
    expect(shown('hello')).toBe('In the picture only: motion 2 (hello). The robot stands and waits.');
    expect(shown('')).toBe('In the picture only: motion 2. The robot stands and waits.');
    expect(doingText({ ...state('play'), shownPage: 2, shownName: 'hello' }, where('playing'))).toContain('Playing motion 2 (bow)');
});

test('speed and size that are not as stored are said while something plays', () => {
    const said = (rate: number, amplitude: number, now: PlayState = 'playing'): string =>
        doingText(state('play'), { ...where(now), shape: { rate, amplitude, blend: 30 } });
    expect(said(100, 100)).toBe('Playing motion 2 (bow), step 1.');
    expect(said(400, 0)).toBe('Playing motion 2 (bow), step 1. Speed: 400 %. Size: 0 %.');
    expect(said(100, 50)).toBe('Playing motion 2 (bow), step 1. Size: 50 %.');
    expect(said(400, 0, 'idle')).not.toMatch(/%/);
});

test('a robot that goes to a pose, as in live follow, plays no motion: not even motion 0, which is the trim', () => {
    const now = { state: 'approach', page: 0, step: 0 } as Where;
    expect(doingText(state('play'), now)).toBe('Going slowly to a pose.');
    expect(startText({ ...state('play'), where: now })).toBe('Going slowly to a pose.');
    expect(startText({ ...state('play'), where: where('approach') })).toBe('Plays motion 2 (bow).');
});

test('a joint that is moved by code moves the robot: it does not stand and wait', () => {
    const now = { ...where('idle'), page: 0, step: 0, aimed: 1 << 2 };
    expect(doingText(state('play'), now)).toBe('Moved by code: joint 2.');
    expect(startText({ ...state('play'), where: now })).toBe('Moved by code: joint 2.');
    expect(doingText(state('play'), { ...now, aimed: 0 })).toBe('The robot stands and waits.');
    expect(doingText(state('play'), { ...now, state: 'playing', page: 2, step: 1 })).toBe('Playing motion 2 (bow), step 1.');
});

test('only the robot in the page lies or is held: another one that does not answer yet is not said to do so', () => {
    const [lies, held] = [
        { hasFallen: true, isHeld: false },
        { hasFallen: false, isHeld: true },
    ];
    const said = (source: SessionState['source']): string[] => [lies, held].map(posture => postureText({ source }, posture));
    expect(said('simulated')).toEqual(['The robot lies on the floor.', 'A hand holds the robot.']);
    expect([said('yours'), said('servos')].flat()).toEqual(['', '', '', '']);
    expect(postureText({ source: 'simulated' }, { hasFallen: false, isHeld: false })).toBe('');
});

test('with Edit nothing is shaped: a key of the remote brings Play back, but not to your robot, which is flashed', () => {
    const said = (source: SessionState['source'], image: string): string => shapeText({ ...state(image), source });
    for (const source of ['simulated', 'servos'] as const) expect(said(source, 'edit')).toMatch(/A key of the remote brings Play back\.$/);
    expect(said('yours', 'edit')).toMatch(/Flash Play: m512 flash play-cm5\.hex/);
    expect(shapeText({ ...state('edit', 'cm2'), source: 'yours' })).toMatch(/Flash Play: m512 flash play-cm2\.hex/);
    expect(said('yours', 'play')).toBe('Applies from the next step on.');
});
