// SPDX-License-Identifier: MIT
// The clock for a real robot while the computer is busy for a second.
import { expect, test } from 'vitest';
import { wallClock } from '../robot/clock.ts';

test('an answer that came while nobody was awake comes before the end of its time', async () => {
    const order: string[] = [];
    const ended = new Promise<void>(resolve =>
        wallClock.after(300, () => {
            order.push('time is over');
            resolve();
        }),
    );
    setTimeout(() => order.push('answer'), 310);
    for (const start = performance.now(); performance.now() - start < 1000; ); // busy
    await ended;
    expect(order).toEqual(['answer', 'time is over']);
});

test('what is taken back is never called, not even in a later slice', async () => {
    let calls = 0;
    const takeBack = wallClock.after(250, () => calls++);
    await new Promise<void>(resolve => wallClock.after(150, resolve));
    takeBack();
    await new Promise<void>(resolve => wallClock.after(250, resolve));
    expect(calls).toBe(0);
});
