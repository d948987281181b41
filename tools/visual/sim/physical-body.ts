// SPDX-License-Identifier: MIT
// The robot's body in MuJoCo. Takes servo torques and returns angles and speeds of the shafts, 1024 times a second. The floor of its room
// can tilt, and hands (hands.ts) can grip and hold the robot.

import type { Body } from '../model/body.ts';
import { jointAngle, soleCorners } from '../model/body.ts';
import { POSITION_MIDDLE } from '../model/motion.ts';
import { STILL, add, cross, length, rotate, scale, turn } from '../model/space.ts';
import type { Place, Vector } from '../model/space.ts';
import type { Touch } from '../model/trial.ts';
import { SHAFT_FIELDS } from './board.ts';
import { geomTouches, linkTouches } from './contacts.ts';
import { CLEARANCE_M, GRAVITY, Hands, UPRIGHT } from './hands.ts';
import type { HandledBody } from './hands.ts';
import type { Floor, Grip } from './messages.ts';
import { OBJECT } from './mujoco.ts';
import type { Data, Model, Mujoco } from './mujoco.ts';

const FALLEN = 0.55;
const LIFTED_M = 2;

interface Shaft {
    readonly angleAt: number;
    readonly speedAt: number;
    readonly torqueAt: number;
    readonly direction: 1 | -1;
    readonly offsetRad: number;
}

export class PhysicalBody implements HandledBody {
    private readonly mujoco: Mujoco;
    private readonly model: Model;
    readonly data: Data;
    private readonly shafts = new Map<number, Shaft>();
    private readonly soles: { readonly link: number; readonly corners: readonly Vector[] }[];
    readonly trunkLink: number;
    private readonly floorGeom: number;
    private readonly soleGeoms: ReadonlySet<number>;
    /** By MuJoCo body number. */
    private readonly linkNames: ReadonlyMap<number, string>;
    readonly stepsPerSecond: number;
    readonly massKg: number;
    private readonly hands: Hands;

    /** xml: body.xml. Throws MuJoCo's message if it is not a valid model. */
    constructor(mujoco: Mujoco, xml: string, body: Body) {
        this.mujoco = mujoco;
        this.model = mujoco.MjModel.from_xml_string(xml);
        this.data = new mujoco.MjData(this.model);
        for (const joint of body.joints) this.addShaft(joint);
        this.soles = (['right', 'left'] as const).map(side => ({
            link: this.id(OBJECT.body, `${side}_foot`),
            corners: soleCorners(body, `${side}_sole`),
        }));
        this.trunkLink = this.id(OBJECT.body, body.links[0]?.name ?? 'trunk');
        this.floorGeom = this.id(OBJECT.geom, 'floor');
        this.soleGeoms = new Set(['right_sole', 'left_sole'].map(name => this.id(OBJECT.geom, name)));
        this.linkNames = new Map(body.links.map(({ name }) => [this.id(OBJECT.body, name), name]));
        this.stepsPerSecond = 1 / this.model.opt.timestep;
        this.massKg = this.model.body_mass.reduce((sum, mass) => sum + mass, 0);
        this.hands = new Hands(this);
        mujoco.mj_forward(this.model, this.data);
    }

    /** Puts the robot on its feet in the middle of the room with these joint angles. The trunk leans so that the soles are flat. */
    begin(angleOf: (servo: number) => number, body: Body): void {
        this.mujoco.mj_resetData(this.model, this.data);
        for (const joint of body.joints) {
            const shaft = this.shafts.get(joint.servo);
            if (shaft) this.data.qpos[shaft.angleAt] = angleOf(joint.servo);
        }
        this.mujoco.mj_forward(this.model, this.data);
        const qpos = this.data.qpos;
        const up = this.soles.reduce<Vector>((sum, { link }) => add(sum, rotate(this.linkPlace(link).quat, [0, 0, 1])), [0, 0, 0]);
        const axis = cross(up, [0, 0, 1]);
        const lean = length(axis) < 1e-9 ? STILL : turn(scale(axis, 1 / length(axis)), Math.atan2(length(axis), up[2]));
        qpos.set(lean, 3);
        this.mujoco.mj_forward(this.model, this.data);
        qpos[2] = (qpos[2] ?? 0) - this.lowestSole() + CLEARANCE_M;
        this.mujoco.mj_forward(this.model, this.data);
    }

    /** look() of servo_body.h: the current angles and speeds. */
    look(shafts: Float64Array): void {
        const { qpos, qvel } = this.data;
        for (let at = 0; at < shafts.length; at += SHAFT_FIELDS) {
            const shaft = this.shafts.get(shafts[at] ?? -1);
            if (!shaft) continue;
            shafts[at + 2] = shaft.direction * ((qpos[shaft.angleAt] ?? 0) - shaft.offsetRad);
            shafts[at + 3] = shaft.direction * (qvel[shaft.speedAt] ?? 0);
        }
    }

