// SPDX-License-Identifier: MIT
// What a drag in the picture means for the joints. A part of the body is one joint that turns, a hand or a foot that the rest
// of its limb follows, or the trunk, which moves over feet that stay. Pure: places in, angles out.

import { trunkOn } from './balance.ts';
import { angleIn, placeLinks } from './body.ts';
import type { Angles, Body, Joint, Side } from './body.ts';
import { footLimb, limbTo, reach } from './ik.ts';
import type { Reach, Target } from './ik.ts';
import { add, carrying, cross, heading, inverse, rotate, scale, subtract, turn, within } from './space.ts';
import type { Place, Vector } from './space.ts';

/** The foot that stays where it is, and where that is. */
export interface Stance {
    readonly keep: Side;
    readonly at: Place;
}

export type Part =
    | { readonly kind: 'joint'; readonly joint: Joint }
    | { readonly kind: 'hand'; readonly side: Side }
    | { readonly kind: 'foot'; readonly side: Side }
    | { readonly kind: 'trunk' };

/** How the robot stood when it was taken hold of. */
export interface Grab {
    readonly part: Part;
    readonly link: string;
    /** Where on the link, in its frame, and in the room. */
    readonly point: Vector;
    readonly world: Vector;
    readonly angles: Angles;
    readonly stance: Stance;
    readonly trunk: Place;
    readonly places: ReadonlyMap<string, Place>;
}

const HERE: Place = { pos: [0, 0, 0], quat: [1, 0, 0, 0] };
const SIDES: readonly Side[] = ['right', 'left'];
const REACHED_M = 0.0005;
const LOWER = { stepM: 0.004, mostM: 0.04 };

/** Which part a shape of the body belongs to. */
export function partOf(body: Body, shape: string | null, link: string): Part {
    for (const side of SIDES) {
        if (shape === `${side}_hand`) return { kind: 'hand', side };
        if (link === `${side}_foot`) return { kind: 'foot', side };
    }
    const joint = body.joints.find(one => one.body === link);
    return joint ? { kind: 'joint', joint } : { kind: 'trunk' };
}

/** A hand takes hold. A foot that is moved cannot be the one that stays: then the other one does. */
export function grab(body: Body, shape: string | null, link: string, point: Vector, angles: Angles, stance: Stance): Grab {
    const part = partOf(body, shape, link);
    const trunk = trunkOn(body, stance.keep, angles, stance.at);
    const places = placeLinks(body, trunk, angleIn(angles));
    const other: Side = stance.keep === 'right' ? 'left' : 'right';
    const isKept = part.kind === 'foot' && part.side === stance.keep;
    const kept = isKept ? { keep: other, at: places.get(`${other}_foot`) ?? HERE } : stance;
    const place = places.get(link) ?? HERE;
    return { part, link, point, world: add(place.pos, rotate(place.quat, point)), angles, stance: kept, trunk, places };
}

/** The angles that bring the point to `target` (in the room), as near as the joints let it. soleFlat: a foot keeps its sole
 *  flat on the floor or parallel to it; otherwise it keeps how it was turned. */
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

/** The place in the trunk's frame of what stands at `place` in the room. */
function seenFrom(trunk: Place, place: Place): Target {
    const back = carrying(HERE, trunk);
    return within(back, place);
}

/** The axis of a joint and a point on it, in the room. */
export function jointAxis(held: Pick<Grab, 'places'>, joint: Joint): { readonly axis: Vector; readonly at: Vector } {
    const place = held.places.get(joint.body) ?? HERE;
    return { axis: rotate(place.quat, joint.axis), at: place.pos };
}

/** One joint turns until the point is in the direction of the target, seen along the axis. */
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

/** Puts both feet at these places under this trunk, as well as they can; `off`: what is missing, in metres. */
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

/** Both feet stay where they are and as they are. Farther than the legs allow it goes as far as both reach. */
function movedTrunk(body: Body, held: Grab, by: Vector): Angles {
    const feet = new Map(SIDES.map(side => [side, held.places.get(`${side}_foot`) ?? HERE]));
    for (const share of [1, 0.75, 0.5, 0.25]) {
        const found = onFeet(body, held.angles, { pos: add(held.trunk.pos, scale(by, share)), quat: held.trunk.quat }, feet);
        if (found.off < REACHED_M) return found.angles;
    }
    return held.angles;
}

/** Both soles flat on the floor under an upright trunk, where they are seen from above, their headings as they are. The trunk
 *  goes down as far as the legs need. */
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
