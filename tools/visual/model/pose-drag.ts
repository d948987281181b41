// SPDX-License-Identifier: MIT
// Turns a drag in the picture into joint angles. A part of the body is one joint, a hand or foot that the limb follows, or the trunk, which
// moves over fixed feet. Pure: places in, angles out.

import { trunkOn } from './balance.ts';
import { angleIn, placeLinks } from './body.ts';
import type { Angles, Body, Joint, Side } from './body.ts';
import { footLimb, limbTo, reach } from './ik.ts';
import type { Reach, Target } from './ik.ts';
import { add, carrying, cross, heading, inverse, rotate, scale, subtract, turn, within } from './space.ts';
import type { Place, Vector } from './space.ts';

/** The foot that stays fixed, and its place. */
export interface Stance {
    readonly keep: Side;
    readonly at: Place;
}

export type Part =
    | { readonly kind: 'joint'; readonly joint: Joint }
    | { readonly kind: 'hand'; readonly side: Side }
    | { readonly kind: 'foot'; readonly side: Side }
    | { readonly kind: 'trunk' };

/** The robot's pose when the drag began. */
export interface Grab {
    readonly part: Part;
    readonly link: string;
    /** The grabbed point in the link's frame. */
    readonly point: Vector;
    /** The grabbed point in room coordinates. */
    readonly world: Vector;
    readonly angles: Angles;
    readonly stance: Stance;
    readonly trunk: Place;
    readonly places: ReadonlyMap<string, Place>;
}

const HERE: Place = { pos: [0, 0, 0], quat: [1, 0, 0, 0] };
const SIDES: readonly Side[] = ['right', 'left'];
const REACHED_M = 0.0005;
/** The trunk stops within 1/128 of its way where the legs end. */
const HALVINGS = 8;
const LOWER = { stepM: 0.004, mostM: 0.04 };

/** The part that a shape of the body belongs to. */
export function partOf(body: Body, shape: string | null, link: string): Part {
    for (const side of SIDES) {
        if (shape === `${side}_hand`) return { kind: 'hand', side };
        if (link === `${side}_foot`) return { kind: 'foot', side };
    }
    const joint = body.joints.find(one => one.body === link);
    return joint ? { kind: 'joint', joint } : { kind: 'trunk' };
}

/** Begins a drag. If the fixed foot itself is dragged, the other foot becomes the fixed one. */
export function grab(body: Body, shape: string | null, link: string, point: Vector, angles: Angles, stance: Stance): Grab {
    const part = partOf(body, shape, link);
    const trunk = trunkOn(body, stance.keep, angles, stance.at);
    const places = placeLinks(body, trunk, angleIn(angles));
    if (part.kind === 'foot' && part.side === stance.keep) {
        const keep: Side = stance.keep === 'right' ? 'left' : 'right';
        return grab(body, shape, link, point, angles, { keep, at: places.get(`${keep}_foot`) ?? HERE });
    }
    const place = places.get(link) ?? HERE;
    return { part, link, point, world: add(place.pos, rotate(place.quat, point)), angles, stance, trunk, places };
}

/** The angles that bring the point as near to `target` (room coordinates) as the joints allow. soleFlat: a foot keeps its sole parallel to
 *  the floor; otherwise it keeps its orientation. */
export function dragged(body: Body, held: Grab, target: Vector, soleFlat: boolean): Angles {
    switch (held.part.kind) {
        case 'joint':
            return turned(held, held.part.joint, target);
        case 'hand':
            return reach(held.angles, limbTo(body, held.link, held.point), { pos: inTrunk(held, target) }).angles;
        case 'foot':
            return movedFoot(body, held, held.part.side, target, soleFlat).angles;
        case 'trunk':
            return movedTrunk(body, held, subtract(target, held.world));
        default:
            return held.part satisfies never;
    }
}

function inTrunk(held: Grab, point: Vector): Vector {
    return rotate(inverse(held.trunk.quat), subtract(point, held.trunk.pos));
}

/** Converts a place in the room to the trunk's frame. */
function seenFrom(trunk: Place, place: Place): Target {
    const back = carrying(HERE, trunk);
    return within(back, place);
}

