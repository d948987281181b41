// SPDX-License-Identifier: MIT
// Requests that move the robot, when it is switched off or the line fails: a line that stalls keeps its bytes, so a play may still arrive
// when the page has given it up. The robot is then stopped before it can do much. So it is with a key of the remote. The line is a script.
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { Driving } from '../app/driving.ts';
import { StatusMessages } from '../app/status-messages.ts';
import { wallClock } from '../robot/clock.ts';
import { Connection } from '../robot/connection.ts';
import { askWhere } from '../robot/protocol.ts';
import { wordOf } from '../robot/remote.ts';
import type { RemoteButton } from '../robot/remote.ts';
import { Requests } from '../robot/requests.ts';
import { BytePort } from '../sim/byte-port.ts';
import type { SessionState } from '../view/session/session.ts';
import { Store } from '../view/store.ts';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

/** A line. received: the words of the requests that the robot got, in this order. */
function line() {
    const received: string[] = [];
    const stalled: string[] = [];
    const is = { stalled: false, cut: false };
    const arrive = (word: string): void => {
        received.push(word);
        setTimeout(() => requests.take(`${word} OK`), 5);
    };
    const write = async (bytes: Uint8Array): Promise<void> => {
        const word = /@\w+/.exec(String.fromCharCode(...bytes))?.[0] ?? '';
        if (is.cut) return; // its bytes are lost
        if (is.stalled) stalled.push(word);
        else arrive(word);
    };
    const requests: Requests = new Requests({ write }, wallClock);
    const goOn = (): void => {
        is.stalled = false;
        stalled.splice(0).forEach(arrive);
    };
    const ask = (text: string, moves = false) => requests.ask(text, { moves }).catch((error: Error) => error.message);
    return { requests, received, is, ask, goOn };
}

const pass = (ms: number) => vi.advanceTimersByTimeAsync(ms);

test('a play on a line that stalls: the robot is stopped right behind it, then whatever else is asked', async () => {
    const { received, is, ask, goOn } = line();
    is.stalled = true;
    const played = ask('@play 2', true);
    await pass(12_000);
    expect(await played).toMatch(/^no-answer/);
    void ask('@ver');
    goOn();
    await pass(2000);
    expect(received.slice(0, 2)).toEqual(['@play', '@stop']);
    expect(received).toContain('@ver');
});

test('a stall that is shorter than the first question behind it', async () => {
    const { received, is, ask, goOn } = line();
    is.stalled = true;
    void ask('@play 2', true);
    void ask('@where');
    await pass(1600);
    goOn();
    await pass(2000);
    expect(received).toEqual(['@play', '@stop', '@where']);
});

test('a line that was cut: Stop is the first thing after a question is answered again, once', async () => {
    const { received, is, ask } = line();
    is.cut = true;
    void ask('@play 2', true);
    await pass(5000);
    is.cut = false;
    void ask('@ver');
    void ask('@where');
    void ask('@list');
    await pass(3000);
    expect(received).toEqual(['@ver', '@stop', '@where', '@list']);
});

test('a play that is asked for when the line is well again is not stopped', async () => {
    const { received, is, ask } = line();
    is.cut = true;
    void ask('@play 2', true);
    await pass(3100); // Stop was not answered either
    is.cut = false;
    void ask('@play 3', true);
    void ask('@where');
    await pass(3000);
    expect(received).toEqual(['@play', '@where']);
});

test('a question that is not answered moves nothing, and an answered play needs no Stop', async () => {
    const { received, is, ask } = line();
    is.cut = true;
    void ask('@where');
    await pass(5000);
    is.cut = false;
    await Promise.all([ask('@play 2', true), ask('@where'), pass(3000)]);
    expect(received).toEqual(['@play', '@where']);
});

test('what waits is dropped: nothing of it is sent', async () => {
    const { requests, received, is, ask } = line();
    is.cut = true;
    const all = [ask('@where'), ask('@play 2', true), ask('@list')];
    requests.dropMoves();
    await pass(1400);
    is.cut = false;
    await pass(3000);
    expect(await Promise.all(all)).toEqual([expect.stringMatching(/^no-answer/), 'cancelled', '']);
    expect(received).toEqual(['@list']);
});

