// SPDX-License-Identifier: MIT
// Letters that are keys: Caps Lock is no Shift.
import { expect, test } from 'vitest';
import { keyOf } from '../view/key-of.ts';

test('with Caps Lock a letter is the same key, with Shift it is another', () => {
    for (const key of ['m', 'M']) {
        expect(keyOf({ key, shiftKey: false })).toBe('m');
        expect(keyOf({ key, shiftKey: true })).toBe('M');
    }
});

test('other keys have their names', () => {
    for (const key of ['Delete', 'ArrowUp', '+', '?', '1', ' ']) expect(keyOf({ key, shiftKey: false })).toBe(key);
    expect(keyOf({ key: 'Home', shiftKey: true })).toBe('Home');
});
