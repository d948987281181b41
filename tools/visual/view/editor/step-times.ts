// SPDX-License-Identifier: MIT
// Converts between the seconds that the firmware plays a step and the bytes in the page.

import type { PageView } from '../../model/page.ts';
import { BYTE_MAX, stepSeconds, writePage } from '../../model/page.ts';
import { pageOf } from '../../model/document.ts';
import type { Editor } from '../session/editor.ts';

export type TimedField = 'time' | 'pause';

export interface StepTime {
    /** Seconds. */
    readonly move: number;
    readonly pause: number;
}

/** Times of all steps of a page of the document. */
export function stepTimes(editor: Editor, page: number): StepTime[] {
    const { document, law } = editor.state.get();
    const bytes = pageOf(document, page);
    const from = editor.firstPose(page);
    return editor.page(page).steps.map((_, step) => stepSeconds(editor.format, bytes, step, from, law));
}

function withField(view: PageView, step: number, field: TimedField, value: number): Partial<PageView> {
    return { steps: view.steps.map((one, index) => (index === step ? { ...one, [field]: value } : one)) };
}

/** Returns a function from byte to seconds of the step; Infinity: the byte is invalid. */
function secondsWith(editor: Editor, page: number, step: number, field: TimedField): (value: number) => number {
    const { document, law } = editor.state.get();
    const bytes = pageOf(document, page);
    const from = editor.firstPose(page);
    const view = editor.page(page);
    return value => {
        const changed = writePage(editor.format, bytes, withField(view, step, field, value));
        if (!changed.ok) return Infinity;
        const { move, pause } = stepSeconds(editor.format, changed.value, step, from, law);
        return field === 'time' ? move : pause;
    };
}

/** Shortest and longest time that the field allows, in seconds. */
export function possibleSeconds(editor: Editor, page: number, step: number, field: TimedField): readonly [number, number] {
    const lasts = secondsWith(editor, page, step, field);
    return [lasts(0), lasts(BYTE_MAX)];
}

/** The byte 0..255 whose time is nearest to `seconds`. Binary search: times must grow with the byte. */
export function nearestSetting(editor: Editor, page: number, step: number, field: TimedField, seconds: number): number {
    const lasts = secondsWith(editor, page, step, field);
    let [low, high] = [0, BYTE_MAX];
    while (low < high) {
        const middle = Math.ceil((low + high) / 2);
        if (lasts(middle) <= seconds + 1e-9) low = middle;
        else high = middle - 1;
    }
    return low < BYTE_MAX && Math.abs(lasts(low + 1) - seconds) < Math.abs(lasts(low) - seconds) ? low + 1 : low;
}
