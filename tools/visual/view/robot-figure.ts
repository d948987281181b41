// SPDX-License-Identifier: MIT
// The robot as three's objects, built from the body's numbers. It only displays; it holds no state of the robot.

import { CapsuleGeometry, Color, CylinderGeometry, Group, Mesh, MeshStandardMaterial, SphereGeometry, Vector3 } from 'three';
import type { BufferGeometry, Object3D } from 'three';
import { RoundedBoxGeometry } from 'three/examples/jsm/geometries/RoundedBoxGeometry.js';
import type { Angles, Body, Joint, Shape } from '../model/body.ts';
import type { Place } from '../model/space.ts';

const ROUND = 0.0035;
const HIGHLIGHT = new Color(0x2f9bff);
const ALARM = new Color(0xe5484d);
const TOUCH = new Color(0xe09c00);
const LIT = new Color(0xff5a3c);
/** Shapes of the board's LEDs in the body, by bit. */
const LAMPS = ['power', 'txd', 'rxd', 'aux', 'manage', 'program', 'play'].map(name => `lamp_${name}`);
/** The lamps stand on the trunk's back and reach 4 mm out of it. To an eye before their plane by more than this sine of the angle (30
 *  degrees) the trunk hides them. */
const LAMPS_END = 0.5;
/** Materials of small, flat parts: their shadows would be barely visible, but costly. */
const WITHOUT_SHADOW: readonly string[] = ['horn', 'lamp'];
const NO_ALARMS: ReadonlySet<number> = new Set();

function geometryOf(shape: Shape): BufferGeometry {
    const [a = 0.01, b = 0.01, c = 0.01] = shape.size;
    switch (shape.type) {
        case 'box':
            return new RoundedBoxGeometry(2 * a, 2 * b, 2 * c, 3, Math.min(ROUND, a, b, c));
        case 'sphere':
            return new SphereGeometry(a, 24, 16);
        case 'capsule':
            return new CapsuleGeometry(a, 2 * b, 8, 24).rotateX(Math.PI / 2);
        case 'cylinder':
            return new CylinderGeometry(a, a, 2 * b, 28).rotateX(Math.PI / 2);
        default:
            return shape.type satisfies never;
    }
}

function put(object: Object3D, place: Place): void {
    object.position.set(...place.pos);
    object.quaternion.set(place.quat[1], place.quat[2], place.quat[3], place.quat[0]);
}

/** A ghost is translucent, casts no shadow and cannot be picked. */
export interface GhostLook {
    readonly colour: number;
    readonly opacity: number;
}

interface JointGroup {
    readonly joint: Joint;
    readonly group: Group;
    readonly axis: Vector3;
}

export class RobotFigure {
    readonly root = new Group();
    /** Pickable meshes; `userData.link` names the link, `userData.shape` the shape. */
    readonly meshes: Mesh[] = [];
    private readonly joints = new Map<number, JointGroup>();
    private readonly links = new Map<string, Group>();
    private readonly materials = new Map<string, MeshStandardMaterial[]>();
    private readonly lamps = new Map<string, Mesh<BufferGeometry, MeshStandardMaterial>>();
    private readonly ghost: GhostLook | null;
    /** Links that show() highlights: under the mouse, being edited, intersecting. */
    marked: string | null = null;
    chosen: ReadonlySet<string> = new Set();
    touching: ReadonlySet<string> = new Set();

    constructor(body: Body, ghost: GhostLook | null = null) {
        this.ghost = ghost;
        const jointOf = new Map(body.joints.map(joint => [joint.body, joint]));
        for (const link of body.links) this.addLink(link, jointOf.get(link.name));
        for (const shape of body.shapes) this.addShape(shape, body);
    }

