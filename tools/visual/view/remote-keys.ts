// SPDX-License-Identifier: MIT
// The keyboard as a remote: which key is which button.

import { isMoving } from '../robot/protocol.ts';
import type { Where } from '../robot/protocol.ts';
import type { RemoteButton } from '../robot/remote.ts';

const KEYS: Readonly<Record<string, RemoteButton>> = {
    ArrowUp: 'up',
    ArrowDown: 'down',
    ArrowLeft: 'left',
    ArrowRight: 'right',
    KeyW: 'up',
    KeyS: 'down',
    KeyA: 'left',
    KeyD: 'right',
    Digit1: 'b1',
    Digit2: 'b2',
    Digit3: 'b3',
    Digit4: 'b4',
    Digit5: 'b5',
    Digit6: 'b6',
    Numpad1: 'b1',
    Numpad2: 'b2',
    Numpad3: 'b3',
    Numpad4: 'b4',
    Numpad5: 'b5',
    Numpad6: 'b6',
    Space: 'b6',
};

type Key = Pick<KeyboardEvent, 'type' | 'code' | 'ctrlKey' | 'altKey' | 'metaKey' | 'shiftKey'>;

/** undefined: the key is not for the remote: with Shift it moves the camera, with the others it is the browser's. A key that is released
 *  counts whatever else is held, or the robot would walk on when Ctrl was pressed meanwhile; but only if the remote has it, or the space bar
 *  would press no button of the page. */
export function buttonOf(key: Key, held: ReadonlySet<RemoteButton>): RemoteButton | undefined {
    const button = KEYS[key.code];
    if (key.type === 'keyup') return button && held.has(button) ? button : undefined;
    return key.ctrlKey || key.altKey || key.metaKey || key.shiftKey ? undefined : button;
}

/** A key that is pressed is for what has the focus: letters for a field, arrows for a slider, the space bar for a button. But the space bar
 *  stops a robot that moves, whatever has the focus, except a field. */
export function isForFocus(code: string, focus: Pick<Element, 'closest'> | null, where: Where | null): boolean {
    const isAt = (selectors: string): boolean => focus !== null && focus.closest(selectors) !== null;
    if (isAt('input:not([type="range"]), textarea, terminal-pane')) return true;
    if (code === 'Space' && isMoving(where)) return false;
    if (isAt('select, summary, [role="tablist"]')) return true;
    return code === 'Space' ? isAt('button') : code.startsWith('Arrow') && isAt('input');
}
