// SPDX-License-Identifier: MIT
// A drag asks physics for one pose at a time, always the newest. Results for a pose that is no longer shown are dropped.
import { expect, test } from 'vitest';
import type { Touch } from '../model/trial.ts';
import { TouchWatch } from '../view/editor/touch-watch.ts';

const touch = (depthM: number): Touch => ({ links: ['left_hand', 'right_hand'], depthM });

function bench() {
    const asked: number[] = [];
    const answers: ((touches: readonly Touch[]) => void)[] = [];
    let answered = 0;
    const touching = (pose: ArrayLike<number>): Promise<readonly Touch[]> =>
        new Promise(resolve => {
            asked.push(pose[0] ?? -1);
            answers.push(resolve);
        });
    const watch = new TouchWatch({ touching }, () => answered++);
    const answer = async (touches: readonly Touch[]): Promise<void> => {
        answers.shift()?.(touches);
        await Promise.resolve();
        await Promise.resolve();
    };
    return { watch, asked, answer, answered: () => answered };
}

test('one question at a time, of the newest pose; a pose that is known is not asked again', async () => {
    const { watch, asked, answer, answered } = bench();
    for (const position of [1, 2, 3]) watch.look([position]);
    expect(asked).toEqual([1]);
    expect(answered()).toBe(0);
    await answer([touch(0.01)]);
    expect(answered()).toBe(1);
    expect(watch.touches).toEqual([touch(0.01)]);
    watch.look([3]);
    expect(asked).toEqual([1, 3]);
    await answer([]);
    watch.look([3]);
    expect(asked).toEqual([1, 3]);
    expect(watch.touches).toEqual([]);
});

test('nothing is told when no step is shown, though an answer comes late', async () => {
    const { watch, asked, answer } = bench();
    watch.look([1]);
    watch.look(null);
    await answer([touch(0.01)]);
    expect(watch.touches).toEqual([]);
    watch.look([1]);
    expect(asked).toEqual([1, 1]);
});
