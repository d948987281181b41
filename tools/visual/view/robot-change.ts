// SPDX-License-Identifier: MIT
// Detects whether the picture of a robot would look different. The simulated robot reports 60 times a second, and its servos tremble while
// they hold.

import type { RobotState } from '../robot/robot-state.ts';

/** Smaller changes are invisible: a fifteenth of a servo unit (0.02 degrees), 0.05 mm, and of the trunk 0.01 degrees. If all joints of a
 *  leg turn by that much, the head moves by 0.3 mm, which is less than half a pixel. A holding servo trembles by less. It is compared with
 *  what is shown, so that what creeps is drawn. */
const SEEN = { units: 1 / 15, m: 5e-5, ofQuaternion: 1e-4 };

/** before: as it is shown. hasLamps: the board's LEDs are in the picture. */
export function looksDifferent(before: RobotState | null, now: RobotState | null, hasLamps: boolean): boolean {
    if (!before || !now) return before !== now;
    if (hasLamps && before.leds !== now.leds) return true;
    if (differ(before.trunk.pos, now.trunk.pos, SEEN.m) || differ(before.trunk.quat, now.trunk.quat, SEEN.ofQuaternion)) return true;
    if (before.servos.length !== now.servos.length) return true;
    return now.servos.some((servo, i) => {
        const was = before.servos[i];
        if (was?.id !== servo.id || was.alarms !== servo.alarms || was.isSilent !== servo.isSilent) return true;
        if (was.goalPos !== servo.goalPos || was.torque !== servo.torque) return true; // the pose of a page without steps
        return Math.abs(was.position - servo.position) > SEEN.units;
    });
}

function differ(a: readonly number[], b: readonly number[], seen: number): boolean {
    return a.some((value, i) => Math.abs(value - (b[i] ?? 0)) > seen);
}
