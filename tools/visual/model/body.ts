// SPDX-License-Identifier: MIT
// The robot's body as numbers: build/wasm/body.json, made from tools/body by body/body_files.py. Converts servo positions to angles and
// angles to places of the links.

import { POSITION_MAX } from './motion.ts';
import { within, turn } from './space.ts';
import type { Place, Quaternion, Vector } from './space.ts';

export interface Link {
    readonly name: string;
    /** null: the trunk, which has no parent. Parents precede their children. */
    readonly parent: string | null;
    readonly pos: Vector;
    readonly quat: Quaternion;
}

export interface Joint {
    readonly servo: number;
    readonly name: string;
    /** The link that the joint turns. */
    readonly body: string;
    readonly direction: 1 | -1;
    /** Servo position at angle 0. */
    readonly zero: number;
    /** Angle of one unit of servo position. */
    readonly radiansPerUnit: number;
    /** Radians. */
    readonly low: number;
    readonly high: number;
    readonly axis: Vector;
}

export interface Shape {
    readonly name: string | null;
    readonly body: string;
    readonly type: 'box' | 'capsule' | 'sphere' | 'cylinder';
    /** box: half edges; sphere: radius; capsule and cylinder: radius and half length along its z. */
    readonly size: readonly number[];
    readonly pos: Vector;
    readonly quat: Quaternion;
    readonly material: string;
    /** Kilograms; 0: only drawn. */
    readonly mass: number;
}

export interface Body {
    readonly name: string;
    readonly links: readonly Link[];
    readonly joints: readonly Joint[];
    readonly shapes: readonly Shape[];
    readonly materials: Readonly<Record<string, readonly [number, number, number, number]>>;
}

export function jointAngle(joint: Joint, position: number): number {
    return joint.direction * (position - joint.zero) * joint.radiansPerUnit;
}

export function servoPosition(joint: Joint, angleRad: number): number {
    return joint.zero + (joint.direction * angleRad) / joint.radiansPerUnit;
}

/** Converts units of servo position to degrees. */
export function degreesOf(joint: Joint, units: number): number {
    return (units * joint.radiansPerUnit * 180) / Math.PI;
}

/** Servo IDs of joints that mirror each other. Their names differ only in the side. */
export function jointPairs(body: Body): (readonly [right: number, left: number])[] {
    const servos = new Map(body.joints.map(joint => [joint.name, joint.servo]));
    return body.joints.flatMap(joint => {
        const left = joint.name.startsWith('right_') ? servos.get(joint.name.replace('right_', 'left_')) : undefined;
        return left === undefined ? [] : [[joint.servo, left] as const];
    });
}

export type Side = 'right' | 'left';

/** Radians by servo. */
export type Angles = ReadonlyMap<number, number>;

export function angleIn(angles: Angles): (joint: Joint) => number {
    return joint => angles.get(joint.servo) ?? 0;
}

/** Joint angles of a step or pose, from servo positions by ID. A joint without a position is taken from `others`. */
export function anglesOf(body: Body, positions: ArrayLike<number | null>, others: Angles): Angles {
    return new Map(
        body.joints.map(joint => {
            const position = positions[joint.servo] ?? null;
            return [joint.servo, position === null ? (others.get(joint.servo) ?? 0) : jointAngle(joint, position)] as const;
        }),
    );
}

/** The servo position nearest to an angle, within the limits of joint and servo. */
export function nearestPosition(joint: Joint, angleRad: number): number {
    const angle = Math.min(Math.max(angleRad, joint.low), joint.high);
    return Math.min(Math.max(Math.round(servoPosition(joint, angle)), 0), POSITION_MAX);
}

/** The places of all links. angleOf returns radians; it is called only for links that a joint turns. */
export function placeLinks(body: Body, trunk: Place, angleOf: (joint: Joint) => number): Map<string, Place> {
    const joints = new Map(body.joints.map(joint => [joint.body, joint]));
    const places = new Map<string, Place>();
    for (const link of body.links) {
        const carrier = link.parent === null ? null : places.get(link.parent);
        if (!carrier) {
            places.set(link.name, trunk);
            continue;
        }
        const joint = joints.get(link.name);
        const still = within(carrier, link);
        const turned = joint ? { pos: [0, 0, 0] as const, quat: turn(joint.axis, angleOf(joint)) } : null;
        places.set(link.name, turned ? within(still, turned) : still);
    }
    return places;
}

/** The four lower corners of a sole in the frame of its link. */
export function soleCorners(body: Body, name: string): Vector[] {
    const sole = body.shapes.find(shape => shape.name === name);
    if (!sole) return [];
    const [x = 0, y = 0, z = 0] = sole.size;
    return [
        [x, y],
        [x, -y],
        [-x, y],
        [-x, -y],
    ].map(([dx = 0, dy = 0]) => [sole.pos[0] + dx, sole.pos[1] + dy, sole.pos[2] - z]);
}
