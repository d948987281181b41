// SPDX-License-Identifier: MIT
import { expect, test } from 'vitest';
import { nextState } from '../robot/connection-table.ts';
import type { ConnectionEvent, ConnectionState } from '../robot/connection-table.ts';

const STATES: ConnectionState[] = ['closed', 'opening', 'asking', 'ready', 'silent', 'foreign', 'other-board', 'waiting'];
const EVENTS: ConnectionEvent[] = [
    'connect',
    'opened',
    'open-failed',
    'known',
    'unknown',
    'named-other',
    'no-answer',
    'ask-again',
    'lost',
    'retry',
    'gave-up',
    'stop',
];

test('from every state but closed, stop ends it', () => {
    for (const state of STATES) expect(nextState(state, 'stop')).toBe(state === 'closed' ? null : 'closed');
});

test('every state with an open port hears that it is lost', () => {
    for (const state of ['asking', 'ready', 'silent', 'foreign', 'other-board'] as const) expect(nextState(state, 'lost')).toBe('waiting');
});

test('every state is reached, and ready only by an answer', () => {
    const reached = new Set<string>(['closed']);
    const ways: string[] = [];
    for (const state of STATES) {
        for (const event of EVENTS) {
            const next = nextState(state, event);
            if (next) reached.add(next);
            if (next === 'ready') ways.push(event);
        }
    }
    expect([...reached].sort()).toEqual([...STATES].sort());
    expect(new Set(ways)).toEqual(new Set(['known']));
});
