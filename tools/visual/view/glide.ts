// SPDX-License-Identifier: MIT
// How far something glides towards where it belongs: by the time that has passed, so that it comes to rest as soon on a slow computer as
// on a quick one. Pure.

const FRAME_MS = 1000 / 60;

/** The share of the way (0..1) that is gone in so many milliseconds, by what goes `share` of it in a 60th of a second. */
export function glide(share: number, elapsedMs: number): number {
    return 1 - (1 - share) ** (Math.max(0, elapsedMs) / FRAME_MS);
}
