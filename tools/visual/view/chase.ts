// SPDX-License-Identifier: MIT
// The camera behind a robot that is driven: it comes round with the way the robot goes, not with time, so that it rests when the robot does.

import type { Place } from '../model/space.ts';

/** Of the way, after which most of the turn is done. */
const WAY_M = 0.12;
/** A trunk that leans more than that (sine towards the floor) goes nowhere: it has fallen. */
const LEAST_LEVEL = 0.5;

/** Where the robot looks, seen from above (radians, 0: along x); null: it lies. */
export function headingOf({ quat: [w, x, y, z] }: Place): number | null {
    const ahead = [1 - 2 * (y * y + z * z), 2 * (x * y + w * z)] as const;
    return Math.hypot(...ahead) < LEAST_LEVEL ? null : Math.atan2(ahead[1], ahead[0]);
}

/** How far the camera goes round (radians, to the left) when the robot has gone so far. camera: where it stands, seen from the robot. */
export function chaseTurn(camera: number, heading: number, wayM: number): number {
    const behind = heading + Math.PI - camera;
    return Math.atan2(Math.sin(behind), Math.cos(behind)) * (1 - Math.exp(-wayM / WAY_M));
}
