// SPDX-License-Identifier: MIT
// What the status bar says of a robot in the page that starts, that has no power, and that does not start.
import { expect, test } from 'vitest';
import type { DeskState } from '../view/desk.ts';
import { doingText } from '../view/texts.ts';

const START = {
    source: 'simulated',
    connection: 'asking',
    isPowered: true,
    isLate: false,
    stopped: null,
    version: null,
    shownPage: null,
    pages: [],
} as unknown as DeskState;

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
    expect(doingText({ ...START, connection: 'silent', isLate: true }, null)).toMatch(/type GO in the terminal/);
    expect(doingText({ ...START, connection: 'silent', source: 'yours' }, null)).toMatch(/Switch the robot on/);
});
