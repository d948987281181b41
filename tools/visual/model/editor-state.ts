// SPDX-License-Identifier: MIT
// The one value of the editor: document, history, selection, and what is known of the robot's pages. Pure.

import { withChanges } from './document.ts';
import type { MotionDocument } from './document.ts';
import { NO_HISTORY, apply, redo, undo } from './history.ts';
import type { Edited, History } from './history.ts';
import type { Law } from './motion.ts';
import type { PageFormat } from './page-format.ts';
import { transaction } from './transaction.ts';
import type { Change, EditName, Transaction } from './transaction.ts';

/** What is looked at; never in the history. Steps 0..6, joints by servo ID. */
export interface Selection {
    readonly page: number;
    /** The cursor: the step that is shown and edited. */
    readonly step: number;
    readonly steps: ReadonlySet<number>;
    readonly joints: ReadonlySet<number>;
    readonly law: Law;
}

/** A gesture under way: one undo step, from its beginning to its end. */
export interface OpenGesture {
    readonly label: EditName;
    readonly start: MotionDocument;
    readonly changes: readonly Change[];
}

export interface EditorState extends Edited, Selection {
    readonly document: MotionDocument;
    readonly history: History;
    readonly gesture: OpenGesture | null;
    /** The robot's pages as they were heard last, by number; null: not read. Empty: nothing is known of a robot. */
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

/** Pages that the robot has otherwise; those of which nothing is known do not count, nor does page 0: the trim belongs to the robot. */
export function dirtyPages(state: Pick<EditorState, 'document' | 'robot'>, format: PageFormat): ReadonlySet<number> {
    const dirty = state.robot.flatMap((bytes, page) => {
        const ours = state.document.pages[page];
        return page > 0 && bytes && ours && !format.isSame(bytes, ours) ? [page] : [];
    });
    return new Set(dirty);
}

/** An edit outside a gesture; a gesture under way is ended before it. */
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

/** What the gesture amounts to now, made against its start; it replaces what it amounted to before. */
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
