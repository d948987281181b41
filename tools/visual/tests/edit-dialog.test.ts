// SPDX-License-Identifier: MIT
// What a line typed into Edit opens (a question, a name, a list, a play) is never answered by a question of the page: against the real
// firmware, in simulated time. The page asks as its desk does, whenever it may; somebody types and goes to another tab.
import { expect, test } from 'vitest';
import { askWhere, play } from '../robot/protocol.ts';
import { connectedEdit } from './connected.ts';
import { randomNumbers } from './robot-bench.ts';

const SEED = 20261123;
const LIMIT_MS = 300_000;
const keys = (text: string): Uint8Array => new TextEncoder().encode(text);

async function edit(seed: number) {
    const { bench, connection, sent, text, forget } = await connectedEdit(seed);
    const whatComes = async (ms: number): Promise<{ readonly sent: string; readonly text: string }> => {
        sent.length = 0;
        for (let at = 0; at < ms; at += 100) {
            if (at % 300 === 0 && !connection.isHeldOff) void askWhere(connection.requests).catch(() => undefined);
            await bench.run(100);
        }
        return { sent: sent.join(''), text: text() };
    };
    /** As a terminal sends it: an arrow is one piece. */
    const type = async (line: string, restMs = 10): Promise<void> => {
        forget();
        for (const [key] of line.matchAll(/\x1b\[A|[^]/g)) {
            await connection.type(keys(key));
            if (restMs > 0) await bench.run(restMs);
        }
    };
    return { bench, connection, whatComes, type };
}

test(
    'the page asks again when a line is done',
    async () => {
        const { whatComes, type } = await edit(SEED);
        await type('page 5\r');
        expect((await whatComes(3000)).sent).toMatch(/^(@where\r)+$/);
    },
    LIMIT_MS,
);

test.each([0, 10])(
    'NAME keeps waiting for the name that somebody wants (%i ms between two keys)',
    async restMs => {
        const { connection, whatComes, type } = await edit(SEED + 1);
        await type('page 100\r', restMs);
        await whatComes(2000);
        await type('name\r', restMs);
        expect((await whatComes(3000)).sent).toBe('');
        expect(connection.isInDialog).toBe(true);
        await type('salu', restMs);
        expect((await whatComes(6000)).sent).toBe(''); // half a name, too: five seconds after its last key
        await type('te\r', restMs);
        const after = await whatComes(4000);
        expect(after.text).toContain('salute');
        expect(after.sent).toMatch(/^(@where\r)+$/);
    },
    LIMIT_MS,
);

test(
    '"Are you sure?" keeps its answer for the person',
    async () => {
        const { whatComes, type } = await edit(SEED + 2);
        await type('page 2\r');
        await whatComes(2000);
        await type('new\r');
        const asked = await whatComes(3000);
        expect(asked.sent).toBe('');
        expect(asked.text).toContain('Are you sure?');
        expect(asked.text).not.toContain(' no');
        await type('y');
        const after = await whatComes(4000);
        expect(after.text).toContain('* unsaved'); // it was emptied
        expect(after.sent).toMatch(/^(@where\r)+$/);
    },
    LIMIT_MS,
);

test(
    'a play that was typed plays to its end',
    async () => {
        const { whatComes, type } = await edit(SEED + 3);
        await type('play 2\r');
        const played = await whatComes(3000);
        expect(played.sent).toBe('');
        expect(played.text).toContain('Page 2 step ');
        const ended = await whatComes(15_000);
        expect(played.text + ended.text).not.toContain('[STOP]');
        expect(ended.sent).toMatch(/^(@where\r)+$/);
    },
    LIMIT_MS,
);

test(
    'a list stays until somebody has read it',
    async () => {
        const { whatComes, type } = await edit(SEED + 4);
        await type('help\r');
        const listed = await whatComes(3000);
        expect(listed.sent).toBe('');
        expect(listed.text.split('PageNumber:')).toHaveLength(2); // the screen that it hides, and no other
        await type('q');
        expect((await whatComes(4000)).sent).toMatch(/^(@where\r)+$/);
    },
    LIMIT_MS,
);

test(
    'lines that are pasted, and an earlier one that is fetched back',
    async () => {
        const { whatComes, type } = await edit(SEED + 5);
        await type('page 100\rname\r', 0);
        expect((await whatComes(3000)).sent).toBe('');
        await type('\r');
        await type('\b\x1b[A\r'); // opens a line, and has no letter; before the page has asked, NAME is the last one
        expect((await whatComes(3000)).sent).toBe('');
        await type('one\r');
        expect((await whatComes(3000)).sent).toMatch(/^(@where\r)+$/);
    },
    LIMIT_MS,
);

test(
    'limp joints are painted all the time: a line that is done is noticed, a name that is asked for too',
    async () => {
        const { bench, whatComes, type } = await edit(SEED + 6);
        const random = randomNumbers(SEED);
        await type('off\r');
        const run = bench.board.runTo.bind(bench.board);
        bench.board.runTo = cycles => {
            if (random() < 0.05) bench.board.pushServo(Math.floor(random() * 18), 400 + Math.floor(random() * 200));
            return run(cycles);
        };
        expect((await whatComes(4000)).sent).toContain('@where\r');
        await type('x\r'); // brings the screen back
        await whatComes(200);
        await type('name\r');
        expect((await whatComes(6000)).sent).toBe('');
    },
    LIMIT_MS,
);

test(
    'what is wanted meanwhile is refused with a word at once, and never done later; Ctrl-C ends what is open',
    async () => {
        const { bench, connection, whatComes, type } = await edit(SEED + 7);
        await type('name\r');
        const early = expect(bench.until(play(connection.requests, 2))).rejects.toMatchObject({ code: 'edit-waits' }); // perhaps the line is done in a moment
        expect((await whatComes(3000)).sent).toBe('');
        await early;
        expect(connection.isInDialog).toBe(true);
        await expect(bench.until(play(connection.requests, 2), 50)).rejects.toMatchObject({ code: 'edit-waits' });
        await type('\x03');
        const after = await whatComes(3000);
        expect(connection.isInDialog).toBe(false);
        expect(after.sent).toMatch(/^(@where\r)+$/);
    },
    LIMIT_MS,
);

test(
    'stop ends a play that was typed, however soon it comes; without one there is nothing to break off',
    async () => {
        const { bench, connection, whatComes, type } = await edit(SEED + 9);
        for (const soonMs of [0, 3000]) {
            await type('play 2\r');
            await bench.run(soonMs);
            expect(await bench.until(connection.breakOff())).toBe(true);
            const ended = await whatComes(4000);
            expect(ended.text, `${soonMs} ms`).toContain('[BREAK]');
            expect(ended.sent, `${soonMs} ms`).toMatch(/^(@where\r)+$/);
        }
        expect(await bench.until(connection.breakOff())).toBe(false);
    },
    LIMIT_MS,
);

test(
    'a play that is ten times as slow, whose steps are seldom told',
    async () => {
        const { whatComes, type } = await edit(SEED + 10);
        await type('play 2 10\r');
        const played = await whatComes(10_000);
        expect(played.sent).toBe('');
        expect(played.text).toContain('Page 2 step ');
    },
    LIMIT_MS,
);

test(
    'Enter alone opens a line without a letter: it is ended, and no question lands in it',
    async () => {
        const { bench, connection, whatComes, type } = await edit(SEED + 11);
        await type('page 5\r');
        await whatComes(2000);
        await type('x\b\r'); // brings the screen back
        await bench.run(1500);
        await type('\r');
        const after = await whatComes(4000);
        expect(after.sent).toMatch(/^(\x15\r)?(@where\r)+$/);
        expect(after.text).not.toContain('Bad Command');
        expect((await bench.until(askWhere(connection.requests))).state).toBe('idle');
    },
    LIMIT_MS,
);

test(
    'a line that Edit does not take, because the robot moves, holds nothing back for ever',
    async () => {
        const { bench, connection, whatComes, type } = await edit(SEED + 12);
        await bench.until(play(connection.requests, 2));
        await bench.run(1000);
        await type('page 5\r');
        expect((await whatComes(8000)).sent).toMatch(/^(@where\r)+$/);
    },
    LIMIT_MS,
);

test(
    'a cable that is pulled answers nothing either',
    async () => {
        const { bench, connection, whatComes, type } = await edit(SEED + 8);
        await type('name\r');
        await bench.run(500);
        bench.port.unplug();
        expect((await whatComes(8000)).sent).toBe('');
        expect(connection.isInDialog).toBe(true);
        await type('back\r');
        expect((await whatComes(6000)).text).toContain('back');
        expect(connection.state).toBe('ready');
    },
    LIMIT_MS,
);
