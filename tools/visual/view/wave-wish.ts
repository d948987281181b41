// SPDX-License-Identifier: MIT
// "Wave while walking", pressed on a robot that does not walk yet. It is for the walk that the press begins: nothing else is waved over.

import type { SessionState } from './session/session.ts';

export class WaveWish {
    private isWanted = false;

    ask(): void {
        this.isWanted = true;
    }

    forget(): void {
        this.isWanted = false;
    }

    /** true once: the robot walks now. walk: the remote's code that begins the walk. A robot that is off forgets. */
    isDue({ isPowered, where }: Pick<SessionState, 'isPowered' | 'where'>, walk: number): boolean {
        this.isWanted &&= isPowered;
        if (!this.isWanted || where?.state !== 'playing') return false;
        this.isWanted = false;
        return where.code === walk;
    }
}
