// SPDX-License-Identifier: MIT
// The states of a connection as a table. Pure: connection.ts acts and reports the events.
//
//   closed --connect--> opening --opened--> asking --known--> ready
//     ^                  |  ^                 | \                |
//     |               failed |retry       silent  foreign      lost
//     |                  v   |                v    v             v
//     +----stop------- waiting <---lost--- silent  foreign     waiting --gave-up--> closed
//
// silent and foreign are asked again periodically, and become what they answer. Each open state --named-other--> other-board, which ends
// with stop or lost.

export type ConnectionState =
    | 'closed' // nothing is open
    | 'opening' // the port is being opened
    | 'asking' // open; `@ver` was sent
    | 'ready' // a firmware with our protocol answers
    | 'silent' // open, but nothing we know answers; a terminal still works
    | 'foreign' // open, and a firmware with another protocol answers
    | 'other-board' // open, but a boot loader has named a board that is not ours; it is asked nothing
    | 'waiting'; // the port was lost; retried with growing pauses

export type ConnectionEvent =
    | 'connect'
    | 'opened'
    | 'open-failed'
    | 'known'
    | 'unknown'
    | 'named-other'
    | 'no-answer'
    | 'ask-again'
    | 'lost'
    | 'retry'
    | 'gave-up'
    | 'stop';

const table: Record<ConnectionState, Partial<Record<ConnectionEvent, ConnectionState>>> = {
    closed: { connect: 'opening' },
    opening: { opened: 'asking', 'open-failed': 'waiting', 'gave-up': 'closed', stop: 'closed' },
    asking: { known: 'ready', unknown: 'foreign', 'named-other': 'other-board', 'no-answer': 'silent', lost: 'waiting', stop: 'closed' },
    ready: { lost: 'waiting', 'ask-again': 'asking', 'named-other': 'other-board', stop: 'closed' },
    silent: { known: 'ready', unknown: 'foreign', 'no-answer': 'silent', 'named-other': 'other-board', lost: 'waiting', stop: 'closed' },
    foreign: { known: 'ready', unknown: 'foreign', 'no-answer': 'silent', 'named-other': 'other-board', lost: 'waiting', stop: 'closed' },
    'other-board': { lost: 'waiting', stop: 'closed' },
    waiting: { retry: 'opening', 'gave-up': 'closed', stop: 'closed' },
};

/** The next state; null: the event has no meaning in this state. */
export function nextState(state: ConnectionState, event: ConnectionEvent): ConnectionState | null {
    return table[state][event] ?? null;
}
