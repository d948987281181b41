// SPDX-License-Identifier: MIT
// Turns the chosen joints by arrow keys. A held key is one undo step and turns from the pose at its first press.

import type { Body } from '../../model/body.ts';
import type { MotionDocument } from '../../model/document.ts';
import type { Result } from '../../model/result.ts';
import type { Transaction } from '../../model/transaction.ts';
import type { Editor, Gesture } from '../session/editor.ts';
import { changedBy } from './editing.ts';

/** Makes the edit that sets these positions of the chosen step (servo units by ID). */
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

    /** Call on key press and repeat. pose: servo units by ID, called once per held key. */
    turn(units: number, pose: () => readonly number[]): void {
        this.held ??= { gesture: this.editor.gesture('set-joints'), pose: pose(), units: 0 };
        const held = this.held;
        held.units += units;
        held.gesture.change(this.edit(held.gesture.start, changedBy(this.body, this.editor.state.get().joints, held.pose, held.units)));
    }

    /** Call on release. keep: false reverts the turn. */
    end(keep: boolean): void {
        if (keep) this.held?.gesture.finish();
        else this.held?.gesture.cancel();
        this.held = null;
    }
}
