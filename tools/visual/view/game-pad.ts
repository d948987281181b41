// SPDX-License-Identifier: MIT
// A gamepad as a remote: its buttons, and its stick, which drives.

import type { RemoteButton } from '../robot/remote.ts';
import type { Tab } from './session/session.ts';

/** Button indexes of the standard gamepad layout: directions at 12..15, face buttons at 0..3, left shoulder at 4, start at 9. */
const BUTTONS: readonly (readonly [number, RemoteButton])[] = [
    [12, 'up'],
    [13, 'down'],
    [14, 'left'],
    [15, 'right'],
    [0, 'b6'],
    [1, 'b2'],
    [2, 'b3'],
    [3, 'b4'],
    [4, 'b1'],
    [9, 'b5'],
];
const STICK_REST = 0.25;
/** Areas where nobody edits or types: there a stick that is nudged would move the robot by surprise. */
const DRIVES: readonly Tab[] = ['remote', 'robot'];

export interface PadInput {
    readonly buttons: readonly RemoteButton[];
    /** x to the right, y ahead; null: released. */
    readonly stick: { readonly x: number; readonly y: number } | null;
}

/** The pad with the layout that is read here; without one, the first. To some browsers a keyboard or a mouse is a pad, too. */
export function padOf<P extends Pick<Gamepad, 'mapping'>>(pads: readonly (P | null)[]): P | null {
    return pads.find(pad => pad?.mapping === 'standard') ?? pads.find(pad => pad !== null) ?? null;
}

type Pad = Pick<Gamepad, 'axes' | 'index'> & { readonly buttons: readonly Pick<GamepadButton, 'pressed'>[] };

export class GamePad {
    /** What was pushed while the pad was for something else drives only when all was let go. */
    private mustRest = false;
    /** A wheel or a worn stick may have no rest where it is expected, and would drive as soon as the browser shows it. */
    private canRest = false;
    private index: number | null = null;

    /** pad: null if there is none. tab: the open area; null: the pad is for a dialog or for another window. */
    read(pad: Pad | null, tab: Tab | null): PadInput {
        if (pad !== null && this.index !== null && pad.index !== this.index) this.mustRest = true; // it takes another one's place
        if (pad?.index !== this.index) this.canRest = false;
        this.index = pad?.index ?? null;
        const drives = tab !== null && DRIVES.includes(tab); // otherwise it only stops the robot
        const [x = 0, y = 0] = pad?.axes ?? [];
        const buttons = BUTTONS.filter(([index]) => pad?.buttons[index]?.pressed).map(([, name]) => name);
        const isAtRest = Math.hypot(x, y) < STICK_REST;
        this.canRest = pad !== null && (this.canRest || isAtRest);
        const stick = isAtRest || !this.canRest ? null : { x, y: -y };
        this.mustRest = (buttons.length > 0 || stick !== null) && (this.mustRest || !drives);
        return this.mustRest ? { buttons: buttons.filter(name => name === 'b6'), stick: null } : { buttons, stick };
    }
}
