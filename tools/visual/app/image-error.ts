// SPDX-License-Identifier: MIT
// Why an image for the robot could not be had.

import { RobotError } from '../robot/robot-error.ts';

/** The host has the file no more: a newer version of the page has replaced it. */
export class FileGone extends Error {}

/** My servos name what is wrong themselves. */
export function imageError(cause: unknown): RobotError {
    if (cause instanceof RobotError) return cause;
    return new RobotError(cause instanceof FileGone ? 'new-version' : 'no-image', '', { cause });
}
