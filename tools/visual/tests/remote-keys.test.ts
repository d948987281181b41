// SPDX-License-Identifier: MIT
// Keys of the remote, pressed and released with others.
import { expect, test } from 'vitest';
import { buttonOf } from '../view/remote-keys.ts';

const NONE = { ctrlKey: false, altKey: false, metaKey: false, shiftKey: false };

test('with Ctrl, Alt, Cmd or Shift a key is not for the remote; released it counts, or the robot would walk on', () => {
    expect(buttonOf({ ...NONE, type: 'keydown', code: 'KeyW' })).toBe('up');
    for (const modifier of ['ctrlKey', 'altKey', 'metaKey', 'shiftKey']) {
        expect(buttonOf({ ...NONE, [modifier]: true, type: 'keydown', code: 'KeyW' })).toBeUndefined();
        expect(buttonOf({ ...NONE, [modifier]: true, type: 'keyup', code: 'KeyW' }), modifier).toBe('up');
    }
    expect(buttonOf({ ...NONE, type: 'keydown', code: 'KeyQ' })).toBeUndefined();
});
