// SPDX-License-Identifier: MIT
// The robot as three's objects, made from the body's numbers. It shows what it is told and holds nothing itself.

import { BufferGeometry, CapsuleGeometry, Color, CylinderGeometry, Group, Mesh, MeshStandardMaterial, Object3D, SphereGeometry, Vector3 } from 'three';
import { RoundedBoxGeometry } from 'three/examples/jsm/geometries/RoundedBoxGeometry.js';
import { jointAngle } from '../model/body.ts';
import type { Body, Joint, Shape } from '../model/body.ts';
import type { Place } from '../model/space.ts';
import type { ServoState } from '../robot/robot-state.ts';

const ROUND = 0.0035;
const HIGHLIGHT = new Color(0x2f9bff);
const ALARM = new Color(0xe5484d);

function geometryOf(shape: Shape): BufferGeometry {
  const [a = 0.01, b = 0.01, c = 0.01] = shape.size;
  switch (shape.type) {
    case 'box': return new RoundedBoxGeometry(2 * a, 2 * b, 2 * c, 3, Math.min(ROUND, a, b, c));
    case 'sphere': return new SphereGeometry(a, 24, 16);
    case 'capsule': return new CapsuleGeometry(a, 2 * b, 8, 24).rotateX(Math.PI / 2);
    case 'cylinder': return new CylinderGeometry(a, a, 2 * b, 28).rotateX(Math.PI / 2);
    default: return shape.type satisfies never;
  }
}

function put(object: Object3D, place: Place): void {
  object.position.set(...place.pos);
  object.quaternion.set(place.quat[1], place.quat[2], place.quat[3], place.quat[0]);
}

interface JointGroup {
  readonly joint: Joint;
  readonly group: Group;
  readonly axis: Vector3;
}

export class RobotFigure {
  readonly root = new Group();
  /** What can be picked; `userData.link` names the link. */
  readonly meshes: Mesh[] = [];
  private readonly joints = new Map<number, JointGroup>();
  private readonly links = new Map<string, Group>();
  private readonly materials = new Map<string, MeshStandardMaterial[]>();
  private marked: string | null = null;

  constructor(body: Body) {
    const jointOf = new Map(body.joints.map((joint) => [joint.body, joint]));
    for (const link of body.links) this.addLink(link, jointOf.get(link.name));
    for (const shape of body.shapes) this.addShape(shape, body);
  }

  /** Where the trunk is and how the joints stand. */
  show(trunk: Place, servos: readonly ServoState[]): void {
    put(this.root, trunk);
    for (const servo of servos) {
      const found = this.joints.get(servo.id);
      if (!found) continue;
      found.group.quaternion.setFromAxisAngle(found.axis, jointAngle(found.joint, servo.position));
      this.tint(found.joint.body, servo.alarms !== 0);
    }
  }

  /** Lights up one link; null: none. */
  mark(link: string | null): void {
    this.marked = link;
  }

  link(name: string): Object3D | undefined {
    return this.links.get(name);
  }

  dispose(): void {
    for (const mesh of this.meshes) mesh.geometry.dispose();
    for (const list of this.materials.values()) list.forEach((material) => material.dispose());
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
    const material = new MeshStandardMaterial({ color: new Color().setRGB(r, g, b, 'srgb'), roughness: isMetal ? 0.42 : 0.55, metalness: isMetal ? 0.35 : 0.05 });
    const mesh = new Mesh(geometryOf(shape), material);
    put(mesh, shape);
    mesh.castShadow = mesh.receiveShadow = true;
    mesh.userData['link'] = shape.body;
    this.links.get(shape.body)?.add(mesh);
    this.meshes.push(mesh);
    this.materials.set(shape.body, [...(this.materials.get(shape.body) ?? []), material]);
  }

  private tint(link: string, hasAlarm: boolean): void {
    for (const material of this.materials.get(link) ?? []) {
      material.emissive = hasAlarm ? ALARM : HIGHLIGHT;
      material.emissiveIntensity = hasAlarm ? 0.55 : link === this.marked ? 0.35 : 0;
    }
  }
}
