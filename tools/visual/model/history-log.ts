// SPDX-License-Identifier: MIT
// The stored history of a document, so that undo continues after a tab was closed. Steps are numbered from the document's first edit. The
// document stores how many of them are done:
//
//     number   0 1 2 | 3 4 5 6 7 8 | 9 10        kept: 3..10. The document is as step 8 left it: 9 of them are done,
//            forgotten |    done   | undone      9 and 10 were taken back and can be done once more.
//
// Pure. Stored steps are used only as far as each of them fits the document.

import { withChanges } from './document.ts';
import type { MotionDocument } from './document.ts';
import type { Edited, History } from './history.ts';
import { PAGE_BYTES, PAGE_COUNT } from './motion.ts';
import { EDIT_NAMES, inverse } from './transaction.ts';
import type { Change, Transaction } from './transaction.ts';

/** Limit for the stored steps of one document: about 8000 edits of one page. The oldest are dropped first. */
export const HISTORY_BYTES_MOST = 8 << 20;
const STEP_BYTES = 100; // without its pages

export interface NumberedStep extends Transaction {
    readonly number: number;
}

/** What changes in the stored steps. */
export interface StepsChange {
    /** Delete steps with smaller numbers. */
    readonly dropBefore: number;
    /** Delete steps from this number on. */
    readonly dropFrom: number;
    /** Numbered from dropFrom on. */
    readonly add: readonly NumberedStep[];
}

export const DROP_ALL: StepsChange = { dropBefore: 0, dropFrom: 0, add: [] };

/** The steps stored now. */
export interface HistoryLog {
    /** Number of the oldest step of this tab's history. */
    readonly base: number;
    /** All steps of this tab's history, oldest first. */
    readonly steps: readonly Transaction[];
}

export const EMPTY_LOG: HistoryLog = { base: 0, steps: [] };

function stepsOf({ done, undone }: History): Transaction[] {
    return [...done, ...[...undone].reverse()];
}

/** How many steps of the document are done, including forgotten ones. */
export function positionOf(log: HistoryLog, history: History): number {
    return log.base + history.done.length;
}

/** What an edit, undo or redo changes in the stored steps. Steps stay the same objects, so comparing from the end finds the common
 *  beginning. */
export function advance(
    log: HistoryLog,
    history: History,
    most = HISTORY_BYTES_MOST,
): { readonly log: HistoryLog; readonly change: StepsChange } {
    const steps = stepsOf(history);
    let same = Math.min(steps.length, log.steps.length);
    while (same > 0 && steps[same - 1] !== log.steps[same - 1]) same--;
    const number = (index: number): number => log.base + index;
    const first = firstWithin(steps, most);
    const add = steps.slice(Math.max(same, first)).map((step, i) => ({ ...step, number: number(Math.max(same, first) + i) }));
    return { log: { base: log.base, steps }, change: { dropBefore: number(first), dropFrom: number(same), add } };
}

/** Index of the oldest step that fits together with the newer ones. */
function firstWithin(steps: readonly Transaction[], most: number): number {
    let bytes = 0;
    for (let index = steps.length - 1; index >= 0; index--) {
        bytes += STEP_BYTES + 2 * PAGE_BYTES * (steps[index]?.changes.length ?? 0);
        if (bytes > most) return index + 1;
    }
    return 0;
}

function isPage(value: unknown): value is Uint8Array {
    return value instanceof Uint8Array && value.length === PAGE_BYTES;
}

function isChange(value: unknown): value is Change {
    const { page, before, after } = (value ?? {}) as Partial<Change>;
    return Number.isInteger(page) && Number(page) >= 0 && Number(page) < PAGE_COUNT && isPage(before) && isPage(after);
}

function isStep(value: unknown): value is NumberedStep {
    const { number, label, changes } = (value ?? {}) as Partial<NumberedStep>;
    return Number.isInteger(number) && EDIT_NAMES.some(name => name === label) && Array.isArray(changes) && changes.every(isChange);
}

/** The document after applying a step's changes; null if they do not fit it. */
function stepped(document: MotionDocument, { changes }: Transaction): MotionDocument | null {
    try {
        return withChanges(document, changes);
    } catch {
        return null;
    }
}

/** Restores the history of a document of which `position` steps are done. log.base: how many steps are forgotten. */
export function restored(document: MotionDocument, position: number, kept: readonly unknown[]): Edited & { readonly log: HistoryLog } {
    const byNumber = new Map(kept.filter(isStep).map(({ number, label, changes }) => [number, { label, changes }]));
    const run = (from: number, by: 1 | -1, turn: (step: Transaction) => Transaction): Transaction[] => {
        const found: Transaction[] = [];
        let now: MotionDocument | null = document;
        for (let number = from; now; number += by) {
            const step = byNumber.get(number);
            now = step ? stepped(now, turn(step)) : null;
            if (step && now) found.push(step);
        }
        return found.reverse();
    };
    const done = run(position - 1, -1, inverse);
    const history: History = { done, undone: run(position, 1, step => step) };
    return { document, history, log: { base: position - done.length, steps: stepsOf(history) } };
}
