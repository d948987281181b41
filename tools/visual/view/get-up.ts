// SPDX-License-Identifier: MIT
// Getting up: as the robot lies. One that lay on its side, or rolled over meanwhile, lies otherwise when the motion ends: then the other one
// is chosen, by itself, until it stands or somebody stops it.

import { liesOnFace } from '../model/space.ts';
import type { Place } from '../model/space.ts';

const MOST_TRIES = 3;

export class GetUp {
    private readonly play: (motion: 'face' | 'back') => void;
    private tries = 0;
    private wasMoving = false;

    constructor(play: (motion: 'face' | 'back') => void) {
        this.play = play;
    }

    start(trunk: Place): void {
        this.tries = 1;
        this.wasMoving = false;
        this.play(liesOnFace(trunk) ? 'face' : 'back');
    }

    stop(): void {
        this.tries = 0;
    }

    /** Looks again whenever a motion has ended. */
    look(isMoving: boolean, trunk: Place, hasFallen: boolean): void {
        const hasEnded = this.wasMoving && !isMoving;
        this.wasMoving = isMoving;
        if (this.tries === 0 || !hasEnded) return;
        if (!hasFallen || this.tries === MOST_TRIES) return this.stop();
        this.tries++;
        this.play(liesOnFace(trunk) ? 'face' : 'back');
    }
}
