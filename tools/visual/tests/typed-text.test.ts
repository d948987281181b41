// SPDX-License-Identifier: MIT
// Text that is pasted into the terminal arrives whole at the real firmware, and nothing that stops the robot waits behind it.
import { expect, test } from 'vitest';
import type { Connection } from '../robot/connection.ts';
import { connected } from './connected.ts';
import { RobotBench } from './robot-bench.ts';

const PROMPT = '\r\n] ';
const bytesOf = (text: string): Uint8Array => new TextEncoder().encode(text);

async function ready(seed: number) {
    const bench = await RobotBench.make('play', seed);
    const robot = connected(bench);
    for (let ms = 0; robot.connection.state !== 'ready' && ms < 5000; ms += 50) await bench.run(50);
    expect(robot.connection.state).toBe('ready');
    await bench.run(500);
    robot.forget();
    const count = (words: string): number => robot.text().split(words).length - 1;
    return { bench, ...robot, count };
}

test.each([
    ['stop', 200, 'Nothing is playing'],
    ['settings centre 1', 60, ' OK\r'],
    ['help', 60, 'this list'], // the board says XOFF for longer than it may hold a request back
])('pasted: %s, %i times; each is executed', async (line, times, answer) => {
    const { bench, connection, count } = await ready(1);
    await bench.until(connection.write(bytesOf(`${line}\r`.repeat(times))), 60_000);
    for (let ms = 0; count(PROMPT) < times && ms < 30_000; ms += 100) await bench.run(100);
    expect(count(answer)).toBe(times);
    expect(count(PROMPT)).toBe(times);
});

/** The paste has begun and takes seconds. Its end is an error, which the page says. */
async function pasting(line: string, ms: number) {
    const robot = await ready(2);
    const dropped = expect(robot.connection.write(bytesOf(`${line}\r`.repeat(1000)))).rejects.toMatchObject({ code: 'text-dropped' });
    await robot.bench.run(ms);
    return { ...robot, dropped };
}

test('a request during a paste is answered within its time, and the paste goes on', async () => {
    const { bench, connection, count } = await ready(3);
    const pasted = connection.write(bytesOf('stop\r'.repeat(200)));
    await bench.run(300);
    expect(await bench.until(connection.requests.ask('@where'), 1000)).toContain('state=idle');
    await bench.until(pasted, 10_000);
    await bench.run(1000);
    expect(count('Nothing is playing')).toBe(200);
});

test.each(['stop\r', 'Break\r', 'x\b\rstop\r'])('%j typed during a paste does not wait behind it; the rest is dropped', async typed => {
    const { bench, connection, count, forget, dropped } = await pasting('settings centre 1', 1000);
    for (const key of typed) await connection.write(bytesOf(key));
    await dropped;
    forget();
    await bench.run(1000);
    expect(count('Nothing is playing')).toBe(1);
    expect(count('not known')).toBe(0);
    const before = count(' OK');
    await bench.run(2000);
    expect(count(' OK')).toBe(before);
});

test('keys typed during a paste come behind it', async () => {
    const { bench, connection, count, text } = await ready(4);
    const pasted = connection.write(bytesOf('settings centre 1\r'.repeat(10)));
    await bench.run(30);
    for (const key of 'help play\r') await connection.write(bytesOf(key));
    await bench.until(pasted);
    await bench.run(500);
    expect(count('settings centre 1')).toBe(10);
    expect(text()).toMatch(/centre 1\r\n OK\r\n\] help play\r\n.*\r\n\] $/s);
});

test('Ctrl-C drops the rest of a paste, and so does whoever stops the robot', async () => {
    for (const stop of [(robot: Connection) => robot.write(Uint8Array.of(3)), (robot: Connection) => robot.dropText()]) {
        const { bench, connection, count, dropped } = await pasting('stop', 300);
        await stop(connection);
        await dropped;
        await bench.run(1000);
        const done = count('Nothing is playing');
        await bench.run(1000);
        expect(count('Nothing is playing')).toBe(done);
    }
});

test('a line that is lost during a paste ends it', async () => {
    const { bench, connection } = await ready(5);
    const pasted = expect(connection.write(bytesOf('stop\r'.repeat(200)))).rejects.toMatchObject({ code: 'not-connected' });
    await bench.run(100);
    await connection.close();
    await bench.run(100);
    await pasted;
});
