// SPDX-License-Identifier: MIT
// Asks a robot on a line for its pose, again and again, so that a picture can follow it: one is under way at a time, and what
// others ask waits for that one only. `@pose` and not `@watch`: it asks all
// servos at once, where a line of `@watch` has positions that are up to 0.14 s old.

import type { Clock } from './clock.ts';
import type { Connection } from './connection.ts';
import { askPose } from './protocol.ts';
import type { JointPose } from './protocol.ts';
import { RobotError } from './robot-error.ts';

/** Until the next try, when nothing may be asked or nothing answers. */
const RESTING_MS = 300;

export class PoseFollower {
    private readonly connection: Connection;
    private readonly clock: Clock;
    private readonly mayAsk: () => boolean;
    private readonly show: (pose: readonly JointPose[]) => void;
    private isRunning = false;

    /** show: gets each pose as it comes. */
    constructor(connection: Connection, clock: Clock, mayAsk: () => boolean, show: (pose: readonly JointPose[]) => void) {
        this.connection = connection;
        this.clock = clock;
        this.mayAsk = mayAsk;
        this.show = show;
    }

    start(): void {
        this.isRunning = true;
        void this.run();
    }

    stop(): void {
        this.isRunning = false;
    }

    private async run(): Promise<void> {
        while (this.isRunning) {
            if (this.mayAsk() && (await this.once())) continue;
            await new Promise<void>(resolve => this.clock.after(RESTING_MS, resolve));
        }
    }

    private async once(): Promise<boolean> {
        try {
            const pose = await askPose(this.connection.requests);
            if (this.isRunning) this.show(pose);
            return true;
        } catch (error) {
            if (error instanceof RobotError && error.code === 'no-answer') this.connection.askAgain();
            return false;
        }
    }
}
