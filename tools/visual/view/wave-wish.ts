// SPDX-License-Identifier: MIT
// "Wave while walking", pressed on a robot that does not walk yet. It is for the walk that the press begins: nothing else is waved over. A
// press that begins none (the robot refuses, or is paused) is forgotten.

import type { SessionState } from './session/session.ts';

/** The first answer may have been asked for before the press; each of the next two is behind it. */
const ANSWERS = 3;

export class WaveWish {
    /** As many answers of the robot may still say that it begins nothing. 0: nobody wishes. */
    private left = 0;
    private seen: SessionState['where'] = null;

    ask(): void {
        this.left = ANSWERS;
    }

    forget(): void {
        this.left = 0;
    }

    /** Call it at each change. true once: the robot walks now. walk: the remote's code that begins the walk. A robot that is off forgets. */
    isDue({ isPowered, where }: Pick<SessionState, 'isPowered' | 'where'>, walk: number): boolean {
        const isNew = where !== this.seen;
        this.seen = where;
        if (!isPowered) this.forget();
        if (this.left === 0 || !isNew || where === null || where.state === 'approach' || where.state === 'ready') return false;
        this.left = where.state === 'playing' ? 0 : this.left - 1;
        return where.state === 'playing' && where.code === walk;
    }
}
