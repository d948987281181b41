// SPDX-License-Identifier: MIT
// What is typed into the number fields of Steps. A number that is not possible changes nothing, and a message says which are.

import { BYTE_MAX } from '../../model/page.ts';
import type { Session } from '../session/session.ts';
import { TEXTS } from '../texts/texts.ts';
import { nearestSetting, possibleSeconds } from './step-times.ts';
import type { TimedField } from './step-times.ts';

/** Increment of the fields in seconds. */
export const FIELD_STEP = 0.05;

type Parts = Pick<Session, 'editor' | 'say'>;

/** typed: how often the steps of the page are played. */
export function setTimes(session: Parts, typed: string): void {
    const { editor } = session;
    const wanted = wholeNumber(session, typed, 1);
    if (wanted === null) return;
    const { page, document } = editor.state.get();
    if (wanted !== editor.page(page).repetitions) editor.dispatch(editor.edits.setHeader(document, page, { repetitions: wanted }));
}

/** typed: seconds or speed. If this step is among the chosen ones, all of them get the value. */
export function setStepField(session: Parts, index: number, field: TimedField, typed: string): void {
    const { editor } = session;
    const { page, steps, document } = editor.state.get();
    const isSpeed = field === 'time' && editor.page(page).schedule === 'speed';
    const value = isSpeed ? wholeNumber(session, typed, 0) : settingFor(session, index, field, Number.parseFloat(typed));
    if (value === null) return;
    const chosen = steps.has(index) ? steps : new Set([index]);
    editor.dispatch(
        field === 'time' ? editor.edits.setTime(document, page, chosen, value) : editor.edits.setPause(document, page, chosen, value),
    );
}

function wholeNumber(session: Parts, typed: string, least: number): number | null {
    const number = /^\d+$/.test(typed) ? Number(typed) : Number.NaN;
    const isPossible = number >= least && number <= BYTE_MAX;
    tell(session, isPossible, TEXTS.steps.numbersPossible(least, BYTE_MAX));
    return isPossible ? number : null;
}

/** One increment above the maximum is accepted and rounded: 2 for 1.99. */
function settingFor(session: Parts, index: number, field: TimedField, seconds: number): number | null {
    const { editor } = session;
    const { page } = editor.state.get();
    const [least, most] = possibleSeconds(editor, page, index, field).map(limit => limit.toFixed(2)) as [string, string];
    const isPossible = seconds >= Number(least) && seconds <= Number(most) + FIELD_STEP;
    tell(session, isPossible, TEXTS.steps.secondsPossible(least, most));
    return isPossible ? nearestSetting(editor, page, index, field, seconds) : null;
}

/** What was said of the number before does not stay, even if this one changes nothing. */
function tell(session: Parts, isPossible: boolean, text: string): void {
    session.say(isPossible ? null : { text, tone: 'bad' });
}
