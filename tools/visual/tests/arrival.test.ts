// SPDX-License-Identifier: MIT
// When a robot answers, it is asked for its pages and stands up. A restart in between is no error.
import { expect, test, vi } from 'vitest';
import { Arrival } from '../app/arrival.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { SessionState } from '../view/session/session.ts';
import { Store } from '../view/store.ts';

const nothing = (): void => undefined;
/** Your robot, which answers. */
const YOURS = { isSimulated: false, connection: { version: { image: 'edit' }, requests: { ask: () => Promise.resolve('') } } };

function arrivalWith(parts: object): Arrival {
    return new Arrival({
        state: new Store({ source: 'yours' } as SessionState),
        status: { tell: nothing, look: nothing, ask: nothing },
        editor: { state: new Store({ robot: [] }) },
        ...parts,
    } as unknown as ConstructorParameters<typeof Arrival>[0]);
}

test.each([
    ['not-connected', 0],
    ['no-answer', 2],
] as const)('asked in vain, %s: told %i times', async (code, times) => {
    const fail = vi.fn();
    const inVain = () => Promise.reject(new RobotError(code));
    const arrival = arrivalWith({
        state: new Store({} as SessionState),
        messages: { fail },
        sources: {
            isSimulated: true,
            connection: { version: { image: 'play' }, requests: { ask: inVain } },
            simulated: { prepare: inVain },
        },
    });
    arrival.connectionChanged('ready');
    await vi.waitFor(() => expect(fail).toHaveBeenCalledTimes(times));
    await new Promise(resolve => setTimeout(resolve));
    expect(fail).toHaveBeenCalledTimes(times);
});

test('a robot whose backup could not be stored is not said to be backed up', async () => {
    const [fail, say] = [vi.fn(), vi.fn()];
    const arrival = arrivalWith({
        messages: { fail, say },
        sources: YOURS,
        transfer: {
            read: () => Promise.resolve({ isDone: true }),
            keep: () => Promise.reject(new RobotError('no-backup')),
        },
    });
    arrival.connectionChanged('ready');
    await vi.waitFor(() => expect(fail).toHaveBeenCalledTimes(1));
    await new Promise(resolve => setTimeout(resolve));
    expect(say).not.toHaveBeenCalled();
});

test.each([
    ['foreign', 1], // a damaged answer
    ['cancelled', 0], // by the person, or another robot was chosen
    ['port-lost', 0], // the connection says it
    ['transfer-busy', 0], // the person is writing it
] as const)('your robot could not be read, %s: told %i times, because it has no backup', async (code, times) => {
    const [fail, say, keep] = [vi.fn(), vi.fn(), vi.fn()];
    const arrival = arrivalWith({
        messages: { fail, say },
        sources: YOURS,
        transfer: { read: () => Promise.resolve({ isDone: false, error: new RobotError(code) }), keep },
    });
    arrival.connectionChanged('ready');
    await new Promise(resolve => setTimeout(resolve, 10));
    expect(fail).toHaveBeenCalledTimes(times);
    expect([say, keep].map(one => one.mock.calls)).toEqual([[], []]);
});
