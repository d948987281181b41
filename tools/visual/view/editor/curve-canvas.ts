// SPDX-License-Identifier: MIT
// The curves of the page, drawn from the firmware's own player at every change; their way-points are dragged: up and down
// the position, to the sides the time. By keyboard: left and right choose the step, up and down turn the chosen joints, with
// Alt left and right change the time.

import type { TickSpan } from '../../model/curve-speed.ts';
import { AS_STORED, JOINTS, POSITION_MAX, TICKS_PER_SECOND } from '../../model/motion.ts';
import type { Shape } from '../../model/motion.ts';
import type { Desk } from '../desk.ts';
import type { Gesture } from '../editor-desk.ts';
import { define, make } from '../element.ts';
import { CurveFrame, drawCurves } from './curve-picture.ts';
import type { CurveColours, CurveScene, WayPoint } from './curve-picture.ts';
import { curveScene } from './curve-scene.ts';
import { changedBy, poseAfter } from './editing.ts';
import { ServoFollow } from './servo-follow.ts';
import { nearestSetting } from './step-times.ts';

const NEAR_PX = 12;
const CHOSEN_COLOURS = ['--curve-1', '--curve-2', '--curve-3', '--curve-4', '--curve-5', '--curve-6'];

/** What a drawing shows, in numbers. */
export interface Drawn {
  /** Joints and places that are too fast. */
  readonly fast: ReadonlyMap<number, readonly TickSpan[]>;
  readonly isShaped: boolean;
  /** How far the chosen joints are behind at most, in physics (servo units); empty: not known. */
  readonly lags: ReadonlyMap<number, number>;
  /** Physics was asked and cannot tell. */
  readonly isUnknown: boolean;
}

interface Drag {
  readonly point: WayPoint;
  readonly gesture: Gesture;
  readonly scene: CurveScene;
  readonly frame: CurveFrame;
  readonly startX: number;
  readonly startY: number;
  /** What is dragged, once it is clear. */
  axis: 'position' | 'time' | null;
}

export class CurveCanvas extends HTMLElement {
  desk!: Desk; // set before it is connected
  /** After each drawing. */
  onDrawn: (drawn: Drawn) => void = () => undefined;
  private shape = AS_STORED;
  private readonly canvas = make('canvas', { tabindex: 0, role: 'img', 'aria-label': 'Curves of the joints' });
  private readonly label = make('p', { class: 'point', 'aria-hidden': true });
  private scene: CurveScene | null = null;
  private frame: CurveFrame | null = null;
  private drag: Drag | null = null;
  private keys: { readonly gesture: Gesture; readonly pose: readonly number[]; by: number } | null = null;
  private follow!: ServoFollow; // made when it is connected: it wants the desk
  private request = 0;
  private readonly disposals: (() => void)[] = [];

  connectedCallback(): void {
    this.replaceChildren(this.canvas, this.label);
    this.follow = new ServoFollow(this.desk, () => this.later());
    const { canvas } = this;
    canvas.addEventListener('pointerdown', (event) => this.down(event));
    canvas.addEventListener('pointermove', (event) => this.move(event));
    canvas.addEventListener('pointerleave', () => (this.label.textContent = ''));
    canvas.addEventListener('pointerup', () => this.end(true));
    canvas.addEventListener('pointercancel', () => this.end(false));
    canvas.addEventListener('keydown', (event) => this.key(event));
    canvas.addEventListener('keyup', () => this.keyUp());
    canvas.addEventListener('blur', () => this.keyUp());
    const sizes = new ResizeObserver(() => this.later());
    sizes.observe(this);
    const themes = new MutationObserver(() => this.later());
    themes.observe(document.documentElement, { attributeFilter: ['data-theme'] });
    this.disposals.push(() => this.follow.dispose(), () => sizes.disconnect(), () => themes.disconnect(), () => cancelAnimationFrame(this.request),
      this.desk.editor.state.watch(() => this.later()));
  }

  disconnectedCallback(): void {
    this.end(true);
    for (const dispose of this.disposals.splice(0)) dispose();
  }

