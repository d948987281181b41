// SPDX-License-Identifier: MIT
// The state of a robot that the page receives many times a second. The same for the simulated robot and yours.

import type { Place } from '../model/space.ts';

export interface ServoState {
    readonly id: number;
    /** Servo units; null if unknown (a real servo's goal is not read). */
    readonly goalPos: number | null;
    readonly position: number;
    /** It does not answer now. Its position is the last one that it told, or the middle. */
    readonly isSilent?: boolean;
    readonly torque: boolean;
    /** Error bits of protocol 1.0: 0 voltage, 1 angle limit, 2 heat, 3 range, 4 checksum, 5 overload, 6 instruction. */
    readonly alarms: number;
    readonly celsius: number;
    /** Bit per active simulated fault. */
    readonly faults: number;
}

export interface RobotState {
    /** Robot time in ticks of 1/128 s since it was made. */
    readonly ticks: number;
    readonly servos: readonly ServoState[];
    /** The trunk's place. */
    readonly trunk: Place;
    /** Bit n: power, txd, rxd, aux, manage, program, play. */
    readonly leds: number;
    readonly isPowered: boolean;
    /** A hand holds it upright (simulated). */
    readonly isHeld: boolean;
    readonly hasFallen: boolean;
    /** Milliseconds that the simulation is behind the wall clock. */
    readonly lateMs: number;
    /** Goal and position of every servo for every tick since the last state: pairs, in the order of the servos. */
    readonly trace: Float32Array;
}
