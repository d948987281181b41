// SPDX-License-Identifier: MIT

/** Returns the value, or fails the test if it is missing. */
export function present<T>(value: T | undefined): T {
    if (value === undefined) throw new Error('what the test is about is not there');
    return value;
}