  setShape(shape: Shape): void {
    this.shape = shape;
    this.later();
  }

  /** Shows where the servos are, as physics has it. */
  setFollow(on: boolean): void {
    this.follow.setOn(on);
  }

  /** One drawing a frame, however much has changed; none while the area is not shown. */
  private later(): void {
    if (this.request !== 0) return;
    this.request = requestAnimationFrame(() => {
      this.request = 0;
      if (this.clientWidth > 0) this.draw();
    });
  }

  private draw(): void {
    const scene = this.makeScene();
    const [width, height] = [this.clientWidth, this.clientHeight];
    const sharpness = Math.min(devicePixelRatio, 2);
    const [w, h] = [Math.round(width * sharpness), Math.round(height * sharpness)];
    if (this.canvas.width !== w || this.canvas.height !== h) Object.assign(this.canvas, { width: w, height: h });
    const context = this.canvas.getContext('2d');
    if (!context) return;
    context.setTransform(sharpness, 0, 0, sharpness, 0, 0);
    context.clearRect(0, 0, width, height);
    this.scene = scene;
    this.frame = scene && new CurveFrame(this.drag ? this.drag.scene : scene, width, height);
    if (scene && this.frame) drawCurves(context, this.frame, scene, this.colours());
    this.onDrawn({ fast: scene?.fast ?? new Map(), isShaped: !!scene?.stored, lags: this.lags(scene), isUnknown: this.follow.isUnknown });
  }

  private lags(scene: CurveScene | null): Map<number, number> {
    return new Map([...(scene?.chosen ?? [])].flatMap((joint) => {
      const lag = scene && this.follow.lag(scene.curve, joint);
      return lag === null ? [] : [[joint, lag] as const];
    }));
  }

  private makeScene(): CurveScene | null {
    const { shape, drag, desk: { editor, state } } = this;
    const scene = curveScene(editor, { shape, volts: state.get().where?.batteryVolts || NOMINAL_VOLTS, edges: drag?.scene ?? null });
    if (!scene) return null;
    this.follow.look(scene.curve.ticks, shape);
    return { ...scene, followed: this.follow.positions };
  }

  private colours(): CurveColours {
    const style = getComputedStyle(this);
    const colour = (name: string): string => style.getPropertyValue(name).trim();
    return {
      line: colour('--ink'), faint: colour('--curve-faint'), fast: colour('--bad'), grid: colour('--line'), text: colour('--ink-soft'),
      ground: colour('--panel-low'), chosen: CHOSEN_COLOURS.map(colour),
    };
  }

  private nearest(event: PointerEvent): WayPoint | null {
    const { scene, frame } = this;
    if (!scene || !frame) return null;
    const distance = (point: WayPoint): number => Math.hypot(frame.x(point.tick) - event.offsetX, frame.y(point.position) - event.offsetY);
    const near = scene.wayPoints.filter((point) => distance(point) < NEAR_PX).sort((a, b) => distance(a) - distance(b));
    return near[0] ?? null;
  }

  /** The joint whose curve is under the mouse. */
  private jointAt(event: PointerEvent): number | null {
    const { scene, frame } = this;
    if (!scene || !frame) return null;
    const tick = Math.min(Math.max(Math.round(frame.tick(event.offsetX)) - 1, 0), scene.curve.ticks - 1);
    const off = (joint: number): number => Math.abs(frame.y(scene.curve.goals[tick * JOINTS + joint] ?? 0) - event.offsetY);
    const [near] = [...scene.joints].sort((a, b) => off(a) - off(b));
    return near !== undefined && off(near) < NEAR_PX ? near : null;
  }

