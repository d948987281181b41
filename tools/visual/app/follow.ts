// SPDX-License-Identifier: MIT
// Live follow moves the robot slowly to the latest wanted pose. Only one request is under way. While the robot moves, it refuses `@move`,
// so the next pose waits.

import type { Connection } from '../robot/connection.ts';
import { REFUSED, movePose } from '../robot/protocol.ts';
import { wallClock } from '../robot/clock.ts';
import type { Clock } from '../robot/clock.ts';
import { RobotError } from '../robot/robot-error.ts';

export const FOLLOW_DEGREES_PER_SECOND = 60;
const AGAIN_MS = 60;

export class Follow {
    private readonly connection: () => Pick<Connection, 'requests'>;
    private readonly clock: Clock;
    private readonly fail: (error: unknown) => void;
    private wanted: readonly (number | null)[] | null = null;
    private ended: () => void = () => undefined;
    private isRunning = false;

    constructor(connection: () => Pick<Connection, 'requests'>, fail: (error: unknown) => void, clock: Clock = wallClock) {
        this.connection = connection;
        this.fail = fail;
        this.clock = clock;
    }

    get isOn(): boolean {
        return this.wanted !== null;
    }

    /** Servo units by ID. null stops following, but a movement that has begun is finished. ended: called when a request fails, which ends
     *  it, too. */
    set(positions: readonly (number | null)[] | null, ended: () => void = () => undefined): void {
        this.wanted = positions;
        this.ended = ended;
        if (positions && !this.isRunning) void this.run();
    }

    private async run(): Promise<void> {
        this.isRunning = true;
        let sent = '';
        try {
            while (this.wanted) {
                const pose = this.wanted;
                if (pose.join() !== sent && (await this.move(pose))) sent = pose.join();
                else await new Promise<void>(resolve => this.clock.after(AGAIN_MS, resolve));
            }
        } catch (error) {
            this.wanted = null;
            this.ended();
            this.fail(error);
        } finally {
            this.isRunning = false;
        }
    }

    /** false: the robot is still moving. */
    private async move(pose: readonly (number | null)[]): Promise<boolean> {
        try {
            await movePose(this.connection().requests, FOLLOW_DEGREES_PER_SECOND, pose);
            return true;
        } catch (error) {
            if (error instanceof RobotError && error.number === REFUSED.busy) return false;
            throw error;
        }
    }
}
