// SPDX-License-Identifier: MIT
// Runs board, servos and body together, tick by tick, and reports their state. Uses no worker and no wall clock.

import { jointAngle } from '../model/body.ts';
import type { Body, Joint } from '../model/body.ts';
import type { RobotState } from '../robot/robot-state.ts';
import { CYCLES_PER_TICK } from './board.ts';
import type { Board, ServoReading } from './board.ts';
import type { Floor, Grip } from './messages.ts';
import type { PhysicalBody } from './physical-body.ts';
import { Standing } from './standing.ts';

const TRACE_LIMIT = 512; // ticks; a page that asks rarely gets only the newest

export class Simulation {
    readonly board: Board;
    private readonly body: Body;
    private readonly standing: Standing;
    private readonly joints: ReadonlyMap<number, Joint>;
    private physical: PhysicalBody | null = null;
    private readings: ServoReading[];
    private trace: number[] = [];
    private gripTicks = Infinity;
    private floor: Floor = { tiltFront: 0, tiltLeft: 0, friction: 0.8 };

    constructor(board: Board, body: Body) {
        this.board = board;
        this.body = body;
        this.standing = new Standing(body);
        this.joints = new Map(body.joints.map(joint => [joint.servo, joint]));
        this.readings = board.servos();
    }

    /** Gives the robot a body with mass that can fall. It stands as its joints are. held: a hand holds it until setHeld(false). */
    setPhysical(physical: PhysicalBody, held = true): void {
        this.physical = physical;
        physical.begin(servo => this.angle(servo), this.body);
        physical.setFloor(this.floor);
        if (held) physical.setHeld(true);
        this.board.setBody(physical);
    }

    get hasFallen(): boolean {
        return this.physical?.hasFallen ?? false;
    }

    get hasPhysics(): boolean {
        return this.physical !== null;
    }

    /** Runs to this cycle in whole ticks. false: a violation stopped the board. */
    runTo(cycle: number): boolean {
        let next = Math.floor(this.board.nowCycles / CYCLES_PER_TICK + 1) * CYCLES_PER_TICK;
        for (; next <= cycle; next += CYCLES_PER_TICK) {
            if (!this.board.runTo(next)) return false;
            this.note();
        }
        return true;
    }

    runTick(): boolean {
        return this.runTo(this.board.nowCycles + CYCLES_PER_TICK);
    }

    /** ticks: how long the hand pulls; by default until the next grip. */
    setGrip(grip: Grip | null, ticks = Infinity): void {
        this.gripTicks = ticks;
        this.physical?.setGrip(grip);
    }

    setHeld(held: boolean): void {
        this.physical?.setHeld(held);
    }

    setFloor(floor: Floor): void {
        this.floor = floor;
        this.physical?.setFloor(floor);
    }

    setFault(servo: number, fault: number, answers: number): void {
        const index = this.readings.findIndex(reading => reading.id === servo);
        if (index >= 0) this.board.setFault(index, fault, answers);
    }

    /** The complete state. Clears the trace. */
    state(lateMs: number): RobotState {
        const trace = Float32Array.from(this.trace);
        this.trace = [];
        return {
            ticks: Math.floor(this.board.nowCycles / CYCLES_PER_TICK),
            servos: this.readings.map(({ id, goalPos, position, torque, alarms, celsius, faults }) => ({
                id,
                goalPos,
                position,
                torque,
                alarms,
                celsius,
                faults,
            })),
            trunk: this.physical ? this.physical.trunk : this.standing.move(joint => this.angle(joint.servo)),
            leds: this.board.leds,
            isPowered: this.board.isPowered,
            isHeld: this.physical?.held ?? false,
            hasFallen: this.physical?.hasFallen ?? false,
            lateMs,
            trace,
        };
    }

    private angle(servo: number): number {
        const joint = this.joints.get(servo);
        const reading = this.readings.find(one => one.id === servo);
        return joint && reading ? jointAngle(joint, reading.position) : 0;
    }

    private note(): void {
        if (--this.gripTicks === 0) this.physical?.setGrip(null);
        this.readings = this.board.servos();
        for (const { goalPos, position } of this.readings) this.trace.push(goalPos, position);
        const limit = TRACE_LIMIT * 2 * this.readings.length;
        if (this.trace.length > limit) this.trace.splice(0, this.trace.length - limit);
    }
}
