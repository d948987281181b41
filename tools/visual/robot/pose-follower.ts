// SPDX-License-Identifier: MIT
// Polls the pose of a robot on a line for the picture. Only one request is under way, so other requests wait for one at most. It uses
// `@pose` because that reads all servos at once; a line of `@watch` has positions up to 0.14 s old.

import type { Clock } from './clock.ts';
import type { Connection } from './connection.ts';
import { askPose } from './protocol.ts';
import type { JointPose } from './protocol.ts';
import { RobotError } from './robot-error.ts';

/** Delay before the next try when nothing may be asked or nothing answers. */
const RESTING_MS = 300;

export class PoseFollower {
    private readonly connection: Connection;
    private readonly clock: Clock;
    private readonly mayAsk: () => boolean;
    private readonly show: (pose: readonly JointPose[]) => void;
    private isRunning = false;

    /** show: receives each pose. */
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
