// SPDX-License-Identifier: MIT
// The picture asks for a frame when something has changed, goes on while something moves, and rests then.
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { PictureFrames } from '../view/picture-frames.ts';
import { PictureQuality } from '../view/picture-quality.ts';

let due: ((nowMs: number) => void) | null = null;
let nowMs = 1000;

beforeEach(() => {
    due = null;
    nowMs = 1000;
    vi.stubGlobal('requestAnimationFrame', (call: (nowMs: number) => void) => {
        expect(due).toBeNull(); // one at a time
        due = call;
        return 1;
    });
    vi.stubGlobal('cancelAnimationFrame', () => (due = null));
});
afterEach(() => vi.unstubAllGlobals());

/** Frames until the picture rests, at most so many. */
function run(most = 1000, eachMs = 16): number {
    let frames = 0;
    for (; due && frames < most; frames++) {
        const call = due;
        due = null;
        nowMs += eachMs;
        call(nowMs);
    }
    return frames;
}

function bench({ bySoftware = false } = {}) {
    const picture = { isNew: false, isMoving: false, isBusy: false };
    const elapsed: number[] = [];
    let shown = 0;
    const quality = new PictureQuality(bySoftware);
    const frames = new PictureFrames(quality, {
        isBusy: () => picture.isBusy,
        draw: elapsedMs => {
            elapsed.push(elapsedMs);
            return picture;
        },
        shown: () => shown++,
        resize: () => frames.ask(),
    });
    return { picture, elapsed, frames, quality, shown: () => shown };
}

test('it rests until it is asked, and asked often it takes one frame', () => {
    const { frames, elapsed } = bench();
    expect(frames.isAtRest).toBe(true);
    for (let i = 0; i < 3; i++) frames.ask();
    expect(frames.isAtRest).toBe(false);
    expect(run()).toBe(1);
    expect(elapsed).toHaveLength(1);
    expect(frames.isAtRest).toBe(true);
});

test.each(['isNew', 'isMoving', 'isBusy'] as const)('it goes on while it %s', what => {
    const { frames, picture } = bench();
    picture[what] = true;
    frames.ask();
    expect(run(50)).toBe(50);
    picture[what] = false;
    expect(run()).toBe(1);
    expect(frames.isAtRest).toBe(true);
});

test('what glides does not leap by the length of the rest', () => {
    const { frames, picture, elapsed } = bench();
    picture.isMoving = true;
    frames.ask();
    run(3);
    picture.isMoving = false;
    run();
    nowMs += 60_000;
    frames.ask();
    run();
    expect(Math.max(...elapsed)).toBeLessThan(17);
});

test('a new picture is told when it is on the screen', () => {
    const { frames, picture, shown } = bench();
    picture.isNew = true;
    frames.ask();
    run(1);
    picture.isNew = false;
    picture.isBusy = true; // it is copied
    run(3);
    expect(shown()).toBe(0);
    picture.isBusy = false;
    run();
    expect(shown()).toBe(1);
});

test('a weak graphics chip: at rest the picture becomes sharp again, and then rests', () => {
    const { frames, picture, quality } = bench();
    picture.isMoving = true;
    frames.ask();
    run(40, 60);
    expect(quality.isLowered).toBe(true);
    picture.isMoving = false;
    run(2000);
    expect(quality.quality.pixels).toBe(1);
    expect(frames.isAtRest).toBe(true);
});

test('by software it rests, too, though its quality stays low', () => {
    const { frames, picture } = bench({ bySoftware: true });
    picture.isNew = true;
    frames.ask();
    run(1);
    picture.isNew = false;
    expect(run()).toBeLessThan(10); // it waits for its turn
    expect(frames.isAtRest).toBe(true);
});

test('what comes after the end asks for nothing', () => {
    const { frames } = bench();
    frames.ask();
    frames.dispose();
    expect(due).toBeNull();
});
