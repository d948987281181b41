// SPDX-License-Identifier: MIT
// "Get up" tries again while the robot lies, and only then.
import { expect, test } from 'vitest';
import type { Place } from '../model/space.ts';
import { GetUp } from '../view/get-up.ts';

const TRUNK: Place = { pos: [0, 0, 0.1], quat: [Math.SQRT1_2, 0, Math.SQRT1_2, 0] };

test('it tries again when it still lies after a motion, until it stands', () => {
    const played: string[] = [];
    const getUp = new GetUp(motion => played.push(motion));
    getUp.start(TRUNK);
    getUp.look(true, TRUNK, true);
    getUp.look(false, TRUNK, true); // it has rolled over and lies again
    expect(played).toHaveLength(2);
    getUp.look(true, TRUNK, true);
    getUp.look(false, TRUNK, false);
    getUp.look(true, TRUNK, false);
    getUp.look(false, TRUNK, true); // another motion, and another fall
    expect(played).toHaveLength(2);
});

test('refused, and put on its feet by hand: it does not get up by itself after a later fall', () => {
    const played: string[] = [];
    const getUp = new GetUp(motion => played.push(motion));
    getUp.start(TRUNK); // the robot refuses: it never moves
    getUp.look(false, TRUNK, true);
    getUp.look(false, TRUNK, false);
    getUp.look(true, TRUNK, false);
    getUp.look(true, TRUNK, true);
    getUp.look(false, TRUNK, true);
    expect(played).toHaveLength(1);
});
