// SPDX-License-Identifier: MIT
// Keys of the remote, pressed and released with others.
import { expect, test } from 'vitest';
import type { RemoteButton } from '../robot/remote.ts';
import { buttonOf } from '../view/remote-keys.ts';

const NONE = { ctrlKey: false, altKey: false, metaKey: false, shiftKey: false };

const NOTHING = new Set<RemoteButton>();
const HELD = new Set<RemoteButton>(['up', 'b6']);

test('with Ctrl, Alt, Cmd or Shift a key is not for the remote; released it counts, or the robot would walk on', () => {
    expect(buttonOf({ ...NONE, type: 'keydown', code: 'KeyW' }, NOTHING)).toBe('up');
    for (const modifier of ['ctrlKey', 'altKey', 'metaKey', 'shiftKey']) {
        expect(buttonOf({ ...NONE, [modifier]: true, type: 'keydown', code: 'KeyW' }, NOTHING)).toBeUndefined();
        expect(buttonOf({ ...NONE, [modifier]: true, type: 'keyup', code: 'KeyW' }, HELD), modifier).toBe('up');
    }
    expect(buttonOf({ ...NONE, type: 'keydown', code: 'KeyQ' }, NOTHING)).toBeUndefined();
});

test('a key that the remote does not hold is released for the page: the space bar presses the button with the focus', () => {
    expect(buttonOf({ ...NONE, type: 'keyup', code: 'Space' }, NOTHING)).toBeUndefined();
    expect(buttonOf({ ...NONE, type: 'keyup', code: 'Space' }, HELD)).toBe('b6');
});
