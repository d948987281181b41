// SPDX-License-Identifier: MIT
// Undo and redo: two lists of transactions, the newest last. Their length is not limited.

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

/** Applies a transaction and clears the redo list. A transaction without changes has no effect. */
export function apply<T extends Edited>(edited: T, transaction: Transaction): T {
    if (transaction.changes.length === 0) return edited;
    const history = { done: [...edited.history.done, transaction], undone: [] };
    return { ...edited, document: withChanges(edited.document, transaction.changes), history };
}

/** Reverts the last transaction. Does nothing if there is none. */
export function undo<T extends Edited>(edited: T): T {
    const last = edited.history.done.at(-1);
    if (!last) return edited;
    const history = { done: edited.history.done.slice(0, -1), undone: [...edited.history.undone, last] };
    return { ...edited, document: withChanges(edited.document, inverse(last).changes), history };
}

/** Applies the transaction that was undone last. */
export function redo<T extends Edited>(edited: T): T {
    const last = edited.history.undone.at(-1);
    if (!last) return edited;
    const history = { done: [...edited.history.done, last], undone: edited.history.undone.slice(0, -1) };
    return { ...edited, document: withChanges(edited.document, last.changes), history };
}
