// SPDX-License-Identifier: MIT
// Interface of the views to the editor: the document and its edits. app/editor.ts implements it.

import type { JointPair } from '../../model/step-edits.ts';
import type { MotionDocument } from '../../model/document.ts';
import type { Edits } from '../../model/edit.ts';
import type { EditorState, Selection } from '../../model/editor-state.ts';
import type { Curve, Law, Shape } from '../../model/motion.ts';
import type { PageFormat } from '../../model/page-format.ts';
import type { PageView } from '../../model/page.ts';
import type { Result } from '../../model/result.ts';
import type { EditName, Transaction } from '../../model/transaction.ts';
import type { Store } from '../store.ts';

/** One drag or one held key: a single undo step. It ends with finish(), cancel(), any other edit, or the choice of another
 *  page or step (by a second finger), which it would change otherwise. */
export interface Gesture {
    /** The document at the start of the gesture. All edits of the gesture are made against it. */
    readonly start: MotionDocument;
    /** Sets the gesture's edit, in place of the previous one. false: nothing changed; a refusal is reported to the user. */
    change(edit: Result<Transaction>): boolean;
    finish(): void;
    cancel(): void;
}

export interface CurveOptions {
    /** Default: the selected one. */
    readonly law?: Law;
    /** Remote code that calls the page; 0: called by number. */
    readonly code?: number;
    /** Most ticks of 1/128 s. Default: 4096. */
    readonly ticks?: number;
    /** Pose before the play (31 servo units). Default: the page's first pose. */
    readonly from?: ArrayLike<number>;
    /** Default: as stored. */
    readonly shape?: Shape;
}

export interface Editor {
    readonly state: Store<EditorState>;
    readonly format: PageFormat;
    readonly edits: Edits;
    /** Joints that mirror each other, by servo ID. */
    readonly pairs: readonly JointPair[];

    /** A page of the current document, parsed once per version. */
    page(page: number): PageView;
    /** The page is identical to one of the factory library. */
    isOfLibrary(page: number): boolean;
    /** Applies an edit made against `state.get().document`. false: refused; nothing has changed and the status bar says why. */
    dispatch(edit: Result<Transaction>): boolean;
    gesture(label: EditName): Gesture;
    undo(): void;
    redo(): void;
    /** Changes cursor and selection; absent values stay. */
    select(change: Partial<Selection>): void;
    /** The firmware player's output for a page of the document; null: the page is damaged or has no action. */
    curve(page: number, options?: CurveOptions): Curve | null;
    /** Pose in which a play of the page begins (31 servo units). Joints that its first step does not use are as in `from`; default: at 512.
     *  shape: default as stored. */
    firstPose(page: number, shape?: Shape, from?: ArrayLike<number>): Uint16Array;
    /** Pose in which the robot in the page stands (31 servo units). */
    readonly standingPose: readonly number[];
    /** Pose after a step (31 servo units). Joints that the step does not use stay as earlier steps left them. */
    poseAfter(page: number, step: number): number[];
    /** Highest speed that servos may be commanded at this voltage (servo units per tick). */
    topSpeed(volts: number): number;
}
