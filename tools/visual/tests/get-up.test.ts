// SPDX-License-Identifier: MIT
// "Get up" tries again while the robot lies, and only then.
import { expect, test } from 'vitest';
import type { Place } from '../model/space.ts';
import { GetUp } from '../view/get-up.ts';

const TRUNK: Place = { pos: [0, 0, 0.1], quat: [Math.SQRT1_2, 0, Math.SQRT1_2, 0] };

/** answers: whether the robot begins to play. */
function asked(...answers: boolean[]) {
    const played: string[] = [];
    const getUp = new GetUp(motion => Promise.resolve(answers[played.push(motion) - 1] ?? true));
    const look = async (isMoving: boolean, hasFallen = true): Promise<void> => {
        await Promise.resolve(); // what the robot has answered is known
        getUp.look(isMoving, TRUNK, hasFallen);
    };
    getUp.start(TRUNK);
    return { played, getUp, look };
}

test('it tries again when it still lies after a motion, until it stands', async () => {
    const { played, look } = asked();
    await look(true);
    await look(false); // it has rolled over and lies again
    expect(played).toHaveLength(2);
    await look(true);
    await look(false, false);
    await look(true, false);
    await look(false); // another motion, and another fall
    expect(played).toHaveLength(2);
});

test('refused: it does not get up by itself after what plays now, nor after a later motion or fall', async () => {
    for (const isPlaying of [true, false]) {
        const { played, getUp, look } = asked(false);
        getUp.look(isPlaying, TRUNK, true);
        getUp.look(false, TRUNK, true); // may come before the refusal
        await look(false);
        await look(true);
        await look(false);
        expect(played).toHaveLength(1);
    }
});

test('refused the second time, or stopped while it is asked for: the next motion is not followed by getting up', async () => {
    const { played, look } = asked(true, false);
    await look(true);
    await look(false);
    await look(true);
    await look(false);
    expect(played).toHaveLength(2);
    const stopped = asked();
    stopped.getUp.stop();
    await stopped.look(true);
    await stopped.look(false);
    expect(stopped.played).toHaveLength(1);
});
