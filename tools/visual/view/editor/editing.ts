// SPDX-License-Identifier: MIT
// State shared by the editor's areas apart from the document: how the picture is used, and poses of the robot and the chosen step. Not part
// of the history.

import { anglesOf, jointAngle, nearestPosition } from '../../model/body.ts';
import type { Angles, Body, Side } from '../../model/body.ts';
import { JOINTS } from '../../model/motion.ts';
import { BYTE_MAX } from '../../model/page.ts';
import type { Step } from '../../model/page.ts';
import type { RobotState } from '../../robot/robot-state.ts';
import type { SessionState, Tab } from '../session/session.ts';
import type { Editor } from '../session/editor.ts';

/** What a drag in the picture does. pose: changes the chosen step; hand: pulls the robot. */
export type PictureMode = 'pose' | 'hand';

export interface Editing {
    readonly mode: PictureMode;
    readonly keep: Side | 'lower';
    /** A dragged foot keeps its sole parallel to the floor. */
    readonly soleFlat: boolean;
    readonly onionSkin: boolean;
    readonly balance: boolean;
    /** The robot moves to the chosen step. */
    readonly follow: boolean;
    /** Servos being taught. They are limp, but a limb of the simulated robot holds after the mouse lets go of it. */
    readonly taught: ReadonlySet<number>;
}

export const EDITING_START: Editing = {
    mode: 'pose',
    keep: 'lower',
    soleFlat: true,
    onionSkin: false,
    balance: true,
    follow: false,
    taught: new Set(),
};

/** Areas that edit a step, which the picture then shows. */
const EDITING_TABS: ReadonlySet<Tab> = new Set<Tab>(['steps', 'curves']);

export function isEditing(tab: Tab): boolean {
    return EDITING_TABS.has(tab);
}

/** Servos still being taught: without those that were limp and have torque again. Play switches on the torque of servos it moves. */
export function stillTaught(taught: ReadonlySet<number>, wereLimp: readonly number[], areLimp: readonly number[]): ReadonlySet<number> {
    return new Set([...taught].filter(servo => areLimp.includes(servo) || !wereLimp.includes(servo)));
}

/** Whether the last pose is still the robot's. One whose cable is pulled may have been moved. */
export function isPoseKnown(source: SessionState['source'], connection: SessionState['connection']): boolean {
    return source === 'simulated' || connection === 'ready';
}

export function stepAngles(editor: Editor, body: Body, page: number, step: number): Angles {
    return anglesOf(body, editor.poseAfter(page, step), new Map());
}

export function robotAngles(body: Body, robot: RobotState): Angles {
    const positions = new Map(robot.servos.map(servo => [servo.id, servo.position]));
    return new Map(body.joints.map(joint => [joint.servo, jointAngle(joint, positions.get(joint.servo) ?? joint.zero)]));
}

/** The robot's pose (servo units by ID; null: no such servo, or it does not answer). For a joint with torque it is the goal, not the
 *  position under load. */
export function robotPositions(robot: RobotState): (number | null)[] {
    const positions = new Array<number | null>(JOINTS).fill(null);
    for (const servo of robot.servos)
        if (!servo.isSilent) positions[servo.id] = Math.round((servo.torque ? servo.goalPos : null) ?? servo.position);
    return positions;
}

/** New positions of the joints whose rounded positions differ (servo units by ID). */
export function changedPositions(body: Body, before: Angles, after: Angles): Map<number, number> {
    return new Map(
        body.joints.flatMap(joint => {
            const [was, is] = [nearestPosition(joint, before.get(joint.servo) ?? 0), nearestPosition(joint, after.get(joint.servo) ?? 0)];
            return was === is ? [] : [[joint.servo, is] as const];
        }),
    );
}

const SAFE_UNITS_PER_TICK = 2.5;
const LEAST_TIME = 48;

/** Time of a step (ticks at nominal speed) long enough for every joint to move slowly from the previous pose; at most 255. */
export function easyTime(from: readonly (number | null)[], to: readonly (number | null)[]): number {
    const distances = to.map((position, id) => Math.abs((position ?? 0) - (from[id] ?? position ?? 0)));
    return Math.min(BYTE_MAX, Math.max(LEAST_TIME, Math.ceil(Math.max(...distances) / SAFE_UNITS_PER_TICK)));
}

/** A step with these positions, timed by easyTime(). */
export function easyStep(positions: readonly (number | null)[], before: readonly (number | null)[]): Step {
    return { positions, time: easyTime(before, positions), pause: 0 };
}

/** Positions of the chosen joints turned by `by` servo units from `pose` (by ID), within their limits. */
export function changedBy(body: Body, joints: ReadonlySet<number>, pose: readonly number[], by: number): Map<number, number> {
    return new Map(
        body.joints
            .filter(joint => joints.has(joint.servo))
            .map(joint => [joint.servo, nearestPosition(joint, jointAngle(joint, (pose[joint.servo] ?? joint.zero) + by))] as const),
    );
}
