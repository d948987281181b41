// SPDX-License-Identifier: MIT
// Smooth motion towards a target. It depends on elapsed time, not on frames, so it takes equally long on slow and fast computers.

const FRAME_MS = 1000 / 60;

/** Share of the remaining distance (0..1) covered in elapsedMs, if `share` of it is covered per 1/60 s. */
export function glide(share: number, elapsedMs: number): number {
    return 1 - (1 - share) ** (Math.max(0, elapsedMs) / FRAME_MS);
}
