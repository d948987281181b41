// SPDX-License-Identifier: MIT
// Texts on trials of motions in physics, in the current language.

import { TICKS_PER_SECOND } from '../../model/motion.ts';
import { BRUSH_M } from '../../model/trial.ts';
import type { Touch, Verdict, VerdictKind } from '../../model/trial.ts';
import type { FallPlace } from './en.ts';
import { limbTitle } from './robot.ts';
import { TEXTS } from './texts.ts';

/** "40 motions stand, 2 fall." */
export function countedText(kinds: readonly VerdictKind[], untried: number, changed: number): string {
    const { trials } = TEXTS;
    if (kinds.length === 0) return trials.notTried;
    const parts = (Object.keys(trials.counted) as VerdictKind[]).flatMap(kind => {
        const count = kinds.filter(one => one === kind).length;
        return count === 0 ? [] : [trials.counted[kind](count)];
    });
    if (untried > 0) parts.push(trials.untried(untried));
    if (changed > 0) parts.push(trials.changed(changed));
    return trials.list(parts);
}

/** The verdict on a page in one sentence. titleOf: title of a page; behind: tried page whose play led through this one, and its verdict. */
export function verdictText(
    { kind, at, seconds }: Verdict,
    page: number,
    titleOf: (page: number) => string,
    behind: readonly [number, VerdictKind] | null,
): string {
    const { trials } = TEXTS;
    const place: FallPlace = {
        step: (at?.step ?? 0) + 1,
        motion: at && at.page !== page ? titleOf(at.page) : null,
        seconds: ((at?.tick ?? 0) / TICKS_PER_SECOND).toFixed(1),
    };
    switch (kind) {
        case 'stands':
            return trials.stands(seconds.toFixed(1));
        case 'rises':
            return trials.rises(place);
        case 'falls':
            return trials.falls(place);
        case 'low':
            return trials.low;
        case 'no-start':
            return behind ? trials.behind[behind[1]](titleOf(behind[0])) : trials.cannotJudge;
        default:
            return kind satisfies never;
    }
}

/** Describes the two deepest collisions and counts the others; '' for none. */
export function touchesText(touches: readonly Touch[]): string {
    const deepest = [...touches].sort((a, b) => b.depthM - a.depthM).slice(0, 2);
    if (deepest.length === 0) return '';
    const pairs = deepest.map(({ links: [a, b], depthM }) => ({
        a: limbTitle(a),
        b: limbTitle(b),
        mm: depthM > BRUSH_M ? Math.round(depthM * 1000) : null,
    }));
    return TEXTS.picture.touching(pairs, touches.length - deepest.length);
}

/** touch: the deepest one; steps: steps in which the limbs collide, 0..6. */
export function touchText({ links: [a, b], depthM }: Touch, steps: readonly number[]): string {
    return TEXTS.trials.touch(
        steps.map(step => step + 1),
        limbTitle(a),
        limbTitle(b),
        Math.round(depthM * 1000),
    );
}
