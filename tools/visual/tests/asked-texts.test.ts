// SPDX-License-Identifier: MIT
// What a dialog takes. Where it takes nothing, it stays open and says what it wants.
import { expect, test } from 'vitest';
import { MOTION_NAME, MOTION_NUMBER } from '../view/editor/page-actions.ts';

/** As the browser reads the pattern of a field. */
const takes = (pattern: string, text: string): boolean => new RegExp(`^(?:${pattern})$`, 'v').test(text);

test('the number of a motion: 1 to 127', () => {
    const taken = Array.from({ length: 1000 }, (_, number) => number).filter(number => takes(MOTION_NUMBER, String(number)));
    expect(taken).toEqual(Array.from({ length: 127 }, (_, i) => i + 1));
    expect(takes(MOTION_NUMBER, '007')).toBe(true);
    for (const text of ['', 'abc', '1.5', '-3', '000']) expect(takes(MOTION_NUMBER, text)).toBe(false);
});

test('the name of a motion: blanks are no name, as nothing is none', () => {
    for (const name of ['wave', ' wave hello ', '~!', 'x']) expect(takes(MOTION_NAME, name)).toBe(true);
    for (const name of [' ', '   ', 'über', 'a\tb']) expect(takes(MOTION_NAME, name)).toBe(false);
});
