// SPDX-License-Identifier: MIT
// The curve of a play from its start to its end. A play that loops has no end, so it is cut.

import { PLAYER_EV_LINK, PLAYER_EV_PAGE } from './facts.ts';
import { CURVE_TICKS_MOST, JOINTS, MARK_BYTES } from './motion.ts';
import type { Curve } from './motion.ts';

/** play: plays from the start for at most so many ticks; null: it cannot be played. loopTicks: where a play that loops is cut, but not
 *  before it begins anew. A play that does not is cut after 10 minutes only. */
export function wholeCurve(play: (ticks: number) => Curve | null, loopTicks: number): Curve | null {
    const short = play(loopTicks);
    if (!short || short.ended || loopTick(short) !== null) return short;
    const long = play(CURVE_TICKS_MOST);
    const at = long && loopTick(long);
    return long && at !== null ? cut(long, at) : long;
}

/** The tick at which a page is entered that was played before; null: none. */
export function loopTick({ ticks, marks }: Curve): number | null {
    const played = new Set<number | undefined>();
    let isLinked = true;
    for (let tick = 0; tick < ticks; tick++) {
        const [page, , events = 0] = marks.subarray(MARK_BYTES * tick);
        if (isLinked && (events & PLAYER_EV_PAGE) !== 0) {
            if (played.has(page)) return tick;
            played.add(page);
            isLinked = false;
        }
        isLinked ||= (events & PLAYER_EV_LINK) !== 0;
    }
    return null;
}

function cut({ goals, marks }: Curve, ticks: number): Curve {
    return { ticks, goals: goals.subarray(0, ticks * JOINTS), marks: marks.subarray(0, ticks * MARK_BYTES), ended: false };
}
