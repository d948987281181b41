// SPDX-License-Identifier: MIT
// Edits of the chosen step's joints, for the picture and the number fields.

import { limbTo } from '../../model/ik.ts';
import type { Body } from '../../model/body.ts';
import { pageOf } from '../../model/document.ts';
import type { MotionDocument } from '../../model/document.ts';
import { JOINTS } from '../../model/motion.ts';
import { readPage } from '../../model/page.ts';
import type { Part } from '../../model/pose-drag.ts';
import type { Result } from '../../model/result.ts';
import type { Transaction } from '../../model/transaction.ts';
import type { RobotState } from '../../robot/robot-state.ts';
import type { Editor } from '../session/editor.ts';
import { easyStep, robotPositions } from './editing.ts';

/** Servo IDs of the joints that a drag of this part moves. */
export function jointsOfPart(body: Body, part: Part): number[] {
    const limb = (link: string): number[] => limbTo(body, link, [0, 0, 0]).links.flatMap(({ joint }) => (joint ? [joint.servo] : []));
    switch (part.kind) {
        case 'joint':
            return [part.joint.servo];
        case 'hand':
            return limb(`${part.side}_forearm`);
        case 'foot':
            return limb(`${part.side}_foot`);
        case 'trunk':
            return [...limb('right_foot'), ...limb('left_foot')];
        default:
            return part satisfies never;
    }
}

/** Sets positions of the chosen step (servo units by ID). A page without steps gets a first step: the robot's pose with these positions. */
export function changeStep(
    editor: Editor,
    start: MotionDocument,
    positions: ReadonlyMap<number, number>,
    robot: RobotState | null,
): Result<Transaction> {
    const { page, step } = editor.state.get();
    if (!isWithoutSteps(editor, start, page)) return editor.edits.setJoints(start, page, [step], positions);
    const pose = robot ? robotPositions(robot) : new Array<number | null>(JOINTS).fill(null);
    for (const [id, position] of positions) pose[id] = position;
    return editor.edits.insertSteps(start, page, 0, [easyStep(pose, pose)]);
}

function isWithoutSteps(editor: Editor, start: MotionDocument, page: number): boolean {
    return readPage(editor.format, pageOf(start, page)).steps.length === 0;
}