const XON = 0x11;
const XOFF = 0x13;
const UP = wordOf(['up']);
const RELEASE = 0;

/** Your robot with Play, which is asked where it is as the page does. received: the words of the packets and the `@stop` that it got, in
 *  this order, without repetitions. */
async function driven() {
    const received: (number | string)[] = [];
    const stalled: Uint8Array[] = [];
    const is = { stalled: false };
    const arrive = (bytes: Uint8Array): void => {
        const word = /@\w+/.exec(String.fromCharCode(...bytes))?.[0];
        const got = word ?? (bytes[2] ?? 0) + 256 * (bytes[4] ?? 0);
        if ((word === undefined || word === '@stop') && got !== received.at(-1)) received.push(got);
        if (word) setTimeout(() => port.push(new TextEncoder().encode(`\x1e${word} image=play protocol=1 state=idle OK\r\n`)), 5);
    };
    const port = new BytePort('robot', bytes => void (is.stalled ? stalled.push(bytes) : arrive(bytes)));
    const connection: Connection = new Connection(port, wallClock, { state: () => undefined, text: () => undefined });
    connection.connect();
    await pass(100);
    const where = async (): Promise<void> => {
        await askWhere(connection.requests, { timeoutMs: 3000 }).catch(() => connection.askAgain());
        setTimeout(() => void where(), 300);
    };
    void where();
    const state = new Store({
        source: 'yours',
        version: connection.version,
        connection: 'ready',
        message: null,
    } as unknown as SessionState);
    const driving = new Driving({
        state,
        messages: new StatusMessages(state),
        simulated: { post: () => undefined, isHeld: false },
        connection: () => connection,
        becomeDriven: async () => undefined,
    });
    const press = (...buttons: RemoteButton[]): void => driving.remote(new Set(buttons));
    const tap = async (button: RemoteButton): Promise<void> => {
        press(button);
        await pass(150);
        press();
    };
    const goOn = async (): Promise<void> => {
        is.stalled = false;
        stalled.splice(0).forEach(arrive);
        await pass(2000);
    };
    const flow = async (byte: number): Promise<void> => {
        port.push(Uint8Array.of(byte));
        await pass(1);
    };
    return { press, tap, goOn, flow, is, received, port, message: () => state.get().message?.text };
}

test('a key that is tapped, and one that is held: all of it arrives, and nothing is stopped', async () => {
    const { press, tap, received } = await driven();
    await tap('up');
    await pass(5000);
    press('left');
    await pass(5000);
    press();
    await pass(5000);
    expect(received).toEqual([UP, RELEASE, wordOf(['left']), RELEASE]);
});

test.each([2000, 10_000])('a key that is tapped when the line stalls, for %i ms: the robot is stopped right behind it', async stallMs => {
    const { tap, goOn, is, received } = await driven();
    is.stalled = true;
    await tap('up');
    await pass(stallMs);
    await goOn();
    expect(received.slice(0, 3)).toEqual([UP, RELEASE, '@stop']);
});

test('a key that is tapped while the robot does not answer is not sent at all, and that is said; its release is', async () => {
    const { tap, goOn, is, received, message } = await driven();
    is.stalled = true;
    await pass(2000);
    await tap('up');
    expect(message()).toMatch(/^The robot did not answer/);
    await goOn();
    expect(received).toEqual([RELEASE]);
    await tap('up');
    expect(received.slice(1)).toEqual([UP, RELEASE]);
});

test('a key that is held while the line stalls goes on when the line does, if the person still holds it', async () => {
    const { press, goOn, is, received } = await driven();
    is.stalled = true;
    await pass(2000);
    press('up');
    await pass(1500);
    await goOn();
    expect(received).toEqual([UP]);
    press();
    await pass(1000);
    expect(received).toEqual([UP, RELEASE]);
});

test('the robot holds the line: a key that has waited is not sent, its release is', async () => {
    const { tap, flow, received, message } = await driven();
    await pass(290); // no question is under way
    await flow(XOFF);
    await tap('up');
    await pass(700);
    await flow(XON);
    expect(received).toEqual([RELEASE]);
    expect(message()).toMatch(/^The robot did not answer/);
    await flow(XOFF);
    await tap('up');
    await flow(XON);
    await pass(3000);
    expect(received.slice(1)).toEqual([UP, RELEASE]);
});
