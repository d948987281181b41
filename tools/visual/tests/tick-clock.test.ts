// SPDX-License-Identifier: MIT
// The clock of the robot in the page: it follows the robot's ticks, and a busy page does not count as silence of the robot.
import { expect, test } from 'vitest';
import { TickClock } from '../app/tick-clock.ts';

test('a time-out of a second comes after 128 ticks, not before, and only once', () => {
    const clock = new TickClock();
    let calls = 0;
    clock.after(1000, () => calls++);
    for (let tick = 1; tick < 128; tick++) clock.reach(tick);
    expect([calls, clock.now() < 1000]).toEqual([0, true]);
    for (let tick = 128; tick < 300; tick++) clock.reach(tick);
    expect(calls).toBe(1);
});

test('asked just before a page that was busy hears of five seconds: the answer still has its time', () => {
    const clock = new TickClock();
    clock.reach(10);
    let isOver = false;
    clock.after(1000, () => (isOver = true));
    clock.reach(10 + 5 * 128);
    expect(isOver).toBe(false);
    for (let tick = 1; tick <= 128; tick++) clock.reach(10 + 5 * 128 + tick);
    expect(isOver).toBe(true);
});

test('a time-out that was taken back does not come', () => {
    const clock = new TickClock();
    let calls = 0;
    const cancel = clock.after(50, () => calls++);
    cancel();
    for (let tick = 1; tick < 50; tick++) clock.reach(tick);
    expect(calls).toBe(0);
});
