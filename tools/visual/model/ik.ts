// SPDX-License-Identifier: MIT
// Inverse kinematics: the joint angles that bring a hand to a point, or a foot to a place with its sole turned as wanted. Damped least
// squares (Levenberg-Marquardt) over the joints between trunk and tip, within their limits. Pure. A drag calls it for every mouse move (0.1
// ms for a hand, 0.5 ms for a foot).

import type { Angles, Body, Joint, Link, Side } from './body.ts';
import { STILL, add, cross, inverse, length, multiply, rotate, subtract, turn, within } from './space.ts';
import type { Place, Quaternion, Vector } from './space.ts';

/** The links from the trunk to a tip, and the point of the tip that has a target. */
export interface Limb {
    readonly links: readonly { readonly link: Link; readonly joint: Joint | null }[];
    /** In the frame of the last link. */
    readonly point: Vector;
}

/** Target of the point in the trunk's frame. `quat`: target orientation of the tip. */
export interface Target {
    readonly pos: Vector;
    readonly quat?: Quaternion;
}

export interface Reach {
    /** All given angles, with those of the limb replaced, within the joints' limits. */
    readonly angles: Angles;
    /** Remaining error. */
    readonly offM: number;
    readonly offRad: number;
}

const ROUNDS = 40;
/** The search ends after this many consecutive rounds that each gain less than this share. */
const IDLE_ROUNDS = 3;
const IDLE_SHARE = 0.01;
const NEAR_M = 2e-5;
/** Metres that one radian of error weighs. */
const RADIAN_M = 0.1;
/** Beyond the first distance a limb is stuck, and other start angles are tried. Their result must be nearer by the second. */
const STUCK_M = 5e-5;
const JUMP_M = 0.01;
/** Number of start angles: an arm can reach a point in several ways, a flat foot has one way or none. */
const SPREAD = { point: 10, flat: 2 };
/** Kronecker sequence: square roots of primes fill a box evenly. */
const ROOTS = [2, 3, 5, 7, 11, 13].map(prime => Math.sqrt(prime) % 1);
const DAMPING = { first: 1e-3, least: 1e-7, most: 10 };

/** The limb that ends in `link`. Throws RangeError if the body has no such link. */
export function limbTo(body: Body, link: string, point: Vector): Limb {
    const byName = new Map(body.links.map(one => [one.name, one]));
    const joints = new Map(body.joints.map(joint => [joint.body, joint]));
    const links: { link: Link; joint: Joint | null }[] = [];
    for (let name: string | null = link; name !== null; ) {
        const found = byName.get(name);
        if (!found) throw new RangeError(`the body has no link ${name}`);
        if (found.parent !== null) links.unshift({ link: found, joint: joints.get(name) ?? null });
        name = found.parent;
    }
    return { links, point };
}

/** From shoulder to the tip of the hand. */
export function handLimb(body: Body, side: Side): Limb {
    const shape = body.shapes.find(one => one.name === `${side}_hand`);
    const point: Vector = shape ? add(shape.pos, rotate(shape.quat, [0, 0, tipSign(shape.quat) * (shape.size[1] ?? 0)])) : [0, 0, 0];
    return limbTo(body, `${side}_forearm`, point);
}

/** The sign of the capsule's lower end along its z axis. */
function tipSign(quat: Quaternion): 1 | -1 {
    return rotate(quat, [0, 0, 1])[2] < 0 ? 1 : -1;
}

/** From the hip to the ankle's axis. */
export function footLimb(body: Body, side: Side): Limb {
    return limbTo(body, `${side}_foot`, [0, 0, 0]);
}

interface Moved {
    readonly tip: Place;
    readonly point: Vector;
    /** Axis of each joint and a point on it, in the trunk's frame. */
    readonly axes: readonly { readonly axis: Vector; readonly at: Vector }[];
}

function move(limb: Limb, angles: readonly number[]): Moved {
    let place: Place = { pos: [0, 0, 0], quat: STILL };
    const axes: { axis: Vector; at: Vector }[] = [];
    for (const { link, joint } of limb.links) {
        place = within(place, link);
        if (!joint) continue;
        axes.push({ axis: rotate(place.quat, joint.axis), at: place.pos });
        place = { pos: place.pos, quat: multiply(place.quat, turn(joint.axis, angles[axes.length - 1] ?? 0)) };
    }
    return { tip: place, point: add(place.pos, rotate(place.quat, limb.point)), axes };
}

/** The shortest rotation from one orientation to another, as axis times angle. */
function turnBetween(from: Quaternion, to: Quaternion): Vector {
    const q = multiply(to, inverse(from));
    const sine = Math.hypot(q[1], q[2], q[3]);
    if (sine < 1e-12) return [0, 0, 0];
    const factor = (2 * Math.atan2(sine, Math.abs(q[0])) * (q[0] < 0 ? -1 : 1)) / sine;
    return [q[1] * factor, q[2] * factor, q[3] * factor];
}

function errorOf(moved: Moved, target: Target): number[] {
    const off = subtract(target.pos, moved.point);
    return target.quat ? [...off, ...turnBetween(moved.tip.quat, target.quat).map(r => r * RADIAN_M)] : [...off];
}

/** One column per joint: how the error decreases when the joint turns. */
function columnsOf(moved: Moved, withTurn: boolean): number[][] {
    return moved.axes.map(({ axis, at }) => {
        const way = cross(axis, subtract(moved.point, at));
        return withTurn ? [...way, ...axis.map(a => a * RADIAN_M)] : [...way];
    });
}

