// SPDX-License-Identifier: MIT
// The key of an event, whether Caps Lock is on or not.

/** A letter is small, with Shift a capital; every other key has its name. */
export function keyOf({ key, shiftKey }: Pick<KeyboardEvent, 'key' | 'shiftKey'>): string {
    if (key.length > 1) return key;
    return shiftKey ? key.toUpperCase() : key.toLowerCase();
}
