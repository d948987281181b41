// SPDX-License-Identifier: MIT
// Requests that move the robot, when it is switched off or the line fails. The line is a script.
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { wallClock } from '../robot/clock.ts';
import { Requests } from '../robot/requests.ts';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

/** A line. received: the words of the requests that the robot got, in this order. */
function line() {
    const received: string[] = [];
    const is = { cut: false };
    const arrive = (word: string): void => {
        received.push(word);
        setTimeout(() => requests.take(`${word} OK`), 5);
    };
    const write = async (bytes: Uint8Array): Promise<void> => {
        const word = /@\w+/.exec(String.fromCharCode(...bytes))?.[0] ?? '';
        if (is.cut) return; // its bytes are lost
        arrive(word);
    };
    const requests: Requests = new Requests({ write }, wallClock);
    const ask = (text: string, moves = false) => requests.ask(text, { moves }).catch((error: Error) => error.message);
    return { requests, received, is, ask };
}

const pass = (ms: number) => vi.advanceTimersByTimeAsync(ms);

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
