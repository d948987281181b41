// SPDX-License-Identifier: MIT
// A key pressed before the robot is ready is kept, is carried out later, and never moves a robot in the air.
import { expect, test, vi } from 'vitest';
import { Driving } from '../app/driving.ts';
import { StatusMessages } from '../app/status-messages.ts';
import type { Connection } from '../robot/connection.ts';
import { remotePacket } from '../robot/remote.ts';
import type { RemoteButton } from '../robot/remote.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { SessionState } from '../view/session/session.ts';
import { Store } from '../view/store.ts';
import { TEXTS } from '../view/texts/texts.ts';

const PLAYS = {
    source: 'simulated',
    isPowered: true,
    image: 'play',
    connection: 'ready',
    version: { image: 'play' },
    pages: [],
    message: null,
} as unknown as SessionState;

function driven(start: Partial<SessionState>, isHeld = false) {
    vi.useFakeTimers();
    const state = new Store<SessionState>({ ...PLAYS, ...start });
    const sent: Uint8Array[] = [];
    const written: Uint8Array[] = [];
    const asks: string[] = [];
    const simulated = { isHeld, post: (message: { kind: string; bytes?: Uint8Array }) => void (message.bytes && sent.push(message.bytes)) };
    let stand = (): void => undefined;
    let refuse = (_: Error): void => undefined;
    let asked = 0;
    const becomeDriven = (): Promise<void> => {
        asked++;
        return new Promise((resolve, reject) => {
            [stand, refuse] = [resolve, reject];
        });
    };
    const messages = new StatusMessages(state);
    const driving = new Driving({
        state,
        messages,
        simulated,
        connection: () => {
            if (state.get().connection !== 'ready') throw new RobotError('not-connected');
            return {
                requests: {
                    packet: async (packet: Uint8Array) => void written.push(packet),
                    ask: async (text: string) => void asks.push(text.split(' ', 1)[0] ?? ''),
                },
            } as unknown as Connection;
        },
        becomeDriven,
    });
    const press = (...buttons: RemoteButton[]): void => driving.remote(new Set(buttons));
    const becomes = async (change: Partial<SessionState> = {}): Promise<void> => {
        simulated.isHeld = false;
        state.set({ ...PLAYS, ...change });
        stand();
        await vi.advanceTimersByTimeAsync(0);
    };
    const forget = (): void => driving.forget();
    return {
        press,
        /** The page reads a gamepad at every picture. */
        push: async (pictures: number): Promise<void> => {
            for (let i = 0; i < pictures; i++) {
                driving.drive({ x: 0, y: 1 });
                await vi.advanceTimersByTimeAsync(16);
            }
        },
        becomes,
        forget,
        take: (): void => {
            simulated.isHeld = true;
        },
        leave: (change: Partial<SessionState>): void => {
            driving.leave();
            state.set(change);
        },
        sent,
        asks,
        written,
        refuse: (error: Error) => refuse(error),
        /** How the robot that is asked for now would refuse. */
        refusal: () => refuse,
        asked: () => asked,
        message: () => state.get().message,
    };
}

test('Stop, pressed while Edit starts, does not make the robot one that can be driven', () => {
    const { press, asked, sent } = driven({ image: 'edit', connection: 'asking', version: null });
    press('b6');
    press();
    expect([asked(), sent]).toEqual([0, []]);
});

test('a robot that stands hears a key at once', () => {
    const { press, sent } = driven({});
    press('up');
    expect(sent).toEqual([remotePacket([]), remotePacket(['up'])]);
});

test('My servos: a key pressed as soon as Play answers is heard, although every button counts as down then', async () => {
    const { press, becomes, written } = driven({ source: 'servos', connection: 'asking', version: null });
    await becomes({ source: 'servos' });
    press('up');
    expect(written).toEqual([remotePacket([]), remotePacket(['up'])]);
});

test.each([
    ['while a hand stands it up', {}, true],
    ['while it runs Edit', { image: 'edit', version: { image: 'edit' } }, false],
    ['while it starts', { connection: 'asking', version: null }, false],
] as const)('tapped %s: sent and let go when the robot can do it, not before', async (_, start, isHeld) => {
    const { press, becomes, sent, asked } = driven(start as unknown as Partial<SessionState>, isHeld);
    press('up');
    press();
    await vi.advanceTimersByTimeAsync(3000);
    expect(sent).not.toContainEqual(remotePacket(['up']));
    await becomes();
    await vi.advanceTimersByTimeAsync(500);
    expect(sent).toEqual([remotePacket([]), remotePacket(['up']), remotePacket([])]);
    expect(asked()).toBe(1);
});

