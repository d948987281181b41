// SPDX-License-Identifier: MIT
// The editor as the views see it: the document and its edits, and what may be done with them. app/editor.ts is behind it.

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

/** One drag or one key held: one undo step. It ends by finish() or cancel(), or by any edit outside it. */
export interface Gesture {
    /** The document as it was when the gesture began: edits are made against it, never against what they changed. */
    readonly start: MotionDocument;
    /** What the gesture amounts to now; replaces what it amounted to before. false: refused and said, nothing changed. */
    change(edit: Result<Transaction>): boolean;
    finish(): void;
    cancel(): void;
}

export interface CurveOptions {
    /** The selected one, unless it is given. */
    readonly law?: Law;
    /** The code that calls it; 0: by number. */
    readonly code?: number;
    /** At most so many ticks of 1/128 s, 4096 unless given. */
    readonly ticks?: number;
    /** Where the joints stand before (31 servo units); the page's first pose unless given. */
    readonly from?: ArrayLike<number>;
    /** As stored, unless it is given. */
    readonly shape?: Shape;
}

export interface Editor {
    readonly state: Store<EditorState>;
    readonly format: PageFormat;
    readonly edits: Edits;
    /** Joints that mirror each other, by servo ID. */
    readonly pairs: readonly JointPair[];

    /** A page of the document as it is now, read once for each of its versions. */
    page(page: number): PageView;
    /** The page is as the robot came with it. */
    isOfLibrary(page: number): boolean;
    /** Does an edit that was made against `state.get().document`. false: refused; the status bar says why, and nothing has changed. */
    dispatch(edit: Result<Transaction>): boolean;
    gesture(label: EditName): Gesture;
    undo(): void;
    redo(): void;
    /** Moves the cursor and what is chosen; values that are not there are left out. */
    select(change: Partial<Selection>): void;
    /** What the firmware's player makes of a page of the document; null: it is damaged or has no action. */
    curve(page: number, options?: CurveOptions): Curve | null;
    /** Pose in which a play of the page begins (31 servo units); joints that its first step does not use stand at 512. As stored,
     *  unless a shape is given. */
    firstPose(page: number, shape?: Shape): Uint16Array;
    /** Where the page leaves the joints behind a step (31 servo units): those that it does not use stay as the steps before left them. */
    poseAfter(page: number, step: number): number[];
    /** The fastest that servos may be asked to go at this voltage (servo units a tick). */
    topSpeed(volts: number): number;
}
