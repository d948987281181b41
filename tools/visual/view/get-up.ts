// SPDX-License-Identifier: MIT
// Getting up: chooses the motion by how the robot lies. A robot that lay on its side or rolled over may lie the other way when the motion
// ends. Then the matching motion follows, until the robot stands, somebody stops it, or three motions have played.

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

    /** Checks the robot again each time a motion ends. */
    look(isMoving: boolean, trunk: Place, hasFallen: boolean): void {
        const hasEnded = this.wasMoving && !isMoving;
        this.wasMoving = isMoving;
        if (!isMoving && !hasFallen) return this.stop(); // also if it was refused and a hand has put it on its feet
        if (this.tries === 0 || !hasEnded) return;
        if (this.tries === MOST_TRIES) return this.stop();
        this.tries++;
        this.play(liesOnFace(trunk) ? 'face' : 'back');
    }
}
