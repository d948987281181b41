// SPDX-License-Identifier: MIT
// What the room shows besides the figure: a ghost of the robot or the edited step, onion skins of the previous and next step, and the
// centre of mass with the support polygon. Display only.

import { BufferGeometry, CircleGeometry, Group, Line, LineBasicMaterial, LineLoop, Mesh, MeshBasicMaterial, Vector3 } from 'three';
import { centreOfMass, marginInside, supportPolygon } from '../../model/balance.ts';
import type { Point } from '../../model/balance.ts';
import { angleIn, placeLinks } from '../../model/body.ts';
import type { Angles, Body } from '../../model/body.ts';
import { length, subtract } from '../../model/space.ts';
import type { Place, Vector } from '../../model/space.ts';
import { RobotFigure } from '../robot-figure.ts';

export interface Posed {
    readonly trunk: Place;
    readonly angles: Angles;
}

export interface Balance {
    readonly polygon: readonly Point[];
    readonly centre: Vector;
    /** Distance of the centre of mass inside the support polygon (metres); negative: outside. */
    readonly margin: number;
}

export function balanceOf(body: Body, { trunk, angles }: Posed): Balance {
    const places = placeLinks(body, trunk, angleIn(angles));
    const centre = centreOfMass(body, places);
    const polygon = supportPolygon(body, places);
    return { polygon, centre, margin: marginInside(polygon, [centre[0], centre[1]]) };
}

const LOOKS = {
    ghost: { colour: 0x7f8b96, opacity: 0.3 },
    before: { colour: 0x3b82d8, opacity: 0.2 },
    after: { colour: 0xe39b13, opacity: 0.2 },
} as const;
export type GhostName = keyof typeof LOOKS;
const FLOOR_M = 0.0015;
const COLOURS = { good: 0x1a9a55, near: 0xe09c00, bad: 0xe5484d };
const NEAR_M = 0.008;
/** Below these differences two parts look identical: metres, and the cosine of half the angle. */
const SAME = { m: 0.004, cosine: 0.9996 };

export class PoseLayer {
    readonly root = new Group();
    private readonly body: Body;
    private readonly ghosts = new Map<GhostName, RobotFigure>();
    private readonly colour = new LineBasicMaterial();
    private readonly ground = new LineLoop(new BufferGeometry(), this.colour);
    private corners = 0;
    private readonly plumb = new Line(new BufferGeometry(), this.colour);
    private readonly spot = new Mesh(new CircleGeometry(0.007, 24), new MeshBasicMaterial());

    constructor(body: Body) {
        this.body = body;
        this.ground.frustumCulled = this.plumb.frustumCulled = false;
        this.root.add(this.ground, this.plumb, this.spot);
        this.showBalance(null);
    }

    /** The ghost named `ghost` is visible. */
    get hasGhost(): boolean {
        return this.ghosts.get('ghost')?.root.visible === true;
    }

    /** Shows or, with null, hides a ghost. Its parts that coincide with `figure` are hidden. Ghosts are made on first use. */
    show(name: GhostName, posed: Posed | null, figure: Posed | null = null): void {
        let ghost = this.ghosts.get(name);
        if (!ghost) {
            if (!posed) return;
            ghost = new RobotFigure(this.body, LOOKS[name]);
            this.ghosts.set(name, ghost);
            this.root.add(ghost.root);
        }
        ghost.root.visible = posed !== null;
        if (!posed) return;
        ghost.show(posed.trunk, posed.angles);
        ghost.hide(figure ? this.sameLinks(posed, figure) : new Set());
    }

    private sameLinks(a: Posed, b: Posed): Set<string> {
        const [left, right] = [a, b].map(({ trunk, angles }) => placeLinks(this.body, trunk, angleIn(angles)));
        return new Set(
            this.body.links
                .map(link => link.name)
                .filter(name => {
                    const [here, there] = [left?.get(name), right?.get(name)];
                    if (!here || !there) return false;
                    const cosine = Math.abs(here.quat.reduce((sum, value, i) => sum + value * (there.quat[i] ?? 0), 0));
                    return length(subtract(here.pos, there.pos)) < SAME.m && cosine > SAME.cosine;
                }),
        );
    }

    showBalance(balance: Balance | null): void {
        this.ground.visible = this.plumb.visible = this.spot.visible = balance !== null;
        if (!balance) return;
        const [x, y, z] = balance.centre;
        const colour = balance.margin < 0 ? COLOURS.bad : balance.margin < NEAR_M ? COLOURS.near : COLOURS.good;
        this.colour.color.setHex(colour);
        this.spot.material.color.setHex(colour);
        if (this.corners !== balance.polygon.length) {
            this.corners = balance.polygon.length;
            this.ground.geometry.dispose(); // three never changes the number of its points
            this.ground.geometry = new BufferGeometry();
        }
        this.ground.geometry.setFromPoints(balance.polygon.map(([px, py]) => new Vector3(px, py, FLOOR_M)));
        this.plumb.geometry.setFromPoints([new Vector3(x, y, z), new Vector3(x, y, FLOOR_M)]);
        this.spot.position.set(x, y, FLOOR_M);
    }

    dispose(): void {
        for (const figure of this.ghosts.values()) figure.dispose();
        for (const shape of [this.ground, this.plumb, this.spot]) shape.geometry.dispose();
        this.colour.dispose();
        this.spot.material.dispose();
    }
}
