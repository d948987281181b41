// SPDX-License-Identifier: MIT
// Keys of the remote: pressed and released with others, and while something else has the focus.
import { expect, test } from 'vitest';
import type { PlayState, Where } from '../robot/protocol.ts';
import type { RemoteButton } from '../robot/remote.ts';
import { buttonOf, isForFocus } from '../view/remote-keys.ts';

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

const where = (state: PlayState, aimed = 0): Where => ({ state, aimed }) as Where;
const STANDS = [null, where('idle'), where('paused')];
const MOVES = [where('playing'), where('approach'), where('ready'), where('idle', 4), where('paused', 4)];

/** What has the focus matches these selectors. */
function at(...matched: string[]): Pick<Element, 'closest'> {
    return { closest: (selectors: string) => (selectors.split(', ').some(one => matched.includes(one)) ? {} : null) as Element | null };
}

const SLIDER = at('input');
const FIELD = at('input', 'input:not([type="range"])');
const LIST = at('select');
const BUTTON = at('button');

test('a robot that moves is stopped by the space bar after the speed was set by a slider or a motion chosen in a list', () => {
    for (const moves of MOVES) {
        for (const focus of [null, SLIDER, LIST, BUTTON, at('button', '[role="tablist"]')])
            expect(isForFocus('Space', focus, moves), JSON.stringify(moves)).toBe(false);
        for (const focus of [FIELD, at('terminal-pane')]) expect(isForFocus('Space', focus, moves)).toBe(true);
    }
    for (const stands of STANDS) for (const focus of [LIST, BUTTON]) expect(isForFocus('Space', focus, stands)).toBe(true);
});

test('a slider has its arrows, and the other keys drive', () => {
    for (const code of ['KeyW', 'Digit6', 'Space']) expect(isForFocus(code, SLIDER, null), code).toBe(false);
    expect(isForFocus('ArrowUp', SLIDER, where('playing'))).toBe(true);
    for (const focus of [FIELD, LIST]) expect(isForFocus('Digit6', focus, where('playing'))).toBe(true);
    for (const focus of [null, BUTTON]) expect(isForFocus('ArrowUp', focus, null)).toBe(false);
});
