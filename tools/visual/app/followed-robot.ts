// SPDX-License-Identifier: MIT
// A robot on a line: its connection, and the picture that follows its servos, asking `@pose` as often as the line allows. The feet are
// drawn on the ground, because the robot's place in the room is unknown.

import { jointAngle } from '../model/body.ts';
import type { Body } from '../model/body.ts';
import { POSITION_MIDDLE, TICKS_PER_SECOND } from '../model/motion.ts';
import { wallClock } from '../robot/clock.ts';
import { Connection } from '../robot/connection.ts';
import type { Port } from '../robot/port.ts';
import { PoseFollower } from '../robot/pose-follower.ts';
import type { JointPose } from '../robot/protocol.ts';
import type { ServoState } from '../robot/robot-state.ts';
import { Standing } from '../sim/standing.ts';
import type { SourceEvents } from './simulated-source.ts';

export class FollowedRobot {
    private readonly events: SourceEvents;
    private readonly mayAsk: () => boolean;
    private readonly standing: Standing;
    private startedMs = 0;
    /** The last position of each servo, by ID. */
    private readonly positions = new Map<number, number>();
    private follower: PoseFollower | null = null;
    connection: Connection | null = null;

    constructor(body: Body, events: SourceEvents, mayAsk: () => boolean) {
        this.events = events;
        this.mayAsk = mayAsk;
        this.standing = new Standing(body);
    }

    connect(port: Port): void {
        this.follower?.stop();
        this.standing.begin();
        this.positions.clear();
        this.startedMs = performance.now();
        // Ignore what an old connection still reports while it closes.
        const connection: Connection = new Connection(port, wallClock, {
            state: state => this.connection === connection && this.events.connection(state),
            text: bytes => this.connection === connection && this.events.text(bytes),
        });
        this.connection = connection;
        connection.connect();
        this.follower = new PoseFollower(connection, wallClock, this.mayAsk, pose => this.show(pose));
        this.follower.start();
    }

    async close(): Promise<void> {
        const connection = this.connection;
        this.connection = null;
        this.follower?.stop();
        await connection?.close();
    }

    private show(pose: readonly JointPose[]): void {
        const { positions } = this;
        for (const { id, position } of pose) if (position !== null) positions.set(id, position);
        const servos: ServoState[] = pose.map(({ id, position, torque }) => ({
            id,
            goalPos: null,
            position: positions.get(id) ?? POSITION_MIDDLE,
            isSilent: position === null,
            torque,
            alarms: 0,
            celsius: 0,
            faults: 0,
        }));
        const trunk = this.standing.move(joint => jointAngle(joint, positions.get(joint.servo) ?? joint.zero));
        const ticks = Math.floor(((performance.now() - this.startedMs) / 1000) * TICKS_PER_SECOND);
        this.events.frame({
            ticks,
            servos,
            trunk,
            leds: 0,
            isPowered: true,
            isHeld: false,
            hasFallen: false,
            lateMs: 0,
            trace: new Float32Array(0),
        });
    }
}
