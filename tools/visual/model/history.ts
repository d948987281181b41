// SPDX-License-Identifier: MIT
// Undo and redo: two lists of transactions, the newest last. Nothing limits their length.

import { withChanges } from './document.ts';
import type { MotionDocument } from './document.ts';
import { inverse } from './transaction.ts';
import type { Transaction } from './transaction.ts';

export interface History {
    readonly done: readonly Transaction[];
    readonly undone: readonly Transaction[];
}

export const NO_HISTORY: History = { done: [], undone: [] };

export interface Edited {
    readonly document: MotionDocument;
    readonly history: History;
}

/** Does it. What had been undone is forgotten. One that changes nothing leaves everything as it is. */
export function apply<T extends Edited>(edited: T, transaction: Transaction): T {
    if (transaction.changes.length === 0) return edited;
    const history = { done: [...edited.history.done, transaction], undone: [] };
    return { ...edited, document: withChanges(edited.document, transaction.changes), history };
}

/** Takes the last one back; without one nothing happens. */
export function undo<T extends Edited>(edited: T): T {
    const last = edited.history.done.at(-1);
    if (!last) return edited;
    const history = { done: edited.history.done.slice(0, -1), undone: [...edited.history.undone, last] };
    return { ...edited, document: withChanges(edited.document, inverse(last).changes), history };
}

/** Does the one that was taken back last once more. */
export function redo<T extends Edited>(edited: T): T {
    const last = edited.history.undone.at(-1);
    if (!last) return edited;
    const history = { done: [...edited.history.done, last], undone: edited.history.undone.slice(0, -1) };
    return { ...edited, document: withChanges(edited.document, last.changes), history };
}
