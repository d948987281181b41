// SPDX-License-Identifier: MIT
// A page that is loaded anew does not know what was typed before it: its first question does no harm there. Against the real firmware, in
// simulated time.
import { expect, test } from 'vitest';
import { connected } from './connected.ts';
import { RobotBench } from './robot-bench.ts';

const SEED = 20261124;
const LIMIT_MS = 300_000;

async function visit(bench: RobotBench, isFresh = false) {
    const { connection, text } = connected(bench, isFresh);
    const untilReady = async (limitMs: number): Promise<number> => {
        let ms = 0;
        for (; connection.state !== 'ready' && ms < limitMs; ms += 10) await bench.run(10);
        return ms;
    };
    const type = async (keys: string): Promise<void> => {
        await connection.type(new TextEncoder().encode(keys));
        await bench.run(700); // the screen comes back first
    };
    return { connection, untilReady, type, text };
}

/** Somebody types these keys one after another, then loads the page anew. */
async function again(image: 'play' | 'edit', seed: number, ...keys: string[]) {
    const bench = await RobotBench.make(image, seed);
    const before = await visit(bench);
    await before.untilReady(8000);
    for (const some of keys) await before.type(some);
    await before.connection.close();
    return { bench, ...(await visit(bench)) };
}

test.each(['', 'salu'])(
    'a name that waits for %j stays as it was',
    async letters => {
        const { untilReady, text, type } = await again('edit', SEED, 'page 2\r', 'name\r', ...letters);
        expect(await untilReady(8000)).toBeLessThan(1000);
        expect(text()).toContain('Name kept');
        await type('re\r');
        expect(text()).toContain('bow');
        expect(text()).not.toContain('* unsaved');
    },
    LIMIT_MS,
);

test(
    'a question is answered by nobody, or with no',
    async () => {
        const { untilReady, text, type } = await again('edit', SEED + 1, 'page 2\r', 'new\r');
        await untilReady(8000);
        await type('re\r');
        expect(text()).toContain('bow');
        expect(text()).not.toContain('* unsaved');
    },
    LIMIT_MS,
);

test(
    'a play that was typed plays to its end, then Edit answers',
    async () => {
        const { connection, untilReady, text } = await again('edit', SEED + 2, 'play 2\r');
        expect(await untilReady(1000)).toBe(1000);
        expect(connection.isInDialog).toBe(true);
        expect(await untilReady(30_000)).toBeLessThan(30_000);
        expect(connection.isInDialog).toBe(false);
        expect(text()).toContain('step ');
        expect(text()).not.toContain('[STOP]');
    },
    LIMIT_MS,
);

test(
    'stop ends such a play',
    async () => {
        const { bench, connection, untilReady, text } = await again('edit', SEED + 2, 'play 2 10\r');
        await untilReady(1000);
        expect(await bench.until(connection.breakOff())).toBe(true);
        await untilReady(4000);
        expect(text()).toContain('[BREAK]');
        expect(connection.state).toBe('ready');
    },
    LIMIT_MS,
);

test.each([[[]], [['page 5\r']], [['pag']], [['help\r']], [['off\r']]])(
    'Edit answers at once after %j',
    async keys => {
        const { untilReady, text } = await again('edit', SEED + 3, ...keys);
        expect(await untilReady(8000)).toBeLessThan(1000);
        expect(text()).not.toContain('Bad Command');
    },
    LIMIT_MS,
);

test.each([[[]], [['nonsen']]])(
    'Play answers at once after %j',
    async keys => {
        const { untilReady, text } = await again('play', SEED + 4, ...keys);
        expect(await untilReady(8000)).toBeLessThan(1000);
        expect(text()).not.toMatch(/unknown|bad/i);
    },
    LIMIT_MS,
);

test(
    'what is typed while the page does not yet know what answers: a board that is switched on, whose start nobody waits for',
    async () => {
        const bench = await RobotBench.make('edit', SEED + 5);
        const { connection, untilReady, text } = await visit(bench, true);
        for (let ms = 0; connection.state !== 'silent' && ms < 2000; ms += 10) await bench.run(10); // its loader wanted no "@ver"
        expect(text()).toContain('PageNumber');
        await connection.type(new TextEncoder().encode('name\r'));
        expect(await untilReady(6000)).toBe(6000);
        expect(text()).not.toContain('@');
        await connection.type(new TextEncoder().encode('first\r'));
        expect(await untilReady(4000)).toBeLessThan(4000);
        expect(text()).toContain('first');
    },
    LIMIT_MS,
);
