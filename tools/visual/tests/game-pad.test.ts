// SPDX-License-Identifier: MIT
// A gamepad: which one, and what it does while a dialog is open or another window has the focus.
import { expect, test } from 'vitest';
import { GamePad, padOf } from '../view/game-pad.ts';

const NOTHING = { buttons: [], stick: null };

/** A pad with these buttons pressed and its stick this far to the right. */
function pad(pressed: readonly number[], right = 0, index = 0) {
    return { index, axes: [right, 0], buttons: Array.from({ length: 16 }, (_, i) => ({ pressed: pressed.includes(i) })) };
}

test('buttons and stick drive; a pad that is unplugged lets go', () => {
    const one = new GamePad();
    one.read(pad([]), 'remote');
    expect(one.read(pad([12, 1], 0.5), 'remote')).toEqual({ buttons: ['up', 'b2'], stick: { x: 0.5, y: -0 } });
    expect(one.read(pad([], 0.2), 'remote')).toEqual(NOTHING);
    expect(one.read(null, 'remote')).toEqual(NOTHING);
});

test('in a dialog and in a window without the focus it only stops; what is still pushed afterwards drives only when all was let go', () => {
    const one = new GamePad();
    expect(one.read(pad([12], 1), null)).toEqual(NOTHING);
    expect(one.read(pad([0, 12], 1), null)).toEqual({ buttons: ['b6'], stick: null });
    expect(one.read(pad([12], 1), 'remote')).toEqual(NOTHING);
    expect(one.read(pad([12]), 'remote')).toEqual(NOTHING);
    one.read(pad([]), 'remote');
    expect(one.read(pad([12], 1), 'remote')).toEqual({ buttons: ['up'], stick: { x: 1, y: -0 } });
});

test('a stick drives when it has been at rest once, on each pad that is plugged in: the axis of a wheel may rest anywhere', () => {
    const one = new GamePad();
    expect(one.read(pad([12], 1), 'remote')).toEqual({ buttons: ['up'], stick: null });
    one.read(pad([]), 'remote');
    expect(one.read(pad([], 1), 'remote').stick).toEqual({ x: 1, y: -0 });
    one.read(null, 'remote');
    expect(one.read(pad([], 1), 'remote').stick).toBeNull();
});

test('a pad that takes the place of another one, with its stick or a button pushed, drives when all was let go', () => {
    for (const pushed of [pad([], 1, 1), pad([12], 0, 1), pad([12], 1, 1)]) {
        const one = new GamePad();
        one.read(pad([]), 'remote');
        for (let i = 0; i < 3; i++) expect(one.read(pushed, 'remote')).toEqual(NOTHING);
        expect(one.read(pad([0], 1, 1), 'remote')).toEqual({ buttons: ['b6'], stick: null });
        one.read(pad([], 0, 1), 'remote');
        expect(one.read(pad([12], 1, 1), 'remote')).toEqual({ buttons: ['up'], stick: { x: 1, y: -0 } });
    }
});

test('a keyboard that the browser lists as a pad does not take the place of a real one; a pad of another layout is better than none', () => {
    const [keyboard, real] = [{ mapping: '' as const }, { mapping: 'standard' as const }];
    expect(padOf([null, keyboard, real])).toBe(real);
    expect(padOf([null, keyboard])).toBe(keyboard);
    expect(padOf([null])).toBeNull();
});

test.each(['steps', 'curves', 'pages', 'links', 'checks', 'terminal'] as const)(
    'a stick that is nudged while somebody edits or types (%s) does not drive; the button that stops does',
    tab => {
        const one = new GamePad();
        one.read(pad([]), 'remote');
        expect(one.read(pad([12], 1), tab)).toEqual(NOTHING);
        expect(one.read(pad([0]), tab)).toEqual({ buttons: ['b6'], stick: null });
        expect(one.read(pad([], 1), 'remote')).toEqual(NOTHING); // not yet let go
        one.read(pad([]), 'remote');
        expect(one.read(pad([], 1), 'robot')).toEqual({ buttons: [], stick: { x: 1, y: -0 } });
    },
);
