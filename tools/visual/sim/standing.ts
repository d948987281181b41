// SPDX-License-Identifier: MIT
// Stands the robot on its lower foot, without physics: that foot stays in place and carries the rest. The robot cannot fall or slip. Used
// while physics loads and where it is not available.

import { placeLinks, soleCorners } from '../model/body.ts';
import type { Body, Joint } from '../model/body.ts';
import { add, carrying, heading, rotate, turn } from '../model/space.ts';
import type { Place, Vector } from '../model/space.ts';

const FEET = ['right_foot', 'left_foot'] as const;
const SOLES = { right_foot: 'right_sole', left_foot: 'left_sole' } as const;
const ORIGIN: Place = { pos: [0, 0, 0], quat: [1, 0, 0, 0] };
/** The other foot takes over when it is lower by this much, so that noise does not switch feet. */
const LOWER_M = 0.0005;

export class Standing {
    private readonly body: Body;
    private readonly corners: Record<(typeof FEET)[number], Vector[]>;
    private stance: (typeof FEET)[number] = 'right_foot';
    private foot: Place | null = null;
    trunk: Place = ORIGIN;

    constructor(body: Body) {
        this.body = body;
        this.corners = { right_foot: soleCorners(body, SOLES.right_foot), left_foot: soleCorners(body, SOLES.left_foot) };
    }

    /** Starts again with the trunk over the middle. */
    begin(): void {
        this.foot = null;
    }

    /** Updates the pose and returns the trunk's place. */
    move(angleOf: (joint: Joint) => number): Place {
        const inTrunk = placeLinks(this.body, ORIGIN, angleOf);
        const place = (foot: (typeof FEET)[number]): Place => inTrunk.get(foot) ?? ORIGIN;
        if (this.foot === null)
            this.foot = this.flat(
                { pos: [place(this.stance).pos[0], place(this.stance).pos[1], 0], quat: [1, 0, 0, 0] },
                place(this.stance),
            );
        this.trunk = carrying(this.foot, place(this.stance));
        const other = this.stance === 'right_foot' ? 'left_foot' : 'right_foot';
        if (this.lowest(other, place(other)) < this.lowest(this.stance, place(this.stance)) - LOWER_M) {
            const seen = carrying(this.trunk, { pos: [0, 0, 0], quat: [1, 0, 0, 0] });
            const world = { pos: add(seen.pos, rotate(seen.quat, place(other).pos)), quat: seen.quat };
            this.stance = other;
            this.foot = this.flat({ pos: [world.pos[0], world.pos[1], 0], quat: this.trunk.quat }, place(other));
            this.trunk = carrying(this.foot, place(other));
        }
        return this.trunk;
    }

    /** A foot flat on the ground with its current heading and its sole at height 0. */
    private flat(at: Place, inTrunk: Place): Place {
        const foot = { pos: at.pos, quat: turn([0, 0, 1], heading(at.quat) + heading(inTrunk.quat)) };
        const lowest = Math.min(0, ...this.corners[this.stance].map(corner => rotate(foot.quat, corner)[2]));
        return { pos: [foot.pos[0], foot.pos[1], -lowest], quat: foot.quat };
    }

    private lowest(foot: (typeof FEET)[number], inTrunk: Place): number {
        return Math.min(
            ...this.corners[foot].map(corner => {
                const inBody = add(inTrunk.pos, rotate(inTrunk.quat, corner));
                return this.trunk.pos[2] + rotate(this.trunk.quat, inBody)[2];
            }),
        );
    }
}
