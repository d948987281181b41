// SPDX-License-Identifier: MIT
// Static balance: the centre of mass and the ground that the soles cover. A robot that moves fast falls earlier; that is left to physics.

import { angleIn, placeLinks, soleCorners } from './body.ts';
import type { Angles, Body, Side } from './body.ts';
import { STILL, add, carrying, heading, rotate, scale, turn } from './space.ts';
import type { Place, Vector } from './space.ts';

export type Point = readonly [number, number];
export type Places = ReadonlyMap<string, Place>;

export const SIDES: readonly Side[] = ['right', 'left'];
export const ORIGIN: Place = { pos: [0, 0, 0], quat: STILL };
/** A corner of a sole this near to the floor touches it. */
const TOUCHES_M = 0.004;

export function centreOfMass(body: Body, places: Places): Vector {
    let sum: Vector = [0, 0, 0];
    let mass = 0;
    for (const shape of body.shapes) {
        const link = places.get(shape.body);
        if (!link || shape.mass === 0) continue;
        sum = add(sum, scale(add(link.pos, rotate(link.quat, shape.pos)), shape.mass));
        mass += shape.mass;
    }
    return mass > 0 ? scale(sum, 1 / mass) : sum;
}

/** The four corners of both soles, in room coordinates. */
function corners(body: Body, places: Places): Vector[] {
    return SIDES.flatMap(side => {
        const foot = places.get(`${side}_foot`);
        return foot ? soleCorners(body, `${side}_sole`).map(corner => add(foot.pos, rotate(foot.quat, corner))) : [];
    });
}

/** The convex hull of the sole corners that touch the floor, counter-clockwise. Empty if none does. */
export function supportPolygon(body: Body, places: Places, floorM = 0): Point[] {
    return hull(
        corners(body, places)
            .filter(corner => corner[2] < floorM + TOUCHES_M)
            .map(([x, y]) => [x, y]),
    );
}

function side(a: Point, b: Point, c: Point): number {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/** Andrew's monotone chain. */
export function hull(points: readonly Point[]): Point[] {
    const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
    const half = (list: readonly Point[]): Point[] => {
        const chain: Point[] = [];
        for (const point of list) {
            for (let a = chain.at(-2), b = chain.at(-1); a && b && side(a, b, point) <= 1e-12; a = chain.at(-2), b = chain.at(-1))
                chain.pop();
            chain.push(point);
        }
        return chain.slice(0, -1);
    };
    return sorted.length < 3 ? sorted : [...half(sorted), ...half(sorted.toReversed())];
}

/** Distance from a point to the nearest edge of a polygon of hull(), in metres. Negative outside; -Infinity if there is no polygon. */
export function marginInside(polygon: readonly Point[], point: Point): number {
    if (polygon.length < 3) return -Infinity;
    const distances = polygon.map((a, i) => {
        const b = polygon[(i + 1) % polygon.length] ?? a;
        return side(a, b, point) / Math.max(Math.hypot(b[0] - a[0], b[1] - a[1]), 1e-9);
    });
    return Math.min(...distances);
}

/** The trunk's place when this foot stands flat on the floor with the position and heading of `at`. */
export function trunkOn(body: Body, foot: Side, angles: Angles, at: Place): Place {
    const inTrunk = placeLinks(body, ORIGIN, angleIn(angles)).get(`${foot}_foot`) ?? ORIGIN;
    const lowest = Math.min(0, ...soleCorners(body, `${foot}_sole`).map(corner => corner[2]));
    return carrying({ pos: [at.pos[0], at.pos[1], -lowest], quat: turn([0, 0, 1], heading(at.quat)) }, inTrunk);
}

/** The foot that carries the robot: the one with the lower sole while the trunk is upright. The right one if they are level. */
export function lowerFoot(body: Body, angles: Angles): Side {
    const places = placeLinks(body, ORIGIN, angleIn(angles));
    const [right = 0, left = 0] = SIDES.map(one => {
        const foot = places.get(`${one}_foot`) ?? ORIGIN;
        return Math.min(...soleCorners(body, `${one}_sole`).map(corner => foot.pos[2] + rotate(foot.quat, corner)[2]));
    });
    return left < right - TOUCHES_M / 2 ? 'left' : 'right';
}
