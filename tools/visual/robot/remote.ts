// SPDX-License-Identifier: MIT
// The RC-100 remote control: turns buttons into packets. hal/remote.c decodes them and decides which code they give
// (PageFormat.remoteCode).

import * as facts from '../model/facts.ts';

export const REMOTE_BUTTONS = {
    up: facts.REMOTE_UP,
    down: facts.REMOTE_DOWN,
    left: facts.REMOTE_LEFT,
    right: facts.REMOTE_RIGHT,
    b1: facts.REMOTE_BUTTON1,
    b2: facts.REMOTE_BUTTON2,
    b3: facts.REMOTE_BUTTON3,
    b4: facts.REMOTE_BUTTON4,
    b5: facts.REMOTE_BUTTON5,
    b6: facts.REMOTE_BUTTON6,
} as const;
export type RemoteButton = keyof typeof REMOTE_BUTTONS;

/** The word H:L of a packet. */
export function wordOf(held: Iterable<RemoteButton>): number {
    let word = 0;
    for (const button of held) word |= REMOTE_BUTTONS[button];
    return word;
}

/** FF 55 low ~low high ~high. Without buttons it is the release packet. */
export function remotePacket(held: Iterable<RemoteButton>): Uint8Array {
    const word = wordOf(held);
    const low = word & 0xff;
    const high = word >> 8;
    return Uint8Array.of(0xff, 0x55, low, low ^ 0xff, high, high ^ 0xff);
}

/** The buttons of a code, up first. Empty for 0. */
export function buttonsOf(code: number): RemoteButton[] {
    return (Object.keys(REMOTE_BUTTONS) as RemoteButton[]).filter(button => code & REMOTE_BUTTONS[button]);
}
