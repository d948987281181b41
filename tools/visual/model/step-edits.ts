// SPDX-License-Identifier: MIT
// Edits of a page's steps as values. Steps are 0..6, joints are servo IDs 0..30.

import { pageOf } from './document.ts';
import type { MotionDocument } from './document.ts';
import type { PageFormat } from './page-format.ts';
import { readPage, writePage } from './page.ts';
import type { PageView, Step } from './page.ts';
import { ok, refuse } from './result.ts';
import type { Result } from './result.ts';
import { transaction } from './transaction.ts';
import type { EditName, Transaction } from './transaction.ts';

/** Servo IDs of two joints that mirror each other. */
export type JointPair = readonly [right: number, left: number];
export type Side = 'right' | 'left';

/** The bytes of an editable motion page. */
export function editable(format: PageFormat, document: MotionDocument, page: number): Result<Uint8Array> {
    if (page === 0) return refuse('trim-page');
    if (!Number.isInteger(page) || page < 0 || page >= document.pages.length) return refuse('no-such-page', String(page));
    const bytes = pageOf(document, page);
    return format.fault(bytes) === null ? ok(bytes) : refuse('page-damaged', String(page));
}

/** Changes one page with the result of `make`. */
export function changePage(
    format: PageFormat,
    label: EditName,
    document: MotionDocument,
    page: number,
    make: (view: PageView) => Result<Partial<PageView>>,
): Result<Transaction> {
    const before = editable(format, document, page);
    if (!before.ok) return before;
    const change = make(readPage(format, before.value));
    if (!change.ok) return change;
    const after = writePage(format, before.value, change.value);
    return after.ok ? ok(transaction(label, [{ page, before: before.value, after: after.value }])) : after;
}

/** Replaces the chosen steps. Refused if one does not exist. */
function eachStep(view: PageView, chosen: Iterable<number>, make: (step: Step) => Step): Result<Partial<PageView>> {
    const set = new Set(chosen);
    for (const index of set) if (!view.steps[index]) return refuse('no-such-step', String(index + 1));
    return ok({ steps: view.steps.map((step, index) => (set.has(index) ? make(step) : step)) });
}

function chosenOf(view: PageView, chosen: Iterable<number>): Result<number[]> {
    const sorted = [...new Set(chosen)].sort((a, b) => a - b);
    const missing = sorted.find(index => !view.steps[index]);
    return missing === undefined ? ok(sorted) : refuse('no-such-step', String(missing + 1));
}

/** Sets positions of joints (null: not used) in one or several steps. */
export function setJoints(
    format: PageFormat,
    document: MotionDocument,
    page: number,
    steps: Iterable<number>,
    positions: ReadonlyMap<number, number | null>,
): Result<Transaction> {
    return changePage(format, 'set-joints', document, page, view => {
        for (const id of positions.keys()) if (!(id >= 0 && id < format.layout.joints)) return refuse('no-such-joint', String(id));
        return eachStep(view, steps, step => ({
            ...step,
            positions: step.positions.map((position, id) => (positions.has(id) ? (positions.get(id) ?? null) : position)),
        }));
    });
}

/** Inserts steps before step `at`. The number of steps appends them. */
export function insertSteps(
    format: PageFormat,
    document: MotionDocument,
    page: number,
    at: number,
    steps: readonly Step[],
    label: EditName = 'insert-step',
): Result<Transaction> {
    return changePage(format, label, document, page, view => {
        if (at < 0 || at > view.steps.length || !Number.isInteger(at)) return refuse('no-such-step', String(at + 1));
        return ok({ steps: view.steps.toSpliced(at, 0, ...steps) });
    });
}

export function deleteSteps(format: PageFormat, document: MotionDocument, page: number, steps: Iterable<number>): Result<Transaction> {
    return changePage(format, 'delete-steps', document, page, view => {
        const chosen = chosenOf(view, steps);
        return chosen.ok ? ok({ steps: view.steps.filter((_, index) => !chosen.value.includes(index)) }) : chosen;
    });
}