test('a robot that a hand takes while it walks hears that the key is let go, and the stop key; no other', async () => {
    const { press, sent, take } = driven({});
    press('up');
    take();
    press();
    press('b6');
    press();
    press('left');
    await vi.advanceTimersByTimeAsync(200);
    const codes = sent.map(packet => packet.join()).filter((packet, i, all) => packet !== all[i - 1]);
    expect(codes).toEqual([[], ['up'], [], ['b6'], []].map(held => remotePacket(held as RemoteButton[]).join()));
});

test('My servos start anew: a key is kept without a word until the program runs, then sent', async () => {
    const { press, becomes, message, asked, written } = driven({ source: 'servos', connection: 'closed', version: null });
    press('up');
    press();
    await vi.advanceTimersByTimeAsync(500);
    expect([asked(), message(), written]).toEqual([1, null, []]);
    await becomes({ source: 'servos' });
    await vi.advanceTimersByTimeAsync(500);
    expect(written).toEqual([remotePacket([]), remotePacket(['up']), remotePacket([])]);
});

test('My servos, chosen while the robot in the page stands up: a key for them does not wait for that robot, which stands still now', async () => {
    const { press, leave, refusal, becomes, asked, message, sent, written } = driven({}, true);
    press('up');
    press();
    const refuseInPage = refusal();
    leave({ source: 'servos', connection: 'closed', version: null });
    press('left');
    press();
    expect(asked()).toBe(2);
    refuseInPage(new RobotError('no-answer')); // of no concern to them
    await vi.advanceTimersByTimeAsync(0);
    await becomes({ source: 'servos' });
    await vi.advanceTimersByTimeAsync(500);
    expect(written).toEqual([remotePacket([]), remotePacket(['left']), remotePacket([])]);
    expect([message(), sent]).toEqual([null, [remotePacket([])]]);
});

test('the last of several keys counts; one that is still held goes on by itself', async () => {
    const { press, becomes, sent } = driven({}, true);
    press('up');
    press();
    press('left');
    await becomes();
    await vi.advanceTimersByTimeAsync(250);
    expect(sent).toEqual([remotePacket([]), remotePacket(['left']), remotePacket(['left'])]);
});

test('what is stopped while the robot stands up is not sent', async () => {
    const { press, becomes, forget, sent } = driven({}, true);
    press('up');
    press();
    forget();
    await becomes();
    await vi.advanceTimersByTimeAsync(500);
    expect(sent).toEqual([remotePacket([])]);
});

test('when the robot refuses, the key is dropped with a word', async () => {
    const { press, refuse, sent, message } = driven({ image: 'edit' });
    press('up');
    press();
    refuse(new RobotError('page-unsaved'));
    await vi.advanceTimersByTimeAsync(1000);
    expect(sent).toEqual([]);
    expect(message()?.text).toMatch(/edits that are not saved/);
});

test.each([
    ['while a hand stands it up', {}, true],
    ['while it runs Edit', { image: 'edit', version: { image: 'edit' } }, false],
] as const)('a stick that is pushed %s drives when the robot can do it, not before', async (_, start, isHeld) => {
    const pages = [{ page: 20, steps: 4, name: 'walk', fault: '' }];
    const { push, becomes, asks, asked } = driven({ pages, ...start } as unknown as Partial<SessionState>, isHeld);
    await push(60);
    expect([asked(), asks]).toEqual([1, []]);
    await becomes({ pages });
    await push(60);
    expect(asks.slice(0, 2)).toEqual(['@play', '@drive']);
    expect(asked()).toBe(1);
});

test('a stick that is pushed at a robot without the page walk: it is said, once its pages are known', async () => {
    const pages = [{ page: 2, steps: 3, name: 'bow', fault: '' }];
    const { push, asks, message } = driven({ pages, where: { state: 'idle' } } as unknown as Partial<SessionState>);
    await push(60);
    expect([asks, message()?.text]).toEqual([[], TEXTS.robot.noWalk]);
    const unknown = driven({ where: null });
    await unknown.push(60);
    expect(unknown.message()).toBeNull();
});

test.each([
    ['a robot that is off', { isPowered: false }, 'off'],
    ['your robot with Edit', { source: 'yours', version: { image: 'edit', board: 'cm2' } }, 'm512 flash play-cm2.hex'],
] as const)('a stick that is pushed at %s is answered with a sentence', async (_, start, word) => {
    const { push, asks, asked, message } = driven(start as unknown as Partial<SessionState>);
    await push(60);
    expect([asked(), asks]).toEqual([0, []]);
    expect(message()?.text).toContain(word);
});
