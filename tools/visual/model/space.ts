// SPDX-License-Identifier: MIT
// Vectors, rotations and places. Metres; unit quaternions as [w, x, y, z], as in MuJoCo.

export type Vector = readonly [number, number, number];
export type Quaternion = readonly [number, number, number, number];

/** A position and an orientation. */
export interface Place {
    readonly pos: Vector;
    readonly quat: Quaternion;
}

export const STILL: Quaternion = [1, 0, 0, 0];

export function add(a: Vector, b: Vector): Vector {
    return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}

export function subtract(a: Vector, b: Vector): Vector {
    return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

export function scale(a: Vector, by: number): Vector {
    return [a[0] * by, a[1] * by, a[2] * by];
}

export function cross(a: Vector, b: Vector): Vector {
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

export function length(a: Vector): number {
    return Math.hypot(a[0], a[1], a[2]);
}

export function multiply(a: Quaternion, b: Quaternion): Quaternion {
    return [
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    ];
}

export function inverse(q: Quaternion): Quaternion {
    return [q[0], -q[1], -q[2], -q[3]];
}

export function rotate(q: Quaternion, v: Vector): Vector {
    const u: Vector = [q[1], q[2], q[3]];
    const t = scale(cross(u, v), 2);
    return add(add(v, scale(t, q[0])), cross(u, t));
}

/** A rotation about a unit axis. */
export function turn(axis: Vector, angleRad: number): Quaternion {
    const s = Math.sin(angleRad / 2);
    return [Math.cos(angleRad / 2), axis[0] * s, axis[1] * s, axis[2] * s];
}

/** The rotation about the vertical axis. Radians. */
export function heading(q: Quaternion): number {
    return Math.atan2(2 * (q[0] * q[3] + q[1] * q[2]), 1 - 2 * (q[2] * q[2] + q[3] * q[3]));
}

/** Converts a place in the frame of `outer` to the frame in which `outer` is given. */
export function within(outer: Place, inner: Place): Place {
    return { pos: add(outer.pos, rotate(outer.quat, inner.pos)), quat: multiply(outer.quat, inner.quat) };
}

/** The place of `outer` for which a place `inner` within it is at `wanted`. */
export function carrying(wanted: Place, inner: Place): Place {
    const quat = multiply(wanted.quat, inverse(inner.quat));
    return { pos: subtract(wanted.pos, rotate(quat, inner.pos)), quat };
}

/** Whether a lying robot lies on its face, not its back. The trunk's x axis points ahead, as in the body file. */
export function liesOnFace(trunk: Place): boolean {
    return rotate(trunk.quat, [1, 0, 0])[2] < 0;
}
