// SPDX-License-Identifier: MIT
// The complete state of the editor as one value: document, history, selection, and the known pages of the robot. Pure.

import { withChanges } from './document.ts';
import type { MotionDocument } from './document.ts';
import { NO_HISTORY, apply, redo, undo } from './history.ts';
import type { Edited, History } from './history.ts';
import type { Law } from './motion.ts';
import type { PageFormat } from './page-format.ts';
import { transaction } from './transaction.ts';
import type { Change, EditName, Transaction } from './transaction.ts';

/** What is displayed. It is not part of the history. Steps 0..6, joints by servo ID. */
export interface Selection {
    readonly page: number;
    /** The cursor: the step that is shown and edited. */
    readonly step: number;
    readonly steps: ReadonlySet<number>;
    readonly joints: ReadonlySet<number>;
    readonly law: Law;
}

/** A gesture under way. It becomes one undo step. */
export interface OpenGesture {
    readonly label: EditName;
    readonly start: MotionDocument;
    readonly changes: readonly Change[];
}

export interface EditorState extends Edited, Selection {
    readonly document: MotionDocument;
    readonly history: History;
    readonly gesture: OpenGesture | null;
    /** The robot's pages as last read, by number; null: not read. Empty if nothing is known of a robot. */
    readonly robot: readonly (Uint8Array | null)[];
}

export const FIRST_PAGE = 1;

export function startState(document: MotionDocument): EditorState {
    return {
        document,
        history: NO_HISTORY,
        gesture: null,
        robot: [],
        page: FIRST_PAGE,
        step: 0,
        steps: new Set([0]),
        joints: new Set(),
        law: 'exact',
    };
}

/** Pages that differ in the robot. Unknown pages do not count, nor does page 0: the trim belongs to the robot. */
export function dirtyPages(state: Pick<EditorState, 'document' | 'robot'>, format: PageFormat): ReadonlySet<number> {
    const dirty = state.robot.flatMap((bytes, page) => {
        const ours = state.document.pages[page];
        return page > 0 && bytes && ours && !format.isSame(bytes, ours) ? [page] : [];
    });
    return new Set(dirty);
}

/** Applies an edit outside a gesture. An open gesture is finished first. */
export function dispatch(state: EditorState, edit: Transaction): EditorState {
    return apply(finishGesture(state), edit);
}

export function undoOne(state: EditorState): EditorState {
    return undo(finishGesture(state));
}

export function redoOne(state: EditorState): EditorState {
    return redo(finishGesture(state));
}

export function beginGesture(state: EditorState, label: EditName): EditorState {
    const ended = finishGesture(state);
    return { ...ended, gesture: { label, start: ended.document, changes: [] } };
}

/** Sets the gesture's current result, relative to its start. It replaces the previous result. */
export function changeGesture(state: EditorState, edit: Transaction): EditorState {
    const { gesture } = state;
    if (!gesture) return state;
    return { ...state, document: withChanges(gesture.start, edit.changes), gesture: { ...gesture, changes: edit.changes } };
}

export function cancelGesture(state: EditorState): EditorState {
    return state.gesture ? { ...state, document: state.gesture.start, gesture: null } : state;
}

export function finishGesture(state: EditorState): EditorState {
    const { gesture } = state;
    if (!gesture) return state;
    return apply({ ...state, document: gesture.start, gesture: null }, transaction(gesture.label, gesture.changes));
}