    /** step() of servo_body.h: advances 1/1024 s with these torques. */
    step(shafts: Float64Array): void {
        const ctrl = this.data.ctrl;
        for (let at = 0; at < shafts.length; at += SHAFT_FIELDS) {
            const shaft = this.shafts.get(shafts[at] ?? -1);
            if (shaft) ctrl[shaft.torqueAt] = shaft.direction * (shafts[at + 1] ?? 0);
        }
        this.hands.pull();
        this.mujoco.mj_step(this.model, this.data);
        this.look(shafts);
    }

    setGrip(grip: Grip | null): void {
        const link = grip ? this.id(OBJECT.body, grip.link) : -1;
        this.hands.setGrip(grip && link > 0 ? { ...grip, link } : null);
    }

    /** true: holds the robot upright over its place, feet just off the floor. false: lets go within 0.4 s. */
    setHeld(held: boolean): void {
        this.hands.setHeld(held);
    }

    get held(): boolean {
        return this.hands.isHolding;
    }

    /** Tilts gravity instead of the floor; the picture tilts the floor. */
    setFloor(floor: Floor): void {
        const gravity = this.model.opt.gravity;
        gravity[0] = GRAVITY * Math.sin(floor.tiltFront) * Math.cos(floor.tiltLeft);
        gravity[1] = GRAVITY * Math.sin(floor.tiltLeft);
        gravity[2] = -GRAVITY * Math.cos(floor.tiltFront) * Math.cos(floor.tiltLeft);
        this.model.geom_friction[3 * this.floorGeom] = Math.min(Math.max(floor.friction, 0), 2);
    }

    get trunk(): Place {
        const q = this.data.qpos;
        return { pos: [q[0] ?? 0, q[1] ?? 0, q[2] ?? 0], quat: [q[3] ?? 1, q[4] ?? 0, q[5] ?? 0, q[6] ?? 0] };
    }

    /** Cosine of the trunk's tilt: 1 upright, 0 lying, -1 on its head. */
    get upright(): number {
        return rotate(this.trunk.quat, [0, 0, 1])[2];
    }

    get hasFallen(): boolean {
        return this.upright < FALLEN;
    }

    /** Upright, and only the soles touch the floor. */
    get isOnItsFeet(): boolean {
        const { floorGeom, soleGeoms } = this;
        return (
            this.upright > UPRIGHT &&
            geomTouches(this.data).every(({ geoms }) => !geoms.includes(floorGeom) || geoms.some(geom => soleGeoms.has(geom)))
        );
    }

    /** Links of the robot that touch each other now. */
    touching(): Touch[] {
        return linkTouches(geomTouches(this.data), geom => this.linkNames.get(this.model.geom_bodyid[geom] ?? -1));
    }

    /** Links that would overlap at these joint angles. This lifts the robot off the floor and leaves it there. */
    touchingIn(angleOf: (servo: number) => number): Touch[] {
        const { qpos } = this.data;
        qpos[2] = LIFTED_M;
        for (const [servo, { angleAt }] of this.shafts) qpos[angleAt] = angleOf(servo);
        this.mujoco.mj_kinematics(this.model, this.data);
        this.mujoco.mj_collision(this.model, this.data);
        return this.touching();
    }

    dispose(): void {
        this.data.delete();
        this.model.delete();
    }

    private addShaft(joint: Body['joints'][number]): void {
        const index = this.id(OBJECT.joint, joint.name);
        const motor = Array.from({ length: this.model.nu }, (_, i) => i).find(i => this.model.actuator_trnid[2 * i] === index);
        if (index < 0 || motor === undefined) throw new Error(`the body has no motor for servo ${joint.servo}`);
        this.shafts.set(joint.servo, {
            angleAt: this.model.jnt_qposadr[index] ?? 0,
            speedAt: this.model.jnt_dofadr[index] ?? 0,
            torqueAt: motor,
            direction: joint.direction,
            offsetRad: jointAngle(joint, POSITION_MIDDLE), // the shaft's angle 0 is that position
        });
    }

    private id(kind: number, name: string): number {
        return this.mujoco.mj_name2id(this.model, kind, name);
    }

    linkPlace(link: number): Place {
        const { xpos, xquat } = this.data;
        return {
            pos: [xpos[3 * link] ?? 0, xpos[3 * link + 1] ?? 0, xpos[3 * link + 2] ?? 0],
            quat: [xquat[4 * link] ?? 1, xquat[4 * link + 1] ?? 0, xquat[4 * link + 2] ?? 0, xquat[4 * link + 3] ?? 0],
        };
    }

    lowestSole(): number {
        let lowest = Infinity;
        for (const { link, corners } of this.soles) {
            const foot = this.linkPlace(link);
            for (const corner of corners) lowest = Math.min(lowest, foot.pos[2] + rotate(foot.quat, corner)[2]);
        }
        return lowest;
    }
}
