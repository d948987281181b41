// SPDX-License-Identifier: MIT
// The arrows that turn the chosen joints: a key that is held is one undo step, and turns from the pose in which it was pressed.

import type { Body } from '../../model/body.ts';
import type { MotionDocument } from '../../model/document.ts';
import type { Result } from '../../model/result.ts';
import type { Transaction } from '../../model/transaction.ts';
import type { Editor, Gesture } from '../session/editor.ts';
import { changedBy } from './editing.ts';

/** The edit that gives the chosen step these positions (servo units by ID). */
export type PositionsEdit = (start: MotionDocument, positions: ReadonlyMap<number, number>) => Result<Transaction>;

interface Held {
    readonly gesture: Gesture;
    readonly pose: readonly number[];
    units: number;
}

export class JointTurn {
    private readonly editor: Editor;
    private readonly body: Body;
    private readonly edit: PositionsEdit;
    private held: Held | null = null;

    constructor(editor: Editor, body: Body, edit: PositionsEdit) {
        this.editor = editor;
        this.body = body;
        this.edit = edit;
    }

    get isHeld(): boolean {
        return this.held !== null;
    }

    /** The key goes down, or repeats itself. pose: servo units by ID, asked for once. */
    turn(units: number, pose: () => readonly number[]): void {
        this.held ??= { gesture: this.editor.gesture('set-joints'), pose: pose(), units: 0 };
        const held = this.held;
        held.units += units;
        held.gesture.change(this.edit(held.gesture.start, changedBy(this.body, this.editor.state.get().joints, held.pose, held.units)));
    }

    /** The key was let go. keep: false takes back what it turned. */
    end(keep: boolean): void {
        if (keep) this.held?.gesture.finish();
        else this.held?.gesture.cancel();
        this.held = null;
    }
}
