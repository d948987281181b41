// SPDX-License-Identifier: MIT
// "Wave while walking" waits for the walk that it has begun, and for nothing else.
import { expect, test } from 'vitest';
import type { SessionState } from '../view/session/session.ts';
import { WaveWish } from '../view/wave-wish.ts';

const WALK = 1;
const at = (state: string, code = 0, isPowered = true): SessionState => ({ isPowered, where: { state, code } }) as unknown as SessionState;

function asked(): WaveWish {
    const wish = new WaveWish();
    wish.ask();
    return wish;
}

test('it waves when the robot walks, once', () => {
    const wish = asked();
    const states = [at('idle'), at('approach'), at('playing', WALK), at('playing', WALK), at('idle'), at('playing', WALK)];
    expect(states.map(state => wish.isDue(state, WALK))).toEqual([false, false, true, false, false, false]);
});

test('a robot whose key starts nothing does not wave over the motion that is played next, nor over a later walk', () => {
    const wish = asked();
    expect([at('idle'), at('playing'), at('idle'), at('playing', WALK)].map(state => wish.isDue(state, WALK))).toEqual(
        Array(4).fill(false),
    );
});

test('a press that starts nothing is soon forgotten: the robot refuses, is paused, or its play ends before it has begun', () => {
    for (const states of [
        ['idle', 'idle', 'idle'],
        ['paused', 'paused', 'paused'],
        ['approach', 'idle', 'idle', 'idle'],
    ]) {
        const wish = asked();
        for (const state of states) wish.isDue(at(state), WALK);
        expect(wish.isDue(at('playing', WALK), WALK)).toBe(false);
    }
    const slow = asked();
    const idle = at('idle');
    for (let i = 0; i < 9; i++) slow.isDue(idle, WALK); // one answer of the robot, and changes of something else
    for (let i = 0; i < 9; i++) slow.isDue(at('approach'), WALK);
    expect(slow.isDue(at('playing', WALK), WALK)).toBe(true);
});

test('a robot that is off, or stopped, forgets it', () => {
    const off = asked();
    expect([at('idle', 0, false), at('playing', WALK)].map(state => off.isDue(state, WALK))).toEqual([false, false]);
    const stopped = asked();
    stopped.forget();
    expect(stopped.isDue(at('playing', WALK), WALK)).toBe(false);
});
