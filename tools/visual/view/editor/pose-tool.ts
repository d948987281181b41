// SPDX-License-Identifier: MIT
// The picture as an editor of the chosen step: shows it, and turns drags and keys into edits. One drag or one key held is one
// undo step; Escape takes it back.

import { centreOfMass, lowerFoot, marginInside, supportPolygon, trunkOn } from '../../model/balance.ts';
import { angleIn, placeLinks } from '../../model/body.ts';
import type { Angles, Body, Side } from '../../model/body.ts';
import { JOINTS, POSITION_MIDDLE } from '../../model/motion.ts';
import { dragged, grab, jointAxis } from '../../model/pose-drag.ts';
import type { Grab, Stance } from '../../model/pose-drag.ts';
import type { Place } from '../../model/space.ts';
import type { Touch } from '../../model/trial.ts';
import type { RobotState } from '../../robot/robot-state.ts';
import type { Desk } from '../desk.ts';
import type { Gesture } from '../editor-desk.ts';
import type { Picked, RobotScene } from '../robot-scene.ts';
import type { Store } from '../store.ts';
import { changedBy, changedPositions, isEditing, poseAfter, robotAngles, robotPositions, stanceOf, stepAngles } from './editing.ts';
import type { Editing } from './editing.ts';
import { changeStep, jointsOfPart } from './joint-edits.ts';
import { PoseLayer } from './pose-layer.ts';
import { TouchWatch } from './touch-watch.ts';
import type { Balance, Posed } from './pose-layer.ts';

const HERE: Place = { pos: [0, 0, 0], quat: [1, 0, 0, 0] };
/** Poses that differ less than this need no ghost (radians). */
const SAME_RAD = 0.02;
const KEY_UNITS = { fine: 1, coarse: 10 };

interface Drag {
  readonly held: Grab;
  readonly picked: Picked;
  gesture: Gesture | null;
}

export class PoseTool {
  readonly layer: PoseLayer;
  private readonly scene: RobotScene;
  private readonly desk: Desk;
  private readonly editing: Store<Editing>;
  private readonly body: Body;
  private drag: Drag | null = null;
  private keys: { readonly gesture: Gesture; readonly pose: readonly number[]; by: number } | null = null;
  private robot: RobotState | null = null;
  /** Of what is shown as the edited step; null: nothing is. */
  private balance: Balance | null = null;
  private readonly touchWatch: TouchWatch;

  constructor(scene: RobotScene, desk: Desk, editing: Store<Editing>) {
    this.scene = scene;
    this.desk = desk;
    this.editing = editing;
    this.body = desk.body;
    this.layer = new PoseLayer(desk.body);
    this.touchWatch = new TouchWatch(desk.trials);
    scene.add(this.layer.root);
  }

  /** Drags in the picture change the step. */
  get isPosing(): boolean {
    return isEditing(this.desk.state.get().tab) && this.editing.get().mode === 'pose';
  }

  get isDragging(): boolean {
    return this.drag !== null;
  }

  /** Metres inside the ground of the soles; null: not looked at. */
  get margin(): number | null {
    return this.balance?.margin ?? null;
  }

  /** Limbs of the shown figure that are in each other. */
  get touches(): readonly Touch[] {
    return this.touchWatch.touches;
  }

  /** Puts figure and ghosts where they belong; true when the figure is the edited step. */
  show(robot: RobotState): boolean {
    this.robot = robot;
    const real: Posed = { trunk: robot.trunk, angles: robotAngles(this.body, robot) };
    const edited = isEditing(this.desk.state.get().tab) ? this.edited(this.shownAngles()) : null;
    const isPosing = edited !== null && this.isPosing;
    const alarms = new Set(robot.servos.filter((servo) => servo.alarms !== 0).map((servo) => servo.id));
    const figure = isPosing && edited ? edited : real;
    this.scene.figure.touch(new Set(this.touches.flatMap(({ links }) => links)));
    this.scene.figure.show(figure.trunk, figure.angles, isPosing ? new Set() : alarms);
    this.scene.figure.choose(isPosing ? this.chosenLinks() : new Set());
    const other = isPosing ? real : edited;
    this.layer.show('ghost', other && edited && !isSame(real.angles, edited.angles) ? other : null, figure);
    this.showOnion(edited, figure);
    this.balance = edited && this.editing.get().balance ? this.balanceOf(edited) : null;
    this.layer.showBalance(this.balance);
    this.touchWatch.look(edited ? (isPosing ? this.shownPose() : robotPose(robot)) : null);
    return isPosing;
  }

  /** Takes hold of what is under the mouse: picks its joints. add: beside those that are chosen. */
  down(picked: Picked, add: boolean): void {
    const held = grab(this.body, picked.shape, picked.link, picked.point, this.shownAngles(), this.stance(this.shownAngles()));
    const joints = jointsOfPart(this.body, held.part);
    const { joints: chosen } = this.desk.editor.state.get();
    this.desk.editor.select({ joints: new Set(add ? [...chosen, ...joints] : joints) });
    this.drag = { held, picked, gesture: null };
  }

  move(x: number, y: number): void {
    const { drag } = this;
    if (!drag) return;
    const { held } = drag;
    const target = held.part.kind === 'joint'
      ? this.scene.dragInPlane(x, y, held.world, jointAxis(held, held.part.joint).axis) : this.scene.drag(x, y, held.world);
    const positions = changedPositions(this.body, held.angles, dragged(this.body, held, target, this.editing.get().soleFlat));
    drag.gesture ??= this.desk.editor.gesture('set-joints');
    drag.gesture.change(changeStep(this.desk.editor, drag.gesture.start, positions, this.robot));
  }

