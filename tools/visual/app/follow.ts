// SPDX-License-Identifier: MIT
// Live follow moves the robot slowly to the latest wanted pose. Only one request is under way. While the robot moves, the next pose waits.
// A move that was stopped, perhaps at the robot's own panel or remote, ends it: the robot must not move on by itself. So does a servo that has
// failed in a move: the next one would switch it on again, against what has overloaded it.

import type { Connection } from '../robot/connection.ts';
import { REFUSED, askWhere, idsIn, movePose } from '../robot/protocol.ts';
import { wallClock } from '../robot/clock.ts';
import type { Clock } from '../robot/clock.ts';
import { RobotError } from '../robot/robot-error.ts';

export const FOLLOW_DEGREES_PER_SECOND = 60;
const AGAIN_MS = 60;
/** Play's sentences for a move that has not reached its pose. Edit has none: keys of its terminal stop it, and `@where` has the faults. */
const CUT_OFF = /(?:Broken off|fault of a servo) in a move/;
const CUT_OFF_LENGTH = 50;

export class Follow {
    private readonly connection: () => Pick<Connection, 'requests'>;
    private readonly clock: Clock;
    private readonly fail: (error: unknown) => void;
    private wanted: readonly (number | null)[] | null = null;
    private ended: () => void = () => undefined;
    private isRunning = false;
    private heardLast = '';

    constructor(connection: () => Pick<Connection, 'requests'>, fail: (error: unknown) => void, clock: Clock = wallClock) {
        this.connection = connection;
        this.fail = fail;
        this.clock = clock;
    }

    get isOn(): boolean {
        return this.wanted !== null;
    }

    /** Servo units by ID. null stops following, but a movement that has begun is finished. ended: called when a request fails or a move is
     *  cut off, which ends it, too, and by end(). */
    set(positions: readonly (number | null)[] | null, ended: () => void = () => undefined): void {
        this.wanted = positions;
        this.ended = ended;
        if (positions && !this.isRunning) void this.run();
    }

    /** The robot's text. */
    hear(bytes: Uint8Array): void {
        const text = this.heardLast + new TextDecoder('latin1').decode(bytes);
        const isCutOff = CUT_OFF.test(text);
        this.heardLast = isCutOff ? '' : text.slice(-CUT_OFF_LENGTH);
        if (isCutOff && this.wanted) this.end();
    }

    /** Stops following and tells who follows, also while there is nothing to follow. */
    end(): void {
        const { ended } = this;
        this.set(null);
        ended();
    }

    private async run(): Promise<void> {
        this.isRunning = true;
        let sent = '';
        try {
            while (this.wanted) {
                const pose = this.wanted;
                if (pose.join() !== sent && (await this.move(pose, sent !== ''))) sent = pose.join();
                else await new Promise<void>(resolve => this.clock.after(AGAIN_MS, resolve));
            }
        } catch (error) {
            this.end();
            this.fail(error);
        } finally {
            this.isRunning = false;
        }
    }

    /** false: the robot still moves, or follows no more. Asks before it moves the robot: the answer comes behind the sentence on how the last
     *  move has ended. hasMoved: the faults that it reports are those of our last move. */
    private async move(pose: readonly (number | null)[], hasMoved: boolean): Promise<boolean> {
        const { requests } = this.connection();
        const { state, faulty } = await askWhere(requests);
        if (state !== 'idle' || !this.wanted) return false;
        if (hasMoved && faulty !== 0) throw new RobotError('servo-failed', idsIn(faulty).join(', '));
        try {
            await movePose(requests, FOLLOW_DEGREES_PER_SECOND, pose);
            return true;
        } catch (error) {
            if (error instanceof RobotError && error.number === REFUSED.busy) return false;
            throw error;
        }
    }
}
