// SPDX-License-Identifier: MIT
// What the page says of the layers that a robot reports.
import { expect, test } from 'vitest';
import type { SessionState } from '../view/session/session.ts';
import { layersText } from '../view/texts/robot.ts';

function state(layer: number, aim: string): SessionState {
    const fields = new Map([['layer', String(layer)]]);
    const where = { fields, aimed: Number.parseInt(aim, 16) };
    return { shownPage: null, pages: [{ page: 7, name: 'wave_over' }], where } as unknown as SessionState;
}

test('the page and the joints moved by code; the name is the one in the robot', () => {
    expect(layersText(state(7, '00000000'))).toBe('Laid over: motion 7 (wave_over).');
    expect(layersText(state(0, '4000000a'))).toBe('Moved by code: joint 1, 3, 30.');
    expect(layersText(state(0, '00000000'))).toBe('No layers.');
    expect(layersText({ ...state(0, '0'), where: null })).toBe('No layers.');
});

test('My servos have 256 motions, the document 128: one beyond is named by its number', () => {
    expect(layersText(state(200, '00000000'))).toBe('Laid over: motion 200.');
});
