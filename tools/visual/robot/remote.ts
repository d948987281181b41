// SPDX-License-Identifier: MIT
// The RC-100 remote control: buttons to packets. Source: remote.md, "Sources of a code".

export const REMOTE_BUTTONS = {
  up: 1, down: 2, left: 4, right: 8, b1: 16, b2: 32, b3: 64, b4: 128, b5: 256, b6: 512,
} as const;
export type RemoteButton = keyof typeof REMOTE_BUTTONS;

function wordOf(held: Iterable<RemoteButton>): number {
  let word = 0;
  for (const button of held) word |= REMOTE_BUTTONS[button];
  return word;
}

/** The code of these buttons; 0 for none, and with buttons 5 or 6, which call no page. */
export function codeOf(held: Iterable<RemoteButton>): number {
  const word = wordOf(held);
  return word > 0xff ? 0 : word;
}

/** FF 55 low ~low high ~high; no button: the packet of letting go. */
export function remotePacket(held: Iterable<RemoteButton>): Uint8Array {
  const word = wordOf(held);
  const low = word & 0xff;
  const high = word >> 8;
  return Uint8Array.of(0xff, 0x55, low, low ^ 0xff, high, high ^ 0xff);
}

/** The buttons of a code, up first; an empty list for 0. */
export function buttonsOf(code: number): RemoteButton[] {
  return (Object.keys(REMOTE_BUTTONS) as RemoteButton[]).filter((button) => code & REMOTE_BUTTONS[button]);
}
