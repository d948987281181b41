// SPDX-License-Identifier: MIT

/** What must be there; a test without it fails here. */
export function present<T>(value: T | undefined): T {
    if (value === undefined) throw new Error('what the test is about is not there');
    return value;
}
