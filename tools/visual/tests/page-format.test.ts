// SPDX-License-Identifier: MIT
// Reading and writing pages, against motion/PAGE_FORMAT.md: its hex dump was made by hand, and its table describes the content.
import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import { readPage, stepSeconds, writePage } from '../model/page.ts';
import type { Step } from '../model/page.ts';
import { libraryDocument, makeFormat, makeMotion, must, refusalOf } from './motion-bench.ts';

const { format } = await makeFormat();

/** "000  62 6F 77 ..". A `*` stands for rows equal to the one before. */
function dumpOfBow(): Uint8Array {
    const text = readFileSync(new URL('../../../motion/PAGE_FORMAT.md', import.meta.url), 'utf8');
    const block = /```\n(000 {2}[\s\S]*?)```/.exec(text)?.[1] ?? '';
    const bytes = new Uint8Array(512);
    let end = 0;
    for (const [, at, row] of block.matchAll(/^([0-9A-F]{3}) {2}((?:[0-9A-F]{2} ?){16})$/gm)) {
        const start = Number.parseInt(at ?? '', 16);
        for (; end < start; end++) bytes[end] = bytes[end - 16] ?? 0;
        bytes.set(
            (row ?? '')
                .trim()
                .split(' ')
                .map(byte => Number.parseInt(byte, 16)),
            start,
        );
        end = start + 16;
    }
    return bytes;
}

function step(positions: Readonly<Record<number, number>>, time: number, pause: number): Step {
    return { positions: Array.from({ length: 31 }, (_, id) => positions[id] ?? null), time, pause };
}

const BOW = {
    name: 'bow',
    code: 2,
    repetitions: 2,
    accelTime: 16,
    exit: 3,
    speed: 32,
    schedule: 'time' as const,
    steps: [step({ 11: 412, 12: 612 }, 64, 32), step({ 11: 512, 12: 512 }, 64, 0)],
};

test('the bow of PAGE_FORMAT.md is read as its table says', () => {
    const bow = readPage(format, dumpOfBow());
    expect(bow).toMatchObject(BOW);
    expect(bow).toMatchObject({ next: 0, linked1: 0, linked1Code: 0, linked2: 0, linked2Code: 0, blendRight: 0, blendLeft: 0 });
    expect(bow.compliance).toEqual(new Array(31).fill(0x55));
});

test('the bow made of an empty page is the dump, byte for byte; of erased flash too', () => {
    expect(must(writePage(format, format.empty, BOW))).toEqual(dumpOfBow());
    expect(must(writePage(format, new Uint8Array(512).fill(0xff), BOW))).toEqual(dumpOfBow());
});

test('every field of one byte stands where PAGE_FORMAT.md says', () => {
    const places = {
        repetitions: 15,
        blendRight: 17,
        blendLeft: 18,
        code: 21,
        speed: 22,
        accelTime: 24,
        next: 25,
        exit: 26,
        linked1: 27,
        linked1Code: 28,
        linked2: 29,
        linked2Code: 30,
    };
    for (const [field, at] of Object.entries(places)) {
        const bytes = must(writePage(format, format.empty, { [field]: 77 }));
        const changed = [...bytes].flatMap((byte, i) => (byte !== format.empty[i] ? [i] : []));
        expect(changed, field).toEqual([at, 31]);
        expect(bytes[at]).toBe(77);
        expect(readPage(format, bytes)).toMatchObject({ [field]: 77 });
        expect(bytes.reduce((sum, byte) => sum + byte, 0) & 0xff).toBe(0xff);
    }
});

test('what a page cannot hold is refused', () => {
    const write = (change: Parameters<typeof writePage>[2]) => refusalOf(writePage(format, format.empty, change));
    expect(write({ next: 128 })).toBe('bad-number');
    expect(write({ speed: 0 })).toBe('bad-number');
    expect(write({ accelTime: 1.5 })).toBe('bad-number');
    expect(write({ name: 'fourteen chars' })).toBe('bad-name');
    expect(write({ name: 'Grüße' })).toBe('bad-name');
    expect(write({ steps: new Array<Step>(8).fill(step({}, 1, 0)) })).toBe('steps-full');
    expect(write({ steps: [step({ 3: 1024 }, 1, 0)] })).toBe('bad-number');
    expect(write({ steps: [step({}, 256, 0)] })).toBe('bad-number');
});

test('what a flag hides stays when a page is written, and unknown bytes do', () => {
    const bytes = dumpOfBow();
    bytes[64 + 2 * 19] = 0x21; // hidden by the flag of joint 19
    bytes[23] = 9; // unknown value, must be kept
    bytes[63] = 0x55;
    bytes[64 + 64 * 5] = 0x12; // a step beyond the step count
    const before = format.sealed(bytes);
    const after = must(writePage(format, before, { steps: readPage(format, before).steps, name: 'bow' }));
    expect(after).toEqual(before);
});

test('seconds of steps are those of the player, for every page of the library in time base', async () => {
    const motion = await makeMotion();
    const library = await libraryDocument();
    let pages = 0;
    for (const [number, bytes] of library.pages.entries()) {
        const page = readPage(format, bytes);
        if (number === 0 || !format.isPlayable(bytes) || page.schedule !== 'time') continue;
        const alone = must(writePage(format, bytes, { next: 0, repetitions: 1 }));
        motion.setPage(1, alone);
        const pose = motion.firstPose(1, new Uint16Array(31).fill(512));
        expect(motion.start(1, pose)).toBe(true);
        const played = motion.curve(16000).ticks;
        const said = page.steps.reduce(
            (sum, _, k) => sum + stepSeconds(format, alone, k, pose).move + stepSeconds(format, alone, k, pose).pause,
            0,
        );
        expect(Math.abs(said * 128 - played), `page ${number}: ${said} s and ${played} ticks`).toBeLessThanOrEqual(page.steps.length);
        pages++;
    }
    expect(pages).toBeGreaterThan(20);
});
