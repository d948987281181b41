// SPDX-License-Identifier: MIT
// What the page is told of a robot, many times a second: the same for the simulated one and for yours.

import type { Place } from '../model/space.ts';

export interface ServoState {
    readonly id: number;
    /** Servo units; null when it is not known (a limp servo of yours has no goal that we could read). */
    readonly goalPos: number | null;
    readonly position: number;
    readonly torque: boolean;
    /** Error bits of protocol 1.0: 0 voltage, 1 angle limit, 2 heat, 3 range, 4 checksum, 5 overload, 6 instruction. */
    readonly alarms: number;
    readonly celsius: number;
    /** Bit per simulated fault that is on. */
    readonly faults: number;
}

export interface RobotState {
    /** Time of the robot in ticks of 1/128 s since it was made. */
    readonly ticks: number;
    readonly servos: readonly ServoState[];
    /** Where the trunk is. */
    readonly trunk: Place;
    /** Bit n: power, txd, rxd, aux, manage, program, play. */
    readonly leds: number;
    readonly isPowered: boolean;
    /** A hand holds it upright (simulated). */
    readonly isHeld: boolean;
    readonly hasFallen: boolean;
    /** How far behind the wall clock the simulation is. */
    readonly lateMs: number;
    /** Goal and position of every servo at every tick since the state before: pairs, in order of the servos. */
    readonly trace: Float32Array;
}