/** Inserts the copies as one block after the last chosen step. */
export function duplicateSteps(format: PageFormat, document: MotionDocument, page: number, steps: Iterable<number>): Result<Transaction> {
    return changePage(format, 'duplicate-steps', document, page, view => {
        const chosen = chosenOf(view, steps);
        if (!chosen.ok) return chosen;
        const copies = view.steps.filter((_, index) => chosen.value.includes(index));
        return ok({ steps: view.steps.toSpliced((chosen.value.at(-1) ?? 0) + 1, 0, ...copies) });
    });
}

/** Moves the chosen steps as one block before step `to`. The number of steps moves them to the end. */
export function moveSteps(
    format: PageFormat,
    document: MotionDocument,
    page: number,
    steps: Iterable<number>,
    to: number,
): Result<Transaction> {
    return changePage(format, 'move-steps', document, page, view => {
        const chosen = chosenOf(view, steps);
        if (!chosen.ok) return chosen;
        if (to < 0 || to > view.steps.length || !Number.isInteger(to)) return refuse('no-such-step', String(to + 1));
        const isChosen = (index: number): boolean => chosen.value.includes(index);
        const rest = (from: number, end: number): Step[] =>
            view.steps.filter((_, index) => index >= from && index < end && !isChosen(index));
        return ok({ steps: [...rest(0, to), ...view.steps.filter((_, index) => isChosen(index)), ...rest(to, view.steps.length)] });
    });
}

export function setTime(
    format: PageFormat,
    document: MotionDocument,
    page: number,
    steps: Iterable<number>,
    time: number,
): Result<Transaction> {
    return changePage(format, 'set-time', document, page, view => eachStep(view, steps, step => ({ ...step, time })));
}

export function setPause(
    format: PageFormat,
    document: MotionDocument,
    page: number,
    steps: Iterable<number>,
    pause: number,
): Result<Transaction> {
    return changePage(format, 'set-pause', document, page, view => eachStep(view, steps, step => ({ ...step, pause })));
}

/** Makes one side the mirror image of the other. */
export function mirrorSteps(
    format: PageFormat,
    document: MotionDocument,
    page: number,
    steps: Iterable<number>,
    pairs: readonly JointPair[],
    from: Side,
): Result<Transaction> {
    const sources = new Map(pairs.map(([right, left]) => (from === 'right' ? [left, right] : [right, left]) as [number, number]));
    return takeMirrored(format, 'mirror-steps', document, page, steps, sources);
}

/** Exchanges left and right, as in a mirror. */
export function exchangeSteps(
    format: PageFormat,
    document: MotionDocument,
    page: number,
    steps: Iterable<number>,
    pairs: readonly JointPair[],
): Result<Transaction> {
    const sources = new Map(
        pairs.flatMap(([right, left]): [number, number][] => [
            [right, left],
            [left, right],
        ]),
    );
    return takeMirrored(format, 'exchange-steps', document, page, steps, sources);
}

/** `sources`: joint -> the joint whose mirrored position it takes. */
function takeMirrored(
    format: PageFormat,
    label: EditName,
    document: MotionDocument,
    page: number,
    steps: Iterable<number>,
    sources: ReadonlyMap<number, number>,
): Result<Transaction> {
    return changePage(format, label, document, page, view =>
        eachStep(view, steps, step => ({
            ...step,
            positions: step.positions.map((position, id) => {
                const source = sources.get(id);
                const seen = source === undefined ? position : (step.positions[source] ?? null);
                return source === undefined || seen === null ? seen : format.mirrored(seen);
            }),
        })),
    );
}

/** Inserts a step half-way between `step` and the next. Both halves together take as long as before. */
export function interpolate(format: PageFormat, document: MotionDocument, page: number, step: number): Result<Transaction> {
    return changePage(format, 'interpolate', document, page, view => {
        const a = view.steps[step];
        const b = view.steps[step + 1];
        if (!a || !b) return refuse('no-such-step', String(step + 2));
        return ok({ steps: view.steps.toSpliced(step + 1, 1, ...format.between(a, b, view.schedule)) });
    });
}
