// SPDX-License-Identifier: MIT
// Getting up: chooses the motion by how the robot lies. A robot that lay on its side or rolled over may lie the other way when the motion
// ends. Then the matching motion follows, until the robot stands, refuses, somebody stops it or does something else, or three motions have
// played.

import { liesOnFace } from '../model/space.ts';
import type { Place } from '../model/space.ts';

const MOST_TRIES = 3;

export class GetUp {
    private readonly play: (motion: 'face' | 'back') => Promise<boolean>;
    private tries = 0;
    /** The robot has taken the last try, so the motion that ends next is this one. */
    private isTaken = false;
    private wasMoving = false;

    /** play: resolves to false if the robot does not play it. */
    constructor(play: (motion: 'face' | 'back') => Promise<boolean>) {
        this.play = play;
    }

    start(trunk: Place): void {
        this.tries = 0;
        this.try(trunk);
    }

    stop(): void {
        this.tries = 0;
    }

    /** Checks the robot again each time a motion ends. */
    look(isMoving: boolean, trunk: Place, hasFallen: boolean): void {
        const hasEnded = this.isTaken && this.wasMoving && !isMoving;
        this.wasMoving = isMoving;
        if (!isMoving && !hasFallen) return this.stop(); // also if a hand has put it on its feet
        if (this.tries === 0 || !hasEnded) return;
        if (this.tries === MOST_TRIES) return this.stop();
        this.try(trunk);
    }

    private try(trunk: Place): void {
        this.tries++;
        this.isTaken = false;
        void this.play(liesOnFace(trunk) ? 'face' : 'back').then(isTaken => {
            this.isTaken = isTaken;
            if (!isTaken) this.stop();
        });
    }
}
