// SPDX-License-Identifier: MIT
// A line that somebody types, and the page's questions, which wait for its end.
import { expect, test } from 'vitest';
import type { Clock } from '../robot/clock.ts';
import { Connection } from '../robot/connection.ts';
import { askWhere, command } from '../robot/protocol.ts';
import { Requests } from '../robot/requests.ts';
import { typedLine } from '../robot/typed-line.ts';
import { RobotBench } from './robot-bench.ts';

test.each([
    ['', 'pla', 'pla'],
    ['pla', 'y 3', 'play 3'],
    ['play 3', '\r', ''],
    ['pl', '\x03', ''],
    ['pl', '\x15', ''],
    ['pl', '\x7f', 'p'],
    ['p', '\x7f\x7f', ''],
    ['', '\x1b[A', ''],
    ['', '\x1b[12;40R', ''],
    ['a', '\rb', 'b'],
    ['', '\t', ''],
])('%j and the keys %j: %j', (before, keys, after) => {
    expect(typedLine(before, keys)).toBe(after);
});

/** A line that keeps what is sent, and a clock that a test moves. */
function bench() {
    const sent: string[] = [];
    const timers = new Map<number, { at: number; call: () => void }>();
    let now = 0;
    let count = 0;
    const clock: Clock = {
        now: () => now,
        after: (delayMs, call) => {
            const key = count++;
            timers.set(key, { at: now + delayMs, call });
            return () => timers.delete(key);
        },
    };
    const pass = (ms: number): void => {
        now += ms;
        for (const [key, { at, call }] of [...timers]) if (at <= now && timers.delete(key)) call();
    };
    const line = {
        write: async (bytes: Uint8Array) => void sent.push(new TextDecoder().decode(bytes)),
        expect: () => undefined,
        forget: () => undefined,
    };
    return { requests: new Requests(line, clock), sent, pass };
}

test('questions wait while somebody types, keep their order, and none is lost', async () => {
    const { requests, sent, pass } = bench();
    const first = requests.ask('@where');
    requests.typed('p'); // a key, while a question is under way
    const second = requests.ask('@page 1');
    const third = requests.ask('@pose');
    requests.take('@where state=idle OK');
    expect(await first).toBe('state=idle');
    expect(sent).toEqual(['@where\r']);
    pass(4000);
    requests.typed('l');
    pass(4000);
    expect(sent).toHaveLength(1);
    expect(requests.isHeldOff).toBe(true);
    requests.typed('\r');
    expect(requests.isHeldOff).toBe(false);
    expect(sent).toEqual(['@where\r', '@page 1\r']);
    requests.take('@page 1 00 OK');
    requests.take('@pose 1:512:0 OK');
    expect(await second).toBe('1 00');
    expect(await third).toBe('1:512:0');
});

test('a line that is left half typed keeps them back for five seconds and is emptied then; the time limit of a question counts from its sending', async () => {
    const { requests, sent, pass } = bench();
    requests.typed('pla');
    const asked = requests.ask('@where', { timeoutMs: 1000 });
    pass(4999);
    expect(sent).toEqual([]);
    expect(requests.isHeldOff).toBe(true);
    pass(1);
    expect(requests.isHeldOff).toBe(false);
    expect(sent).toEqual(['\x15\r@where\r']);
    requests.take('@where state=idle OK');
    expect(await asked).toBe('state=idle');
    void requests.ask('@pose');
    expect(sent.at(-1)).toBe('@pose\r'); // nothing is left to be emptied
});

test('stop waits for no half-typed line, and goes before what waits', async () => {
    const { requests, sent } = bench();
    requests.typed('pla');
    const waiting = requests.ask('@where');
    const stopped = command(requests, 'stop');
    expect(sent).toEqual(['\x15\r@stop\r']);
    requests.take('@stop OK');
    await stopped;
    expect(sent.at(-1)).toBe('@where\r');
    requests.take('@where state=idle OK');
    expect(await waiting).toBe('state=idle');
});

test('a line that is lost meanwhile ends them', async () => {
    const { requests, sent, pass } = bench();
    requests.typed('p');
    const asked = requests.ask('@where');
    requests.end('port-lost');
    await expect(asked).rejects.toMatchObject({ code: 'port-lost' });
    pass(6000);
    expect(sent).toEqual([]);
});

test.each([
    ['play', 81, 'help', /play/i],
    ['edit', 82, 'pairs', /1-2/],
] as const)('%s: a question neither lands in a line that is finished, nor in one that is left', async (image, seed, words, said) => {
    const robot = await RobotBench.make(image, seed);
    let heard = '';
    const connection = new Connection(robot.port, robot.clock, {
        state: () => undefined,
        text: bytes => (heard += String.fromCharCode(...bytes)),
    });
    connection.connect();
    for (let ms = 0; connection.state !== 'ready' && ms < 10_000; ms += 50) await robot.run(50);
    const type = (keys: string): Promise<void> => connection.type(new TextEncoder().encode(keys));
    await robot.until(type(words.slice(0, 3)));
    const waiting = askWhere(connection.requests);
    await robot.run(500);
    heard = '';
    void type(`${words.slice(3)}\r`);
    expect((await robot.until(waiting)).state).toBe('idle');
    await robot.run(500);
    expect(heard).toMatch(said);
    await robot.until(type('nonsen'));
    heard = '';
    expect((await robot.until(askWhere(connection.requests))).state).toBe('idle'); // five seconds later
    await robot.run(500);
    expect(heard).not.toMatch(/unknown|no command|bad/i);
    await connection.close();
});