/** A joint's axis and a point on it, in room coordinates. */
export function jointAxis(held: Pick<Grab, 'places'>, joint: Joint): { readonly axis: Vector; readonly at: Vector } {
    const place = held.places.get(joint.body) ?? HERE;
    return { axis: rotate(place.quat, joint.axis), at: place.pos };
}

/** Turns one joint until the point is in the direction of the target, seen along the axis. */
function turned(held: Grab, joint: Joint, target: Vector): Angles {
    const { axis, at } = jointAxis(held, joint);
    const flat = (point: Vector): Vector => {
        const way = subtract(point, at);
        const along = way[0] * axis[0] + way[1] * axis[1] + way[2] * axis[2];
        return subtract(way, scale(axis, along));
    };
    const [from, to] = [flat(held.world), flat(target)];
    const side = cross(from, to);
    const by = Math.atan2(side[0] * axis[0] + side[1] * axis[1] + side[2] * axis[2], from[0] * to[0] + from[1] * to[1] + from[2] * to[2]);
    const angle = Math.min(Math.max((held.angles.get(joint.servo) ?? 0) + by, joint.low), joint.high);
    return new Map(held.angles).set(joint.servo, angle);
}

function movedFoot(body: Body, held: Grab, side: Side, target: Vector, soleFlat: boolean): Reach {
    const foot = held.places.get(`${side}_foot`) ?? HERE;
    const quat = soleFlat ? turn([0, 0, 1], heading(foot.quat)) : foot.quat;
    const pos = add(foot.pos, subtract(target, held.world));
    return reach(held.angles, footLimb(body, side), seenFrom(held.trunk, { pos, quat }));
}

/** Brings both feet as near as possible to these places under this trunk. `off`: remaining error in metres. */
function onFeet(body: Body, start: Angles, trunk: Place, feet: ReadonlyMap<Side, Place>): { angles: Angles; off: number } {
    let angles = start;
    let off = 0;
    for (const side of SIDES) {
        const found = reach(angles, footLimb(body, side), seenFrom(trunk, feet.get(side) ?? HERE));
        angles = found.angles;
        off = Math.max(off, found.offM);
    }
    return { angles, off };
}

/** Both feet keep place and orientation. If the trunk cannot move all the way, it goes as far as both legs reach. */
function movedTrunk(body: Body, held: Grab, by: Vector): Angles {
    const feet = new Map(SIDES.map(side => [side, held.places.get(`${side}_foot`) ?? HERE]));
    let angles = held.angles;
    let [near, share, far] = [0, 1, 1];
    for (let round = 0; round < HALVINGS && near < 1; round++) {
        const found = onFeet(body, angles, { pos: add(held.trunk.pos, scale(by, share)), quat: held.trunk.quat }, feet);
        if (found.off < REACHED_M) [angles, near] = [found.angles, share];
        else far = share;
        share = (near + far) / 2;
    }
    return angles;
}

/** Puts both soles flat on the floor under an upright trunk. The feet keep their position seen from above and their heading. The trunk is
 *  lowered as far as the legs need. */
export function flattened(body: Body, angles: Angles, stance: Stance): Angles {
    const trunk = trunkOn(body, stance.keep, angles, stance.at);
    const places = placeLinks(body, trunk, angleIn(angles));
    const height = places.get(`${stance.keep}_foot`)?.pos[2] ?? 0;
    const feet = new Map(
        SIDES.map(side => {
            const foot = places.get(`${side}_foot`) ?? HERE;
            return [side, { pos: [foot.pos[0], foot.pos[1], height] as const, quat: turn([0, 0, 1], heading(foot.quat)) }] as const;
        }),
    );
    let found = { angles, off: Infinity };
    for (let down = 0; down <= LOWER.mostM && found.off > REACHED_M; down += LOWER.stepM) {
        const upright = { pos: add(trunk.pos, [0, 0, -down]), quat: turn([0, 0, 1], heading(trunk.quat)) };
        found = onFeet(body, angles, upright, feet);
    }
    return found.angles;
}
