// SPDX-License-Identifier: MIT
// Requests that move the robot, when it is switched off or the line fails: a line that stalls keeps its bytes, so a play may still arrive
// when the page has given it up. The robot is then stopped before it can do much. The line is a script.
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { wallClock } from '../robot/clock.ts';
import { Requests } from '../robot/requests.ts';

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
