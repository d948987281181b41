// SPDX-License-Identifier: MIT
// Texts on the document and its edits, in the current language.

import { degreesOf } from '../../model/body.ts';
import type { Body } from '../../model/body.ts';
import type { PageFinding } from '../../model/checks.ts';
import { NOMINAL_VOLTS } from '../../model/motion.ts';
import type { Refusal } from '../../model/result.ts';
import type { Transaction } from '../../model/transaction.ts';
import { buttonsOf } from '../../robot/remote.ts';
import type { Drawn } from '../editor/curve-canvas.ts';
import type { Editor } from '../session/editor.ts';
import type { SessionState } from '../session/session.ts';
import type { TransferState } from '../session/transfer.ts';
import { TEXTS } from './texts.ts';

/** Text of the undo or redo button: "Undo: pose (motion 12)". */
export function editText(edit: Transaction, way: 'undoes' | 'redoes'): string {
    const { document } = TEXTS;
    const [first, ...more] = edit.changes.map(change => change.page);
    const where = first !== undefined && more.length === 0 ? document.editedMotion(first) : document.editedMotions(edit.changes.length);
    return document[way](document.edits[edit.label], where);
}

/** What was refused and what to do, in one sentence. */
export function refusalText({ code, words }: Refusal): string {
    return TEXTS.document.refusals[code](words);
}

/** "motion 12 (walk)", with its name in the document. */
export function titleOf(editor: Pick<Editor, 'page'>, page: number): string {
    return TEXTS.motion.title(page, editor.page(page).name);
}

const ARROWS: Readonly<Record<string, string>> = { up: '▲', down: '▼', left: '◀', right: '▶' };

/** A remote's code as its keys: "▲ + B1"; '' for none. */
export function codeText(code: number): string {
    return buttonsOf(code)
        .map(button => ARROWS[button] ?? button.toUpperCase())
        .join(' + ');
}

type Time = Pick<SessionState, 'source' | 'speed'>;

/** State of the transfer in one sentence; '' when idle. While the time of the robot in the page stands still, nothing of it goes on. */
export function transferText(state: TransferState, { source, speed }: Time = { source: 'yours', speed: 1 }): string {
    const hasTime = source !== 'simulated' || speed !== 0;
    const isWaiting = state.phase === 'reading' || state.phase === 'writing';
    const putBack = state.putBack === null || isWaiting ? '' : TEXTS.compare.putBack(state.putBack);
    const said = [phaseText(state), putBack].filter(Boolean).join(' ');
    return [said, isWaiting && !hasTime ? TEXTS.status.timeStands : ''].filter(Boolean).join(' · ');
}

function phaseText({ phase, done, total, account, trouble }: TransferState): string {
    const { compare } = TEXTS;
    switch (phase) {
        case 'idle':
            return '';
        case 'reading':
            return total === 0 ? compare.asks : compare.reads(Math.min(done + 1, total), total);
        case 'writing':
            return total === 0 ? compare.prepares : compare.writes(done, total);
        case 'written':
            return compare.written(total);
        case 'stopped':
            // Without an account the robot was only read.
            return [trouble ?? '', total > 0 && account.size > 0 ? stoppedText(done, total, account) : ''].filter(Boolean).join(' ');
        default:
            return phase satisfies never;
    }
}

/** What the robot was told to save and has not been seen to have may be another page by now. */
function stoppedText(done: number, total: number, account: TransferState['account']): string {
    const isUnsure = [...account.values()].some(state => state === 'saving' || state === 'lost');
    return isUnsure ? TEXTS.compare.stoppedUnsure(done, total) : TEXTS.compare.stopped(done, total);
}

/** Beyond this factor a servo cannot follow at all: the limit is 90 % of its no-load speed. */
const HOPELESS = 1 / 0.9;

/** true: the page cannot do what it says. Other findings are only warnings. */
export function isFaulty({ kind, amount }: PageFinding): boolean {
    return kind === 'damaged' || kind === 'out-of-reach' || kind === 'exit-circle' || (kind === 'too-fast' && amount > HOPELESS);
}

/** One finding as a sentence; joint: title of its joint; after: of the motion before it. */
export function findingText({ kind, step, amount, fault }: PageFinding, joint: string, after: string | null): string {
    const { checks } = TEXTS;
    const at = step === null ? null : step + 1;
    switch (kind) {
        case 'damaged':
            return checks.damaged(fault ? checks.pageFaults[fault] : '');
        case 'too-fast':
            return [checks.tooFast(at, joint, amount.toFixed(2), NOMINAL_VOLTS), after === null ? '' : checks.leadIn(after)]
                .filter(Boolean)
                .join(' ');
        case 'out-of-reach':
            return checks.outOfReach(at, joint);
        case 'tips-over':
            return checks.tipsOver(at, Math.round(amount * 1000));
        case 'exit-circle':
            return checks.exitCircle;
        default:
            return kind satisfies never;
    }
}

/** How far the servos of the lines drawn bold are behind, in physics. A chosen joint that the motion does not use has no line. */
export function lagText(
    { chosen, lags, isUnknown }: Pick<Drawn, 'chosen' | 'lags' | 'isUnknown'>,
    { joints }: Pick<Body, 'joints'>,
): string {
    const { curves } = TEXTS;
    if (isUnknown) return curves.noLags;
    if (chosen.length === 0) return curves.lagsNeedJoint;
    if (lags.size === 0) return curves.lagsComing;
    return curves.lags(
        joints.flatMap(joint => {
            const units = lags.get(joint.servo);
            return units === undefined ? [] : [[joint.servo, degreesOf(joint, units)] as const];
        }),
    );
}
