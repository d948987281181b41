// SPDX-License-Identifier: MIT
// The edited pose: the joints after the chosen step, and where the figure stands with them. A page without steps has the robot's pose.

import { lowerFoot, trunkOn } from '../../model/balance.ts';
import { angleIn, placeLinks } from '../../model/body.ts';
import type { Angles, Body, Side } from '../../model/body.ts';
import { JOINTS, POSITION_MIDDLE } from '../../model/motion.ts';
import type { Stance } from '../../model/pose-drag.ts';
import type { Place } from '../../model/space.ts';
import type { RobotState } from '../../robot/robot-state.ts';
import type { Editor } from '../session/editor.ts';
import type { Store } from '../store.ts';
import { robotAngles, robotPositions, stepAngles } from './editing.ts';
import type { Editing } from './editing.ts';
import type { Posed } from './pose-layer.ts';

const HERE: Place = { pos: [0, 0, 0], quat: [1, 0, 0, 0] };

export class EditedPose {
    private readonly editor: Editor;
    private readonly body: Body;
    private readonly editing: Store<Editing>;
    robot: RobotState | null = null;

    constructor(editor: Editor, body: Body, editing: Store<Editing>) {
        this.editor = editor;
        this.body = body;
        this.editing = editing;
    }

    get angles(): Angles {
        const { page, step } = this.editor.state.get();
        if (this.isEmpty && this.robot) return robotAngles(this.body, this.robot);
        return stepAngles(this.editor, this.body, page, step);
    }

    /** Servo units by ID. */
    get positions(): number[] {
        const { page, step } = this.editor.state.get();
        const pose = this.editor.poseAfter(page, step);
        if (!this.isEmpty || !this.robot) return pose;
        return robotPositions(this.robot).map((position, id) => position ?? pose[id] ?? 0);
    }

    /** The foot on which the figure stands, at the place of the robot's foot. */
    stance(angles: Angles): Stance {
        const { keep } = this.editing.get();
        const foot = keep === 'lower' ? lowerFoot(this.body, angles) : keep;
        return { keep: foot, at: this.feet()[foot] };
    }

    /** The figure with these angles, standing on the foot of the stance. */
    posed(angles: Angles, stance: Stance): Posed {
        return { trunk: trunkOn(this.body, stance.keep, angles, stance.at), angles };
    }

    /** The figure after a step of the page, on that pose's own foot; null: no such step. */
    atStep(at: number): Posed | null {
        const { page } = this.editor.state.get();
        if (at < 0 || at >= this.editor.page(page).steps.length) return null;
        const angles = stepAngles(this.editor, this.body, page, at);
        return this.posed(angles, this.stance(angles));
    }

    private get isEmpty(): boolean {
        return this.editor.page(this.editor.state.get().page).steps.length === 0;
    }

    /** Places of the robot's feet, on which the edited step stands too. */
    private feet(): Record<Side, Place> {
        const { robot } = this;
        const places = robot ? placeLinks(this.body, robot.trunk, angleIn(robotAngles(this.body, robot))) : null;
        return { right: places?.get('right_foot') ?? HERE, left: places?.get('left_foot') ?? HERE };
    }
}

/** The robot's measured pose (servo units by ID). */
export function robotPose(robot: RobotState): number[] {
    const pose = new Array<number>(JOINTS).fill(POSITION_MIDDLE);
    for (const { id, position } of robot.servos) pose[id] = Math.round(position);
    return pose;
}
