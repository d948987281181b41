// SPDX-License-Identifier: MIT
// Every sentence of what physics says of motions.

import { TICKS_PER_SECOND } from '../../model/motion.ts';
import { BRUSH_M } from '../../model/trial.ts';
import type { Touch, Verdict, VerdictKind } from '../../model/trial.ts';
import type { TrialsState } from '../session/trials.ts';

export const TRIAL_TEXTS = {
    purpose: 'Physics: plays motions on a body of their own, as fast as it can; the robot in the picture stays as it is.',
    loading: 'Physics is being loaded …',
    failed: (words: string) => `Physics could not be loaded, so falls cannot be told (${words}). Try again.`,
    trying: ({ done, total }: TrialsState, title: string) => `Trying ${title}: ${done + 1} of ${total} …`,
    stale: 'Before the last change: ',
    notTried: 'No motion has been tried yet.',
    untried: (count: number) => `${count} not tried yet`,
    changed: (count: number) => `${count} changed since ${count === 1 ? 'it was' : 'they were'} tried`,
} as const;

const COUNTED: Record<VerdictKind, (count: number) => string> = {
    stands: count => (count === 1 ? '1 motion stands' : `${count} motions stand`),
    rises: count => (count === 1 ? '1 goes to the floor and rises' : `${count} go to the floor and rise`),
    falls: count => (count === 1 ? '1 falls' : `${count} fall`),
    low: count => (count === 1 ? '1 ends low' : `${count} end low`),
    'no-start': count => `${count} cannot be judged alone`,
};

/** "40 motions stand, 2 fall." */
export function countedText(kinds: readonly VerdictKind[], untried: number, changed: number): string {
    if (kinds.length === 0) return TRIAL_TEXTS.notTried;
    const parts = (Object.keys(COUNTED) as VerdictKind[]).flatMap(kind => {
        const count = kinds.filter(one => one === kind).length;
        return count === 0 ? [] : [COUNTED[kind](count)];
    });
    return `${[...parts, ...(untried > 0 ? [TRIAL_TEXTS.untried(untried)] : []), ...(changed > 0 ? [TRIAL_TEXTS.changed(changed)] : [])].join(', ')}.`;
}

/** The verdict on a page in one sentence. titleOf: of a page; behind: a page that was tried and led through this one. */
export function verdictText(
    { kind, at, seconds }: Verdict,
    page: number,
    titleOf: (page: number) => string,
    behind: readonly [number, VerdictKind] | null,
): string {
    const where = at
        ? `in step ${at.step + 1}${at.page === page ? '' : ` of ${titleOf(at.page)}`} after ${(at.tick / TICKS_PER_SECOND).toFixed(1)} s`
        : '';
    switch (kind) {
        case 'stands':
            return `Stands: played for ${seconds.toFixed(1)} s.`;
        case 'rises':
            return `Goes to the floor ${where}, and is on its feet in the end.`;
        case 'falls':
            return `Falls ${where}, and stays on the floor. Give the step more time, or keep the weight over the foot that carries.`;
        case 'low':
            return 'Stays upright, but does not end on its soles alone: it sits, kneels or leans.';
        case 'no-start':
            return behind
                ? `Does not stand in its first pose. Played behind ${titleOf(behind[0])} it ${BEHIND[behind[1]]}.`
                : 'Cannot be judged: it does not stand in its first pose. It begins lying, or in the middle of a movement.';
        default:
            return kind satisfies never;
    }
}

const BEHIND: Record<VerdictKind, string> = {
    stands: 'stands',
    rises: 'gets to its feet',
    falls: 'stays on the floor',
    low: 'ends low',
    'no-start': 'is not reached',
};

/** "right_forearm" as people read it. */
export function linkTitle(link: string): string {
    return link.replaceAll('_', ' ');
}

/** What the picture marks; the two deepest in words. */
export function touchesText(touches: readonly Touch[]): string {
    const deepest = [...touches].sort((a, b) => b.depthM - a.depthM).slice(0, 2);
    if (deepest.length === 0) return '';
    const pairs = deepest.map(
        ({ links: [a, b], depthM }) => `${linkTitle(a)} and ${linkTitle(b)}${depthM > BRUSH_M ? ` (${Math.round(depthM * 1000)} mm)` : ''}`,
    );
    const more = touches.length - deepest.length;
    return `Touching: ${pairs.join('; ')}${more > 0 ? `; ${more} more` : ''}`;
}

/** deepest: of all; steps: those in which limbs meet, 0..6. */
export function touchText({ links: [a, b], depthM }: Touch, steps: readonly number[]): string {
    const numbers = steps.map(step => String(step + 1));
    const where =
        numbers.length === 1
            ? `Step ${numbers[0]}, or the way to it`
            : `Steps ${numbers.slice(0, -1).join(', ')} and ${numbers.at(-1)}, or the ways to them`;
    return `${where}: ${linkTitle(a)} and ${linkTitle(b)} meet (${Math.round(depthM * 1000)} mm). Servos push against each other.`;
}
