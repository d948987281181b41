// SPDX-License-Identifier: MIT
// A robot at the end of a line: its connection, and the picture that follows its servos: `@pose` as often as the line lets it. The feet stand
// on the ground, for nobody tells where the robot is in its room.

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
        this.startedMs = performance.now();
        // What an old connection still says when it is closed concerns nobody.
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
        const positions = new Map(pose.map(joint => [joint.id, joint.position]));
        const servos: ServoState[] = pose.map(({ id, position, torque }) => ({
            id,
            goalPos: null,
            position: position ?? POSITION_MIDDLE,
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
