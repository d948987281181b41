// SPDX-License-Identifier: MIT
// My servos: Play and Edit as WebAssembly on servos/machine.ts, in simulated time. The bytes sent to the servos are compared with those
// that the simulated board sends.
import { readFile } from 'node:fs/promises';
import { expect, test } from 'vitest';
import { SERVO_IDS } from '../sim/machine.ts';
import { distinct, goalsOfBoard, posesOf } from './board-goals.ts';
import type { FakeOptions } from './fake-servos.ts';
import { FakeServos } from './fake-servos.ts';
import { wasmModule } from './robot-bench.ts';

const PAGES_BYTES = 0x20000;
const [WRITE, REG_WRITE, ACTION] = [3, 4, 5];

async function library(): Promise<Uint8Array> {
    const pages = new Uint8Array(PAGES_BYTES).fill(0xff);
    pages.set(await readFile(new URL('../../../build/motions/motions.bin', import.meta.url)));
    return pages;
}

/** Runs the program with these servos until the action is done. */
async function withProgram(
    image: 'play' | 'edit',
    options: Partial<FakeOptions>,
    action: (servos: FakeServos) => Promise<void>,
): Promise<FakeServos> {
    const servos = new FakeServos({ ids: SERVO_IDS, kept: [await library(), null, null], ...options });
    const run = servos.run(await wasmModule(`servos-${image}`));
    await Promise.race([action(servos), run]);
    servos.stop();
    await run;
    return servos;
}

async function typeAndWait(servos: FakeServos, line: string, answer: string): Promise<void> {
    const from = servos.text.length;
    servos.type(`${line}\r`);
    await servos.until(() => servos.text.includes(answer, from));
}

/** Page 100 as letters. */
function nameIn(memories: readonly Uint8Array[] | undefined): string {
    return new TextDecoder('latin1').decode(memories?.[0]?.subarray(512 * 100, 512 * 101));
}

test.each([
    ['bow', 1],
    ['wave', 16],
] as const)('the goals of %s are those of the board, through an adapter that takes %i ms', async (motion, latencyMs) => {
    const { frames, text } = await withProgram('play', { latencyMs }, async servos => {
        await servos.until(() => servos.text.includes('18 servos: 1-18'));
        await typeAndWait(servos, `play ${motion}`, 'Ended');
    });
    const ours = distinct(posesOf(frames));
    const board = await goalsOfBoard(motion);
    expect(ours.length).toBeGreaterThan(200);
    expect(board.slice(board.indexOf(ours[0] ?? ''))).toEqual(ours);
    expect(text).not.toContain('does not answer');
});

test('nothing moves and no torque is switched before a person says so', async () => {
    const { frames, packets } = await withProgram('play', {}, async servos => {
        await servos.until(() => servos.text.includes('18 servos: 1-18'));
        await typeAndWait(servos, 'status', 'OK');
    });
    expect(frames).toEqual([]);
    expect(packets.filter(({ code }) => code === WRITE || code === REG_WRITE || code === ACTION)).toEqual([]);
});

test('an adapter that is pulled out ends the play, and nothing goes on before `on`', async () => {
    await withProgram('play', {}, async servos => {
        await servos.until(() => servos.text.includes('18 servos: 1-18'));
        await typeAndWait(servos, 'play walk', 'repetition 1');
        servos.isThere = false;
        await servos.until(() => servos.text.includes('The servo adapter is gone: plug it in, then on'));
        const sent = servos.frames.length;
        const outMs = servos.nowMs + 5000;
        await servos.until(() => servos.nowMs > outMs);
        servos.isThere = true;
        await servos.until(() => servos.text.includes('Servo 18 answers again'));
        await typeAndWait(servos, 'play bow', '\r\n] ');
        expect(servos.text).not.toContain('page 2 (bow)');
        expect(servos.frames).toHaveLength(sent);
        await typeAndWait(servos, 'on', 'OK');
        await typeAndWait(servos, 'play bow', 'Ended');
        expect(servos.frames.length).toBeGreaterThan(sent + 100);
    });
});

test('a page that stands still for longer than 0.1 s breaks the play off, softly, and says so', async () => {
    await withProgram('play', {}, async servos => {
        await servos.until(() => servos.text.includes('18 servos: 1-18'));
        await typeAndWait(servos, 'play walk', 'repetition 1');
        servos.nowMs += 250;
        await servos.until(() => servos.text.includes('The computer came 0.1 s late'));
    });
});

test('a port that takes no bytes for longer than 0.1 s breaks the play off in the same way, and no goals pile up for it', async () => {
    await withProgram('play', {}, async servos => {
        await servos.until(() => servos.text.includes('18 servos: 1-18'));
        await typeAndWait(servos, 'play walk', 'repetition 1');
        const sent = servos.frames.length;
        const outMs = servos.nowMs + 250;
        servos.holdUp(250);
        await servos.until(() => servos.nowMs >= outMs + 8);
        expect(servos.frames.length - sent).toBeLessThan(4);
        await servos.until(() => servos.text.includes('The computer came 0.1 s late'));
    });
});

test('a browser that is held up while it looks for servos misses none', async () => {
    await withProgram('play', {}, async servos => {
        await servos.until(() => servos.rate === 1_000_000 && servos.packets.at(-1)?.id === 5);
        servos.latencyMs = 50; // answers came fast until now, and two tries of 20 ms end before that
        await servos.until(() => /\d+ servos: /.test(servos.text));
        expect(servos.text).toContain('18 servos: 1-18');
    });
});

test('what Edit saves is kept, and is there at the next start', async () => {
    const first = await withProgram('edit', {}, async servos => {
        await servos.until(() => servos.text.includes('Arrows move'));
        servos.type('page 100\r');
        servos.type('name salute\r');
        servos.type('save\r');
        await servos.until(() => nameIn(servos.written.at(-1)).includes('salute'));
    });
    const kept = first.written.at(-1) ?? [];
    expect(kept.map(memory => memory.length)).toEqual([PAGES_BYTES, 0x2000, 0x1000]);
    await withProgram('play', { kept: [...kept] }, async servos => {
        await servos.until(() => servos.text.includes('18 servos'));
        await typeAndWait(servos, 'list', 'salute');
    });
});

test('a setting made in a motion is kept when the program ends in that motion', async () => {
    const first = await withProgram('play', {}, async servos => {
        await servos.until(() => servos.text.includes('18 servos: 1-18'));
        await typeAndWait(servos, 'play walk', 'Playing');
        await typeAndWait(servos, 'settings approach 33', 'approach 33');
        await servos.until(() => servos.text.includes('Next link'));
        servos.isAskedToEnd = true;
        await new Promise(() => undefined); // until the program has ended
    });
    await withProgram('play', { kept: first.written.at(-1) ?? [null, null, null] }, async servos => {
        await servos.until(() => servos.text.includes('18 servos'));
        servos.type('settings\r');
        await servos.until(() => /approach +\d/.test(servos.text));
        expect(servos.text).toMatch(/approach +33\b/);
    });
});

test('who is missing is named', async () => {
    await withProgram('play', { ids: [1, 2, 4] }, servos => servos.until(() => servos.text.includes('3 servos: 1-2 4')));
    await withProgram('play', { ids: [] }, servos => servos.until(() => servos.text.includes('0 servos')));
});