  /** The end of a drag. keep: false takes it back. */
  up(keep: boolean): void {
    const gesture = this.drag?.gesture;
    this.drag = null;
    if (keep) gesture?.finish();
    else gesture?.cancel();
  }

  /** true: the key was meant for this. Left and right choose a joint, up and down turn what is chosen. */
  key(event: KeyboardEvent): boolean {
    if (event.key === 'Escape') return this.escape();
    const turn = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    const next = event.shiftKey ? undefined : { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (next !== undefined) this.chooseNext(next);
    else if (turn !== undefined) this.turn(turn * (event.shiftKey ? KEY_UNITS.coarse : KEY_UNITS.fine));
    else return false;
    return true;
  }

  /** The arrow was let go: what it turned is one edit. */
  keyUp(): void {
    this.keys?.gesture.finish();
    this.keys = null;
  }

  dispose(): void {
    this.up(true);
    this.keyUp();
    this.layer.dispose();
  }

  private escape(): boolean {
    const isOpen = this.drag !== null || this.keys !== null;
    this.up(false);
    this.keys?.gesture.cancel();
    this.keys = null;
    if (!isOpen) this.desk.editor.select({ joints: new Set() });
    return true;
  }

  private turn(by: number): void {
    const { editor } = this.desk;
    if (editor.state.get().joints.size === 0) this.chooseNext(1);
    this.keys ??= { gesture: editor.gesture('set-joints'), pose: this.shownPose(), by: 0 };
    this.keys.by += by;
    const positions = changedBy(this.body, editor.state.get().joints, this.keys.pose, this.keys.by);
    this.keys.gesture.change(changeStep(editor, this.keys.gesture.start, positions, this.robot));
  }

  private chooseNext(by: number): void {
    const ids = this.body.joints.map((joint) => joint.servo).sort((a, b) => a - b);
    const [first] = [...this.desk.editor.state.get().joints].sort((a, b) => a - b);
    const at = first === undefined ? (by > 0 ? -1 : 0) : ids.indexOf(first);
    const id = ids[(at + by + ids.length) % ids.length];
    if (id !== undefined) this.desk.editor.select({ joints: new Set([id]) });
  }

  /** Angles of the edited step; of the robot where the page has no step yet. */
  private shownAngles(): Angles {
    const { editor } = this.desk;
    const { page, step } = editor.state.get();
    if (editor.page(page).steps.length === 0 && this.robot) return robotAngles(this.body, this.robot);
    return stepAngles(editor, this.body, page, step);
  }

  /** Servo units by ID of what is edited. */
  shownPose(): number[] {
    const { editor } = this.desk;
    const { page, step } = editor.state.get();
    const pose = poseAfter(editor, page, step);
    if (editor.page(page).steps.length > 0 || !this.robot) return pose;
    return robotPositions(this.robot).map((position, id) => position ?? pose[id] ?? 0);
  }

  private stance(angles: Angles): Stance {
    return stanceOf(this.body, this.editing.get(), angles, this.feet());
  }

  /** Where the robot has its feet: there the edited step stands too. */
  private feet(): Record<Side, Place> {
    const { robot } = this;
    const places = robot ? placeLinks(this.body, robot.trunk, angleIn(robotAngles(this.body, robot))) : null;
    return { right: places?.get('right_foot') ?? HERE, left: places?.get('left_foot') ?? HERE };
  }

  private edited(angles: Angles): Posed {
    const stance = this.drag?.held.stance ?? this.stance(angles);
    return { trunk: trunkOn(this.body, stance.keep, angles, stance.at), angles };
  }

  private showOnion(edited: Posed | null, figure: Posed): void {
    const { editor } = this.desk;
    const { page, step } = editor.state.get();
    const count = editor.page(page).steps.length;
    const skin = (at: number): Posed | null => {
      if (!edited || !this.editing.get().onionSkin || at < 0 || at >= count) return null;
      const angles = stepAngles(editor, this.body, page, at);
      const keep = this.editing.get().keep;
      const foot = keep === 'lower' ? lowerFoot(this.body, angles) : keep;
      return { trunk: trunkOn(this.body, foot, angles, this.feet()[foot]), angles };
    };
    this.layer.show('before', skin(step - 1), figure);
    this.layer.show('after', skin(step + 1), figure);
  }

  private chosenLinks(): Set<string> {
    const { joints } = this.desk.editor.state.get();
    return new Set(this.body.joints.filter((joint) => joints.has(joint.servo)).map((joint) => joint.body));
  }

  private balanceOf({ trunk, angles }: Posed): Balance {
    const places = placeLinks(this.body, trunk, angleIn(angles));
    const centre = centreOfMass(this.body, places);
    const polygon = supportPolygon(this.body, places);
    return { polygon, centre, margin: marginInside(polygon, [centre[0], centre[1]]) };
  }
}

/** Servo units by ID, as the robot stands. */
function robotPose(robot: RobotState): number[] {
  const pose = new Array<number>(JOINTS).fill(POSITION_MIDDLE);
  for (const { id, position } of robot.servos) pose[id] = Math.round(position);
  return pose;
}

function isSame(a: Angles, b: Angles): boolean {
  return [...a].every(([servo, angle]) => Math.abs(angle - (b.get(servo) ?? 0)) < SAME_RAD);
}