    /** Sets trunk and joint angles, and colours the links. alarms: servos that report a fault. */
    show(trunk: Place, angles: Angles, alarms: ReadonlySet<number> = NO_ALARMS): void {
        put(this.root, trunk);
        for (const { joint, group, axis } of this.joints.values()) group.quaternion.setFromAxisAngle(axis, angles.get(joint.servo) ?? 0);
        if (this.ghost) return;
        const alarmed = new Set([...alarms].map(servo => this.joints.get(servo)?.joint.body));
        for (const [link, materials] of this.materials) this.tint(materials, alarmed.has(link), link);
    }

    /** Sets the board's LEDs, one per bit. */
    light(bits: number): void {
        for (const [bit, name] of LAMPS.entries()) this.lamps.get(name)?.material.emissive.set((bits >> bit) & 1 ? LIT : 0x000000);
    }

    /** Leaves out the LEDs that cannot be seen from here (a place in the world), so that they blink without a new picture. */
    hideLamps(eye: Vector3): void {
        this.root.updateWorldMatrix(true, false);
        const from = this.root.worldToLocal(eye.clone());
        for (const lamp of this.lamps.values()) lamp.visible = from.clone().sub(lamp.position).normalize().x < LAMPS_END;
    }

    /** An LED is in the picture, or would be. */
    get hasLamps(): boolean {
        return [...this.lamps.values()].some(lamp => lamp.visible);
    }

    /** Hides the parts of these links, and shows all others. A ghost needs no parts that coincide with the figure's. */
    hide(links: ReadonlySet<string>): void {
        for (const mesh of this.meshes) mesh.visible = !links.has(String(mesh.userData.link));
    }

    link(name: string): Object3D | undefined {
        return this.links.get(name);
    }

    dispose(): void {
        for (const mesh of this.meshes) mesh.geometry.dispose();
        for (const materials of this.materials.values()) for (const one of materials) one.dispose();
        for (const lamp of this.lamps.values()) lamp.material.dispose();
    }

    private addLink(link: Body['links'][number], joint: Joint | undefined): void {
        const turned = new Group();
        if (link.parent === null) {
            this.links.set(link.name, this.root);
            return;
        }
        const still = new Group();
        put(still, link);
        still.add(turned);
        this.links.get(link.parent)?.add(still);
        this.links.set(link.name, turned);
        if (joint) this.joints.set(joint.servo, { joint, group: turned, axis: new Vector3(...joint.axis) });
    }

    private addShape(shape: Shape, body: Body): void {
        const [r = 1, g = 1, b = 1] = body.materials[shape.material] ?? [];
        const isMetal = shape.material === 'bracket';
        const material = this.ghost
            ? new MeshStandardMaterial({
                  color: this.ghost.colour,
                  transparent: true,
                  opacity: this.ghost.opacity,
                  depthWrite: false,
                  roughness: 0.8,
              })
            : new MeshStandardMaterial({
                  color: new Color().setRGB(r, g, b, 'srgb'),
                  roughness: isMetal ? 0.42 : 0.55,
                  metalness: isMetal ? 0.35 : 0.05,
              });
        const mesh = new Mesh(geometryOf(shape), material);
        put(mesh, shape);
        mesh.receiveShadow = this.ghost === null;
        mesh.castShadow = this.ghost === null && !WITHOUT_SHADOW.includes(shape.material);
        mesh.userData.link = shape.body;
        mesh.userData.shape = shape.name;
        this.links.get(shape.body)?.add(mesh);
        this.meshes.push(mesh);
        if (LAMPS.includes(shape.name ?? '') && !this.ghost)
            this.lamps.set(shape.name ?? '', mesh); // only light() changes its glow
        else this.materials.set(shape.body, [...(this.materials.get(shape.body) ?? []), material]);
    }

    private tint(materials: readonly MeshStandardMaterial[], hasAlarm: boolean, link: string): void {
        const touches = this.touching.has(link);
        for (const material of materials) {
            material.emissive = hasAlarm ? ALARM : touches ? TOUCH : HIGHLIGHT;
            material.emissiveIntensity = hasAlarm || touches ? 0.55 : this.chosen.has(link) ? 0.6 : link === this.marked ? 0.35 : 0;
        }
    }
}
