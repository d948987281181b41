// SPDX-License-Identifier: MIT
// Hands on the body in MuJoCo: one grips a limb and pulls, one holds the trunk upright over a place and lets go slowly.

import { add, cross, heading, inverse, length, multiply, rotate, scale, subtract, turn } from '../model/space.ts';
import type { Place, Quaternion, Vector } from '../model/space.ts';
import type { Data } from './mujoco.ts';

export const GRAVITY = 9.81;
/** Cosine of the trunk's tilt. Below it the soles may not be the lowest part. */
export const UPRIGHT = 0.9;
/** Metres between the floor and the soles of a robot that is held. */
export const CLEARANCE_M = 0.001;
const GRIP = { newtonPerMetre: 150, newtonSecondPerMetre: 6, limitNewton: 14 };
/** The hand that holds the trunk. Critically damped for a robot of 1.8 kg. */
const HOLD = { move: 400, moveDamp: 50, turn: 20, turnDamp: 1.6, farthestM: 0.1, liftedM: 0.36, releaseSteps: 400 };

/** What the hands need of the body. */
export interface HandledBody {
    readonly data: Data;
    /** MuJoCo's number of the trunk's link. */
    readonly trunkLink: number;
    readonly massKg: number;
    readonly stepsPerSecond: number;
    readonly trunk: Place;
    linkPlace(link: number): Place;
    /** Height of the lowest corner of the soles. Metres. */
    lowestSole(): number;
}

/** A grip on a link, given by its MuJoCo number: a point in the link's frame and its target in the room. */
export interface LinkGrip {
    readonly link: number;
    readonly point: Vector;
    readonly target: Vector;
}

export class Hands {
    private readonly body: HandledBody;
    private grip: LinkGrip | null = null;
    /** Position of the gripped point one step ago. */
    private before: Vector | null = null;
    private holdHeading = 0;
    private holdAt: Vector = [0, 0, 0];
    private holding = 0; // 1: held; between: letting go; 0: free
    private isHeld = false;
    /** The last step left forces set. */
    private wasTouched = false;

    constructor(body: HandledBody) {
        this.body = body;
    }

    setGrip(grip: LinkGrip | null): void {
        if (grip?.link !== this.grip?.link) this.before = null;
        this.grip = grip;
    }

    /** true: holds the robot upright over its place, feet just off the floor. false: lets go within 0.4 s. */
    setHeld(held: boolean): void {
        this.isHeld = held;
        if (!held) return;
        this.holding = 1;
        this.holdHeading = heading(this.body.trunk.quat);
        this.holdAt = this.body.trunk.pos;
    }

    get isHolding(): boolean {
        return this.holding > 0;
    }

    /** Sets the forces for the next step. */
    pull(): void {
        const isTouched = this.grip !== null || this.holding > 0;
        if (!isTouched && !this.wasTouched) return; // MuJoCo keeps applying a force until it is cleared
        this.wasTouched = isTouched;
        const forces = this.body.data.xfrc_applied;
        forces.fill(0);
        if (this.grip) this.pullGrip(forces, this.grip);
        if (this.holding > 0) this.pullTrunk(forces);
    }

    private pullGrip(forces: Float64Array, grip: LinkGrip): void {
        const place = this.body.linkPlace(grip.link);
        const point = add(place.pos, rotate(place.quat, grip.point));
        const speed = this.before ? scale(subtract(point, this.before), this.body.stepsPerSecond) : ([0, 0, 0] as const);
        this.before = point;
        const pull = subtract(scale(subtract(grip.target, point), GRIP.newtonPerMetre), scale(speed, GRIP.newtonSecondPerMetre));
        const force = scale(pull, Math.min(1, GRIP.limitNewton / Math.max(length(pull), 1e-9)));
        apply(forces, grip.link, force, cross(subtract(point, this.middle(grip.link)), force));
    }

    private pullTrunk(forces: Float64Array): void {
        if (!this.isHeld) this.holding = Math.max(0, this.holding - 1 / HOLD.releaseSteps);
        const {
            trunk: { pos, quat },
            trunkLink,
            massKg,
            data: { qvel },
        } = this.body;
        const speed: Vector = [qvel[0] ?? 0, qvel[1] ?? 0, qvel[2] ?? 0];
        const spin = rotate(quat, [qvel[3] ?? 0, qvel[4] ?? 0, qvel[5] ?? 0]);
        const isUpright = rotate(quat, [0, 0, 1])[2] > UPRIGHT;
        const height = isUpright ? pos[2] - this.body.lowestSole() + CLEARANCE_M : HOLD.liftedM;
        const away = subtract([this.holdAt[0], this.holdAt[1], height], pos);
        const near = scale(away, Math.min(1, HOLD.farthestM / Math.max(length(away), 1e-9)));
        const lift: Vector = [0, 0, massKg * GRAVITY];
        const force = add(add(scale(near, HOLD.move), scale(speed, -HOLD.moveDamp)), lift);
        const torque = add(
            scale(turnOf(multiply(turn([0, 0, 1], this.holdHeading), inverse(quat))), HOLD.turn),
            scale(spin, -HOLD.turnDamp),
        );
        apply(forces, trunkLink, scale(force, this.holding), scale(torque, this.holding));
    }

    /** A link's centre of mass. */
    private middle(link: number): Vector {
        const at = this.body.data.xipos;
        return [at[3 * link] ?? 0, at[3 * link + 1] ?? 0, at[3 * link + 2] ?? 0];
    }
}

/** Adds a force at the link's centre of mass and a torque to the forces already set. */
function apply(forces: Float64Array, link: number, force: Vector, torque: Vector): void {
    [...force, ...torque].forEach((value, i) => {
        forces[6 * link + i] = (forces[6 * link + i] ?? 0) + value;
    });
}

/** A rotation as axis times the shortest angle. */
function turnOf(q: Quaternion): Vector {
    const sign = q[0] < 0 ? -1 : 1;
    const sine = Math.hypot(q[1], q[2], q[3]);
    const angle = 2 * Math.atan2(sine, Math.abs(q[0]));
    return sine < 1e-9 ? [0, 0, 0] : [(q[1] / sine) * angle * sign, (q[2] / sine) * angle * sign, (q[3] / sine) * angle * sign];
}
