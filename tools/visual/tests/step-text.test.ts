// SPDX-License-Identifier: MIT
// Steps as text: the line in "A page by hand" of FORMAT.md; m512 itself reads the written text.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { expect, onTestFinished, test } from 'vitest';
import { JOINTS } from '../model/motion.ts';
import { readPage } from '../model/page.ts';
import type { Step } from '../model/page.ts';
import { stepsFromText, stepsToText } from '../model/step-text.ts';
import { makeFormat } from './motion-bench.ts';
import { randomNumbers } from './robot-bench.ts';

const PYTHON = new URL('../../../build/venv/bin/python', import.meta.url).pathname;
const LIBRARY = new URL('../../../build/motions/motions.bin', import.meta.url).pathname;
const step = (joints: Record<number, number>, time: number, pause = 0): Step => ({
    positions: Array.from({ length: JOINTS }, (_, id) => joints[id] ?? null),
    time,
    pause,
});

const stepsFrom = (text: string) => stepsFromText(text).steps;

test('the step of FORMAT.md, both ways', () => {
    const nod = step({ 1: 600, 2: 424 }, 40, 8);
    expect(stepsToText([nod])).toBe('step 40 pause 8 | 1:600 2:424\n');
    expect(stepsFrom('  step 40  pause 8 | 1:600 2:424\r\n\n')).toEqual([nod]);
    expect(stepsFrom('step 64 |')).toEqual([step({}, 64)]);
});

test('steps in rows: with the joints above, in either form', () => {
    const nod = step({ 1: 600, 3: 424 }, 40, 8);
    const rows = 'step 40 pause 8 | 600 . 424 - ~512\nstep  3         |   . 7   . .    .';
    for (const ids of ['# ID            |   1   2   3   4   5', 'row 1..3 4 5'])
        expect(stepsFrom(`${ids}\n${rows}`)).toEqual([nod, step({ 2: 7 }, 3)]);
    expect(stepsFrom(`row 1..5\n${rows}\nrow 2\nstep 1 | 9\nstep 2 | 4:5`).slice(2)).toEqual([step({ 2: 9 }, 1), step({ 4: 5 }, 2)]);
    for (const ids of ['', 'row 1..4', 'row 1..6', 'row 27..31', 'row 5..1', '# ID | hand'])
        expect(stepsFrom(`${ids}\n${rows}`)).toEqual([]);
    for (const value of ['1024', '?512', '0x8001', '+20', '30deg', 'x', '1:600'])
        expect(stepsFrom(`row 1 2\nstep 40 | 600 ${value}`)).toEqual([]);
});

test.each(['', 'hello', 'step 300 | 1:600', 'step 40 | 1:1024', 'step 40 | 31:5', 'step 40 | 1:600 x', 'step 40 | 1:600\nhello'])(
    '%j is no text of steps',
    text => {
        expect(stepsFrom(text)).toEqual([]);
    },
);

test.each([
    ['step 0.5s | 1:600', 'step 0.5s | 1:600'],
    ['step 64 | 1:600\n  step 300  | 1:500\nstep 301 | 1:500', 'step 300 | 1:500'],
    ['step 64 | 600 424', 'step 64 | 600 424'],
    ['# ID | 1 2\nstep 64 | 600 424\nstep 64 | same 1:+20', 'step 64 | same 1:+20'],
    ['# ID | 1 2\nstep 64 | 600 424\nhello', null],
    ['hello', null],
])('of %j the person is told which step cannot be read', (text, line) => {
    expect(stepsFromText(text)).toEqual({ steps: [], unread: line });
});

test('the steps of every motion of the library, copied out of the text that m512 makes of it', async () => {
    const folder = mkdtempSync(join(tmpdir(), 'm512-steps-'));
    onTestFinished(() => rmSync(folder, { recursive: true }));
    const image = new Uint8Array(readFileSync(LIBRARY));
    execFileSync(PYTHON, ['-m', 'm512', 'convert', LIBRARY, join(folder, 'a.m512')]);
    const { format } = await makeFormat();
    const motions = readFileSync(join(folder, 'a.m512'), 'utf8')
        .split(/^page /m)
        .slice(1);
    expect(motions.length).toBeGreaterThan(50);
    for (const motion of motions) {
        const page = Number.parseInt(motion, 10);
        const copied = motion.split('\n').filter(line => /^ *(# ID|step)/.test(line));
        expect(stepsFrom(copied.join('\n')), `page ${page}`).toEqual(readPage(format, image.slice(page * 512, page * 512 + 512)).steps);
    }
});

test('m512 makes the same steps of the text', async () => {
    const random = randomNumbers(41);
    const steps = Array.from({ length: 7 }, () =>
        step(
            Object.fromEntries(
                Array.from({ length: 1 + Math.floor(random() * 20) }, () => [Math.floor(random() * JOINTS), Math.floor(random() * 1024)]),
            ),
            Math.floor(random() * 256),
            Math.floor(random() * 256),
        ),
    );
    expect(stepsFrom(stepsToText(steps))).toEqual(steps);
    const folder = mkdtempSync(join(tmpdir(), 'm512-steps-'));
    onTestFinished(() => rmSync(folder, { recursive: true }));
    writeFileSync(join(folder, 'a.m512'), `motion512 1\npage 5 chance\n${stepsToText(steps)}`);
    execFileSync(PYTHON, ['-m', 'm512', 'convert', join(folder, 'a.m512'), join(folder, 'a.bin')]);
    const { format } = await makeFormat();
    expect(readPage(format, new Uint8Array(readFileSync(join(folder, 'a.bin'))).slice(5 * 512, 6 * 512)).steps).toEqual(steps);
});
