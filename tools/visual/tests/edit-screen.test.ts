// SPDX-License-Identifier: MIT
// Edit's screen beside the page's own questions, in simulated time, against the real firmware. A question puts the screen away; a person
// who looks at it sees what was typed all the same.
import { expect, test } from 'vitest';
import { askList, askWhere, play } from '../robot/protocol.ts';
import { connectedEdit } from './connected.ts';
import { randomNumbers } from './robot-bench.ts';

const SEED = 20261122;
const SIZE = { rows: 35, columns: 80 };
const keys = (text: string): Uint8Array => new TextEncoder().encode(text);

test('a line typed beside questions is done and shown, wherever among its keys they fall', async () => {
    const random = randomNumbers(SEED);
    const { bench, connection, text, forget } = await connectedEdit(SEED);
    connection.look(SIZE);
    await bench.run(1500);
    for (const number of ['0100', '0101', '0102']) {
        forget();
        const line = `page ${Number(number)}\r`;
        const asksAt = Math.floor(random() * (line.length + 1)); // behind the Enter, too: there it was lost
        for (const [i, key] of [...line, ''].entries()) {
            if (i === asksAt || i === line.length) void askList(connection.requests);
            if (key) await connection.type(keys(key));
            await bench.run(Math.floor(random() * 40));
        }
        for (let ms = 0; !text().includes(`PageNumber:${number}`) && ms < 3000; ms += 50) await bench.run(50);
        expect(text(), `seed ${SEED}, page ${number}, a question before key ${asksAt}`).toContain(`PageNumber:${number}`);
    }
});

test('whoever comes to the terminal sees the screen, and questions in a row do not draw it again and again', async () => {
    const { bench, connection, sent, text, forget } = await connectedEdit(SEED + 1);
    for (let i = 0; i < 3; i++) await bench.until(askWhere(connection.requests));
    await bench.run(2000);
    expect(sent.every(one => one.startsWith('@'))).toBe(true); // nobody looks
    forget();
    connection.look(SIZE);
    await bench.run(1500);
    expect(text()).toContain('PageNumber:');
    sent.length = 0;
    for (let i = 0; i < 5; i++) await bench.until(askWhere(connection.requests));
    await bench.run(5000);
    expect(sent).toEqual([...Array<string>(5).fill('@where\r'), '\x1b[35;80R']);
    sent.length = 0;
    connection.look(null);
    await bench.until(askWhere(connection.requests));
    await bench.run(2000);
    expect(sent).toEqual(['@where\r']);
});

test('a half-typed line is let alone; another size of the terminal is told once', async () => {
    const { bench, connection, sent, text, forget } = await connectedEdit(SEED + 2);
    connection.look(SIZE);
    await bench.run(1500);
    sent.length = 0;
    await connection.type(keys('page 10'));
    connection.look({ rows: 28, columns: 80 });
    await bench.run(3000);
    expect(sent).toEqual(['page 10']);
    forget();
    await connection.type(keys('0\r'));
    await bench.run(3000);
    expect(sent).toEqual(['page 10', '0\r', '\x1b[28;80R']);
    expect(text()).toContain('PageNumber:0100');
    expect(text()).toContain('\x1b[28;1H'); // its command row is the last one
});

test('while the robot moves Edit draws nothing: the screen comes when it stands', async () => {
    const { bench, connection, text, forget } = await connectedEdit(SEED + 3);
    await bench.until(play(connection.requests, 2)); // a bow
    forget();
    connection.look(SIZE);
    await bench.run(2000);
    expect(text()).not.toContain('PageNumber:');
    for (let ms = 0; !text().includes('PageNumber:') && ms < 15_000; ms += 50) await bench.run(50);
    expect(text()).toContain('PageNumber:');
});
