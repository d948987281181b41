// SPDX-License-Identifier: MIT
// The camera behind a driven robot. It turns with the distance walked, not with time, so that it rests when the robot does.

import type { Place } from '../model/space.ts';

/** Distance after which most of the turn is done. */
const WAY_M = 0.12;
/** Horizontal part of the trunk's forward axis. Below this the robot has fallen and has no heading. */
const LEAST_LEVEL = 0.5;

/** Heading of the robot seen from above (radians, 0: along x); null: it lies. */
export function headingOf({ quat: [w, x, y, z] }: Place): number | null {
    const ahead = [1 - 2 * (y * y + z * z), 2 * (x * y + w * z)] as const;
    return Math.hypot(...ahead) < LEAST_LEVEL ? null : Math.atan2(ahead[1], ahead[0]);
}

/** Turn of the camera around the robot (radians, counterclockwise) after wayM metres. camera: its direction seen from the robot. */
export function chaseTurn(camera: number, heading: number, wayM: number): number {
    const behind = heading + Math.PI - camera;
    return Math.atan2(Math.sin(behind), Math.cos(behind)) * (1 - Math.exp(-wayM / WAY_M));
}
