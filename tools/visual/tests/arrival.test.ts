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
        state: new Store({ isPowered: true } as SessionState),
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
    const [fail, tell] = [vi.fn(), vi.fn()];
    const arrival = arrivalWith({
        messages: { fail, tell },
        sources: YOURS,
        transfer: {
            read: () => Promise.resolve({ isDone: true }),
            keep: () => Promise.reject(new RobotError('no-backup')),
        },
    });
    arrival.connectionChanged('ready');
    await vi.waitFor(() => expect(fail).toHaveBeenCalledTimes(1));
    await new Promise(resolve => setTimeout(resolve));
    expect(tell).not.toHaveBeenCalled();
});

test.each([
    ['1:512:0 2:512:0 3:512:0 5:512:0 ', /^4 servos answer\. Nothing moves before you say so\. No answer from 4: not plugged in/],
    ['23:512:0 ', /^One servo answers\. .* No answer from 1-22: not plugged in/],
    ['1:512:0 4:512:0 8:512:0 ', /No answer from 2, 3, 5-7: /],
    ['', /^No servo answers\. Is their power on\?/],
] as const)('My servos with the pose "%s": those that are missing are named', async (pose, text) => {
    const tell = vi.fn();
    const ask = (request: string) => Promise.resolve(request === '@pose' ? pose : '');
    const arrival = arrivalWith({
        state: new Store({ source: 'servos' } as SessionState),
        messages: { fail: vi.fn(), tell },
        sources: { ...YOURS, connection: { ...YOURS.connection, requests: { ask } } },
        transfer: { read: () => Promise.resolve({ isDone: true }), keep: () => Promise.resolve() },
    });
    arrival.connectionChanged('ready');
    await vi.waitFor(() => expect(tell).toHaveBeenCalledWith({ text: expect.stringMatching(text), tone: 'bad' }));
});

const WALKS = [{ page: 20, steps: 6, name: 'walk', fault: '' }];
const KNOWN = [new Uint8Array([1]), null, new Uint8Array([3])];

test('a digit of the list of motions that the line has damaged is not believed: Walk plays the page it is in', async () => {
    const state = new Store({ source: 'yours' } as SessionState);
    const damaged = ['22:7:"walk"'];
    const ask = (text: string) => Promise.resolve(text === '@list' ? (damaged.shift() ?? '20:7:"walk"') : '');
    const sources = { ...YOURS, connection: { ...YOURS.connection, requests: { ask } } };
    const transfer = { read: () => Promise.resolve({ isDone: false, error: new RobotError('cancelled') }) };
    arrivalWith({ state, messages: { fail: vi.fn() }, sources, transfer }).connectionChanged('ready');
    await vi.waitFor(() => expect(state.get().pages).toMatchObject([{ page: 20, name: 'walk' }]));
});

test.each([
    ['on a line', false, []],
    ['in the page', true, WALKS],
] as const)('a robot %s that answers again: what is known of its motions until its list has come', (_, isSimulated, pages) => {
    const state = new Store({ source: isSimulated ? 'simulated' : 'yours', isPowered: true, pages: WALKS } as unknown as SessionState);
    const never = (): Promise<never> => new Promise(nothing);
    const sources = { isSimulated, connection: { version: null, requests: { ask: never } }, simulated: { prepare: never } };
    const arrival = arrivalWith({ state, messages: { fail: nothing }, sources, transfer: { read: never } });
    for (const connection of ['waiting', 'opening', 'asking', 'ready'] as const) {
        arrival.connectionChanged(connection);
        expect(state.get().pages, connection).toEqual(pages);
    }
});

/** Your robot, whose pages are known, answers once more. crcs: of its pages. continues: a write that was cut off continues with those.
 *  damaged: its first answer, after the line. */
async function answersAgain(crcs: string, phase: string, continues: boolean, damaged = crcs) {
    const known = new Store({ robot: KNOWN as readonly (Uint8Array | null)[] });
    const read = vi.fn(() => Promise.resolve({ isDone: true }));
    const keep = vi.fn(() => Promise.resolve());
    const leave = vi.fn();
    const answers = [damaged];
    const ask = (text: string) => Promise.resolve(text.startsWith('@crcs') ? (answers.shift() ?? crcs) : '');
    const arrival = arrivalWith({
        messages: { fail: vi.fn(), tell: nothing },
        sources: { ...YOURS, connection: { ...YOURS.connection, requests: { ask } } },
        editor: { state: known, format: { crc: ([first = 0]: Uint8Array) => first }, setRobot: (robot: []) => known.set({ robot }) },
        transfer: {
            state: new Store({ phase }),
            read,
            keep,
            leave,
            continuesWith: ([first = 0]: readonly number[]) => continues && first === Number.parseInt(crcs.slice(0, 4), 16),
        },
    });
    arrival.connectionChanged('ready');
    await new Promise(resolve => setTimeout(resolve, 10));
    return { read, keep, leave, robot: known.get().robot };
}

const OTHER_PAGES = `0001${'0007'.repeat(127)}`;

test.each([
    ['another board is on the cable', OTHER_PAGES, 'idle', false, true],
    ['another board, after a write', OTHER_PAGES, 'written', false, true],
    ['the same pages', `000100070003${'0007'.repeat(125)}`, 'idle', false, false],
    ['a write was cut off, which Try again continues', OTHER_PAGES, 'stopped', true, false],
    ['a write was cut off, and another board is on the cable', OTHER_PAGES, 'stopped', false, true],
    ['the person has it read already', OTHER_PAGES, 'reading', false, false],
] as const)('a robot that answers again, %s: read and backed up, or not', async (_, crcs, phase, continues, isRead) => {
    const { read, keep, leave, robot } = await answersAgain(crcs, phase, continues);
    expect([read, keep, leave].map(one => one.mock.calls.length)).toEqual(isRead ? [1, 1, 1] : [0, 0, 0]);
    expect(robot).toEqual(isRead ? [] : KNOWN); // what is known of the board before is not shown as this one's
});

test('a write that was cut off is not thrown away because the line has damaged a digit of the answer', async () => {
    const { read, leave } = await answersAgain(OTHER_PAGES, 'stopped', true, `1${OTHER_PAGES.slice(1)}`);
    expect([read, leave].map(one => one.mock.calls.length)).toEqual([0, 0]);
});

test.each([
    ['foreign', 1], // a damaged answer
    ['cancelled', 0], // by the person, or another robot was chosen
    ['port-lost', 0], // the connection says it
    ['transfer-busy', 0], // the person is writing it
] as const)('your robot could not be read, %s: told %i times, because it has no backup', async (code, times) => {
    const [fail, tell, keep] = [vi.fn(), vi.fn(), vi.fn()];
    const arrival = arrivalWith({
        messages: { fail, tell },
        sources: YOURS,
        transfer: { read: () => Promise.resolve({ isDone: false, error: new RobotError(code) }), keep },
    });
    arrival.connectionChanged('ready');
    await new Promise(resolve => setTimeout(resolve, 10));
    expect(fail).toHaveBeenCalledTimes(times);
    expect([tell, keep].map(one => one.mock.calls)).toEqual([[], []]);
});
