// SPDX-License-Identifier: MIT
// Turns a stick into a walk. The first push starts the page `walk`, the stick's position shapes it (`@drive`), and letting go stops it
// through its exit page. Only one request is under way, so that a slow line is never flooded.

import type { Connection } from '../robot/connection.ts';
import { command, drive, play } from '../robot/protocol.ts';
import type { Requests } from '../robot/requests.ts';
import { RobotError } from '../robot/robot-error.ts';

const EVERY_MS = 100;
const AMPLITUDE = { least: 40, most: 120 };

export interface Stick {
    readonly x: number;
    readonly y: number;
}

/** The arguments of `@drive` for this stick position (PROTOCOL.md). */
export function shapeOf(stick: Stick): { blend: number; rate: number; amplitude: number } {
    const push = Math.min(1, Math.hypot(stick.x, stick.y));
    return {
        blend: Math.round(Math.max(-1, Math.min(1, stick.x)) * 100),
        rate: 100,
        amplitude: Math.round(AMPLITUDE.least + (AMPLITUDE.most - AMPLITUDE.least) * push),
    };
}

export class StickDrive {
    private readonly connection: () => Connection;
    private readonly walkPage: () => number | null;
    private readonly fail: (error: unknown) => void;
    private stick: Stick | null = null;
    private isRunning = false;
    /** Set until the stick is let go: a gamepad is read at every picture, and would start the walk again at once. */
    private mustRest = false;
    /** The walk is stopped by somebody else: a second stop within a second would break it off in mid step. */
    private isStopped = false;

    constructor(connection: () => Connection, walkPage: () => number | null, fail: (error: unknown) => void) {
        this.connection = connection;
        this.walkPage = walkPage;
        this.fail = fail;
    }

    set(stick: Stick | null): void {
        if (!stick) this.mustRest = false;
        this.stick = this.mustRest ? null : stick;
        if (this.stick && !this.isRunning) void this.run();
    }

    /** Stops the walk. A stick that is pushed drives again only when it was let go. isStopped: the robot is told to stop anyway. */
    stop(isStopped = false): void {
        this.mustRest ||= this.stick !== null;
        this.stick = null;
        this.isStopped = isStopped;
    }

    private async run(): Promise<void> {
        const page = this.walkPage();
        if (page === null) return;
        this.isRunning = true;
        this.isStopped = false;
        try {
            const { requests } = this.connection();
            await play(requests, page);
            this.isStopped = false; // a stop before the play was answered may have come before it
            try {
                await this.steer(requests);
            } catch (error) {
                // The robot itself limits only a walk that was steered once. What it does not answer is followed by a stop anyway.
                if (error instanceof RobotError && error.number !== 0) void command(requests, 'stop').catch(this.fail);
                throw error;
            }
            if (!this.isStopped) await command(requests, 'stop');
        } catch (error) {
            this.stop();
            this.fail(error);
        } finally {
            this.isRunning = false;
        }
    }

    private async steer(requests: Requests): Promise<void> {
        while (this.stick && !this.isStopped) {
            const { blend, rate, amplitude } = shapeOf(this.stick);
            await drive(requests, blend, rate, amplitude);
            await new Promise(resolve => setTimeout(resolve, EVERY_MS));
        }
    }
}
