// SPDX-License-Identifier: MIT
// A double click on a button that plays a motion is one click.
import { expect, test, vi } from 'vitest';
import { once } from '../view/element.ts';

const click = (detail: number): Event => Object.assign(new Event('click'), { detail });

test('the second click of a double click does nothing; the next click and a key do', () => {
    const play = vi.fn();
    const pressed = once(play);
    for (const detail of [1, 2]) pressed(click(detail));
    expect(play).toHaveBeenCalledTimes(1);
    pressed(click(1));
    pressed(click(0)); // Enter
    expect(play).toHaveBeenCalledTimes(3);
});