/** Solves A x = b by Gaussian elimination with pivoting. A is symmetric, positive definite and small. */
function solve(matrix: readonly (readonly number[])[], right: readonly number[]): number[] {
    const n = right.length;
    const rows = matrix.map((row, i) => [...row, right[i] ?? 0]);
    const at = (i: number): number[] => rows[i] ?? [];
    for (let i = 0; i < n; i++) {
        let best = i;
        for (let k = i + 1; k < n; k++) if (Math.abs(at(k)[i] ?? 0) > Math.abs(at(best)[i] ?? 0)) best = k;
        [rows[i], rows[best]] = [at(best), at(i)];
        for (let k = i + 1; k < n; k++) {
            const factor = (at(k)[i] ?? 0) / (at(i)[i] ?? 1);
            for (let j = i; j <= n; j++) at(k)[j] = (at(k)[j] ?? 0) - factor * (at(i)[j] ?? 0);
        }
    }
    const x = new Array<number>(n).fill(0);
    for (let i = n - 1; i >= 0; i--) {
        let sum = at(i)[n] ?? 0;
        for (let j = i + 1; j < n; j++) sum -= (at(i)[j] ?? 0) * (x[j] ?? 0);
        x[i] = sum / (at(i)[i] ?? 1);
    }
    return x;
}

/** The change of each joint from (J'J + damping) d = J'e. Joints that would move beyond their limit are left out. */
function change(columns: readonly (readonly number[])[], error: readonly number[], free: readonly boolean[], damping: number): number[] {
    const dot = (a: readonly number[], b: readonly number[]): number => a.reduce((sum, value, i) => sum + value * (b[i] ?? 0), 0);
    const used = columns.map((column, i) => (free[i] ? column : column.map(() => 0)));
    const matrix = used.map((a, i) => used.map((b, j) => dot(a, b) + (i === j ? damping * 1e-2 : 0)));
    return solve(
        matrix,
        used.map(column => dot(column, error)),
    );
}

function clamp(joint: Joint, angle: number): number {
    return Math.min(Math.max(angle, joint.low), joint.high);
}

function improve(limb: Limb, joints: readonly Joint[], start: readonly number[], target: Target): { angles: number[]; off: number } {
    let angles = start.map((angle, i) => {
        const joint = joints[i];
        return joint ? clamp(joint, angle) : angle;
    });
    let moved = move(limb, angles);
    let error = errorOf(moved, target);
    let damping = DAMPING.first;
    for (let round = 0, idle = 0; round < ROUNDS && idle < IDLE_ROUNDS && Math.hypot(...error) > NEAR_M; round++) {
        const next = step(limb, joints, angles, moved, error, target, damping);
        const gained = Math.hypot(...error) - Math.hypot(...next.error);
        if (gained > 0) {
            idle = gained < IDLE_SHARE * Math.hypot(...error) ? idle + 1 : 0;
            ({ angles, moved, error } = next);
            damping = Math.max(damping / 4, DAMPING.least);
        } else {
            damping *= 6;
            if (damping > DAMPING.most) break;
        }
    }
    return { angles, off: Math.hypot(...error) };
}

function step(
    limb: Limb,
    joints: readonly Joint[],
    angles: readonly number[],
    moved: Moved,
    error: readonly number[],
    target: Target,
    damping: number,
) {
    const columns = columnsOf(moved, target.quat !== undefined);
    let free = joints.map(() => true);
    let turned: number[] = [];
    for (let pass = 0; pass < 3; pass++) {
        const by = change(columns, error, free, damping);
        const wanted = angles.map((angle, i) => angle + (by[i] ?? 0));
        turned = wanted.map((angle, i) => {
            const joint = joints[i];
            return joint ? clamp(joint, angle) : angle;
        });
        const isFree = free.map((one, i) => one && (turned[i] === wanted[i] || turned[i] !== angles[i]));
        if (isFree.every((one, i) => one === free[i])) break;
        free = isFree;
    }
    const there = move(limb, turned);
    return { angles: turned, moved: there, error: errorOf(there, target) };
}

/** Turns the limb's joints so that its point comes as near to the target as possible. Starts from the given angles, so that a drag moves
 *  continuously. If that gets stuck (a stretched limb does not bend by itself, or a limit is in the way), it tries other start angles. A
 *  result that does not reach the target must be nearer by a centimetre, so that no limb jumps for less. */
export function reach(angles: Angles, limb: Limb, target: Target): Reach {
    const joints = limb.links.flatMap(({ joint }) => (joint ? [joint] : []));
    const now = joints.map(joint => angles.get(joint.servo) ?? 0);
    let best = improve(limb, joints, now, target);
    for (const start of otherStarts(joints, now, target.quat ? SPREAD.flat : SPREAD.point)) {
        if (best.off < STUCK_M) break;
        const other = improve(limb, joints, start, target);
        if (other.off < best.off - JUMP_M || other.off < STUCK_M) best = other;
    }
    const moved = move(limb, best.angles);
    const all = new Map(angles);
    for (const [i, joint] of joints.entries()) all.set(joint.servo, best.angles[i] ?? 0);
    return {
        angles: all,
        offM: length(subtract(target.pos, moved.point)),
        offRad: target.quat ? length(turnBetween(moved.tip.quat, target.quat)) : 0,
    };
}

/** First slightly bent, then spread over the joints' ranges. */
function otherStarts(joints: readonly Joint[], now: readonly number[], count: number): number[][] {
    const between = (joint: Joint, share: number): number => joint.low + share * (joint.high - joint.low);
    const bent = [0.25, 0.6].map(share => joints.map((joint, i) => (now[i] ?? 0) * (1 - share) + share * between(joint, 0.5)));
    const spread = Array.from({ length: count }, (_, k) =>
        joints.map((joint, i) => between(joint, 0.1 + 0.8 * (((k + 1) * (ROOTS[i % ROOTS.length] ?? 0)) % 1))),
    );
    return [...bent, ...spread];
}
