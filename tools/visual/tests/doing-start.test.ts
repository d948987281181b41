// SPDX-License-Identifier: MIT
// The status bar for a simulated robot that starts, has no power, or does not start.
import { expect, test, vi } from 'vitest';
import { Status } from '../app/status.ts';
import type { SessionState } from '../view/session/session.ts';
import { Store } from '../view/store.ts';
import { doingText } from '../view/texts/robot.ts';

const START = {
    source: 'simulated',
    connection: 'asking',
    isPowered: true,
    isLate: false,
    stopped: null,
    version: null,
    shownPage: null,
    pages: [],
} as unknown as SessionState;

test.each(['closed', 'opening', 'asking', 'silent', 'waiting'] as const)(
    '%s: the robot in the page starts, and nothing is wrong',
    connection => {
        expect(doingText({ ...START, connection }, null)).toBe('The robot is starting …');
    },
);

test('without power it is off, whatever it said last', () => {
    expect(doingText({ ...START, connection: 'ready', isPowered: false }, null)).toBe(
        'The robot is switched off. Switch it on under "Robot".',
    );
});

test('one that never answers, and yours: what to do', () => {
    const late = doingText({ ...START, connection: 'silent', isLate: true }, null);
    expect(late).toMatch(/type GO there; otherwise restart it under "Robot"/);
    expect(late).not.toMatch(/flash|port/); // not for the robot in the page
    expect(doingText({ ...START, connection: 'silent', source: 'yours' }, null)).toMatch(/Switch the robot on/);
});

test('a slow computer is no silent robot: it is late by its own time alone', () => {
    vi.useFakeTimers();
    const state = new Store<SessionState>({ ...START, connection: 'silent' });
    const status = new Status({
        state,
        connection: () => {
            throw new Error('nothing is asked');
        },
        isWriting: () => false,
    });
    status.tell();
    vi.advanceTimersByTime(100_000); // the computer is busy, and the robot has had less than a second
    for (const ticks of [0, 64, 128]) status.reach(ticks);
    expect(state.get().doing.text).toBe('The robot is starting …');
    status.reach(128 * 11);
    expect(state.get().doing.text).toMatch(/does not answer/);
    status.reach(1); // a new robot
    expect(state.get().doing.text).toBe('The robot is starting …');
    status.reach(128 * 11);
    state.set({ connection: 'ready', where: null });
    status.reach(128 * 11 + 1);
    expect(state.get()).toMatchObject({ isLate: false, doing: { text: 'Ready.' } });
    vi.useRealTimers();
});