  private down(event: PointerEvent): void {
    if (event.button !== 0 || !this.scene || !this.frame) return;
    event.preventDefault(); // no text is marked
    this.canvas.focus({ preventScroll: true });
    const { editor } = this.desk;
    const point = this.nearest(event);
    if (!point) {
      const joint = this.jointAt(event);
      if (joint !== null) editor.select({ joints: new Set(event.shiftKey || event.ctrlKey ? [...editor.state.get().joints, joint] : [joint]) });
      return;
    }
    this.canvas.setPointerCapture(event.pointerId);
    editor.select({ step: point.step, steps: new Set([point.step]) });
    this.drag = { point, gesture: editor.gesture('drag'), scene: this.scene, frame: this.frame, startX: event.offsetX, startY: event.offsetY, axis: null };
  }

  private move(event: PointerEvent): void {
    const { drag } = this;
    if (!drag) return this.hover(event);
    const [dx, dy] = [event.offsetX - drag.startX, event.offsetY - drag.startY];
    drag.axis ??= Math.hypot(dx, dy) < 4 ? null : Math.abs(dx) > Math.abs(dy) ? 'time' : 'position';
    const { editor } = this.desk;
    const { page } = editor.state.get();
    const { point, gesture, frame } = drag;
    if (drag.axis === 'position') {
      const position = Math.min(Math.max(Math.round(point.position + frame.position(dy) - frame.position(0)), 0), POSITION_MAX);
      gesture.change(editor.edits.setJoints(gesture.start, page, [point.step], new Map([[point.joint, position]])));
    } else if (drag.axis === 'time' && editor.page(page).schedule === 'time') {
      const begin = drag.scene.ends[point.step]?.move ?? 0;
      const seconds = Math.max(0, begin + frame.tick(dx) - frame.tick(0)) / TICKS_PER_SECOND;
      gesture.change(editor.edits.setTime(gesture.start, page, [point.step], nearestSetting(editor, page, point.step, 'time', seconds)));
    }
  }

  private hover(event: PointerEvent): void {
    const point = this.nearest(event);
    this.canvas.classList.toggle('over-point', point !== null);
    const joint = point?.joint ?? this.jointAt(event);
    const name = this.desk.body.joints.find(({ servo }) => servo === joint)?.name.replaceAll('_', ' ') ?? '';
    this.label.textContent = joint === null ? '' : `${joint} ${name}${point ? `, step ${point.step + 1}: ${point.position}` : ''}`;
  }

  private end(keep: boolean): void {
    const { drag } = this;
    this.drag = null;
    if (keep) drag?.gesture.finish();
    else drag?.gesture.cancel();
    if (drag) this.later();
  }

  private key(event: KeyboardEvent): void {
    const { editor } = this.desk;
    const { page, step } = editor.state.get();
    const side = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    const turn = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (event.key === 'Escape') this.escape();
    else if (turn !== undefined) this.turn(turn * (event.shiftKey ? 10 : 1));
    else if (side !== undefined && event.altKey) this.changeTime(side);
    else if (side !== undefined) {
      const to = Math.min(Math.max(step + side, 0), editor.page(page).steps.length - 1);
      editor.select({ step: to, steps: new Set([to]) });
    } else return;
    event.preventDefault();
  }

  private escape(): void {
    this.end(false);
    this.keys?.gesture.cancel();
    this.keys = null;
  }

  private turn(by: number): void {
    const { editor, body } = this.desk;
    const { page, step, joints } = editor.state.get();
    if (joints.size === 0) return;
    this.keys ??= { gesture: editor.gesture('set-joints'), pose: poseAfter(editor, page, step), by: 0 };
    this.keys.by += by;
    this.keys.gesture.change(editor.edits.setJoints(this.keys.gesture.start, page, [step], changedBy(body, joints, this.keys.pose, this.keys.by)));
  }

  private changeTime(by: number): void {
    const { editor } = this.desk;
    const { page, step, document } = editor.state.get();
    const time = Math.min(Math.max((editor.page(page).steps[step]?.time ?? 0) + by, 0), 255);
    editor.dispatch(editor.edits.setTime(document, page, [step], time));
  }

  private keyUp(): void {
    this.keys?.gesture.finish();
    this.keys = null;
  }
}

/** A CM-5's eight cells: while nobody has told the voltage. */
const NOMINAL_VOLTS = 9.6;

define('curve-canvas', CurveCanvas);
