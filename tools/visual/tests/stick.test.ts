// SPDX-License-Identifier: MIT
// The stick of a gamepad: a stick that is pushed all the time must not start a walk again.
import { afterEach, expect, test, vi } from 'vitest';
import { StickDrive } from '../app/stick.ts';
import { wallClock } from '../robot/clock.ts';
import type { Connection } from '../robot/connection.ts';
import { Requests } from '../robot/requests.ts';
import { RobotError } from '../robot/robot-error.ts';

const PUSHED = { x: 0, y: 1 };
const WALK = 20;

afterEach(() => void vi.useRealTimers());

/** A robot that answers at once. plays: it accepts a play and a drive. */
function driven() {
    vi.useFakeTimers();
    const sent: string[] = [];
    const robot = { plays: true };
    const ask = async (text: string): Promise<string> => {
        sent.push(text.split(' ', 1)[0] ?? '');
        if (/^@(play|drive)/.test(text) && !robot.plays) throw new RobotError('refused', 'nothing plays', { number: 4 });
        return '';
    };
    const fail = vi.fn();
    const stick = new StickDrive(
        () => ({ requests: { ask } }) as unknown as Connection,
        () => WALK,
        fail,
    );
    /** The page reads a gamepad at every picture. */
    const hold = async (pictures: number): Promise<void> => {
        for (let i = 0; i < pictures; i++) {
            stick.set(PUSHED);
            await vi.advanceTimersByTimeAsync(16);
        }
    };
    const plays = (): number => sent.filter(word => word === '@play').length;
    return { stick, robot, sent, fail, hold, plays };
}

test('a stick that is still pushed after Stop walks again only when it was let go', async () => {
    const { stick, robot, hold, plays, sent } = driven();
    await hold(60);
    expect(plays()).toBe(1);
    stick.stop();
    const before = sent.length;
    await hold(60);
    robot.plays = false; // the walk has ended
    await hold(60);
    robot.plays = true;
    await hold(60);
    expect(plays()).toBe(1);
    expect(sent.slice(before)).not.toContain('@drive');
    stick.set(null);
    await hold(10);
    expect(plays()).toBe(2);
});

test('a robot that refuses is asked once for each push, not at every picture', async () => {
    const { stick, robot, fail, hold } = driven();
    robot.plays = false;
    await hold(60);
    expect(fail).toHaveBeenCalledTimes(1);
    stick.set(null);
    await hold(60);
    expect(fail).toHaveBeenCalledTimes(2);
});

/** A robot behind the real Requests. answers: to the first `@drive`; null: none comes. */
function answering(answer: string | null) {
    vi.useFakeTimers();
    const sent: string[] = [];
    const write = async (bytes: Uint8Array): Promise<void> => {
        const word = /@\w+/.exec(String.fromCharCode(...bytes))?.[0] ?? '';
        const isFirst = word === '@drive' && !sent.includes(word);
        sent.push(word);
        const line = isFirst ? answer : `${word} OK`;
        if (line !== null) setTimeout(() => requests.take(line), 5);
    };
    const requests = new Requests({ write }, wallClock);
    const fail = vi.fn();
    const stick = new StickDrive(
        () => ({ requests }) as unknown as Connection,
        () => WALK,
        fail,
    );
    return { stick, sent, fail };
}

test.each([
    ['the line has damaged', '@drive ERR 15 Bytes were lost', 'no-answer'],
    ['is refused', '@drive ERR 3 Out of range', 'refused'],
    ['is not answered, which the requests stop by themselves', null, 'no-answer'],
] as const)('a walk whose first @drive %s is stopped once: two stops within a second would break it off', async (_, answer, code) => {
    const { stick, sent, fail } = answering(answer);
    stick.set(PUSHED);
    await vi.advanceTimersByTimeAsync(3000);
    expect(sent).toEqual(['@play', '@drive', '@stop']);
    expect(fail.mock.calls).toEqual([[expect.objectContaining({ code })]]);
});

test('a walk that was stopped before the robot had answered the play is stopped behind it: the stop of a remote may have come before', async () => {
    const { stick, sent } = answering('@drive OK');
    stick.set(PUSHED);
    stick.stop(true);
    await vi.advanceTimersByTimeAsync(1000);
    expect(sent).toEqual(['@play', '@stop']);
});
