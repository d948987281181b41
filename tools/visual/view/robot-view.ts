// SPDX-License-Identifier: MIT
// The picture of the robot. The mouse turns the camera; on the robot it takes hold of a limb and pulls. By keyboard: the
// arrows turn the camera, and the Lab pulls by numbers.

import { jointTitle } from '../model/body.ts';
import type { RobotState } from '../robot/robot-state.ts';
import type { Desk } from './desk.ts';
import { define, make } from './element.ts';
import { PictureQuality } from './picture-quality.ts';
import { RobotScene } from './robot-scene.ts';
import type { Picked } from './robot-scene.ts';
import { TEXTS } from './texts.ts';
import './robot-view.css';

const TURN_RAD = 0.12;

export class RobotView extends HTMLElement {
  desk!: Desk; // set before it is connected
  private scene: RobotScene | null = null;
  private quality = new PictureQuality(false);
  private state: RobotState | null = null;
  private grabbed: (Picked & { target: Picked['world'] }) | null = null;
  private readonly label = make('div', { class: 'joint-label', 'aria-hidden': 'true' });
  private readonly canvas = make('canvas', { tabindex: 0, role: 'img', 'aria-label': 'The robot' });
  private readonly disposals: (() => void)[] = [];

  connectedCallback(): void {
    this.append(this.canvas, this.label);
    try {
      this.scene = new RobotScene(this.canvas, this.desk.body);
    } catch {
      this.replaceChildren(make('p', { class: 'no-picture' }, TEXTS.noWebGl));
      return;
    }
    this.quality = new PictureQuality(this.scene.isSoftware);
    this.watchSize(this.scene);
    this.watchTheme(this.scene);
    this.listen();
    this.disposals.push(this.desk.onFrame((state) => (this.state = state)));
    this.drawFrames(this.scene);
  }

  disconnectedCallback(): void {
    for (const dispose of this.disposals.splice(0)) dispose();
    this.scene?.dispose();
    this.scene = null;
  }

  tilt(front: number, left: number): void {
    this.scene?.tilt(front, left);
  }

  private drawFrames(scene: RobotScene): void {
    let request = 0;
    let beforeMs = 0;
    const draw = (nowMs: number): void => {
      request = requestAnimationFrame(draw);
      if (nowMs - beforeMs < this.quality.leastMs) return;
      if (this.quality.take(nowMs - beforeMs)) this.resize(scene);
      beforeMs = nowMs;
      if (this.state) scene.show(this.state, this.grabbed === null);
      if (this.grabbed) scene.pull(this.grabbed.link, this.grabbed.point, this.grabbed.target);
      scene.draw();
    };
    request = requestAnimationFrame(draw);
    this.disposals.push(() => cancelAnimationFrame(request));
  }

  private watchSize(scene: RobotScene): void {
    const observer = new ResizeObserver(() => this.resize(scene));
    observer.observe(this);
    this.disposals.push(() => observer.disconnect());
  }

  private resize(scene: RobotScene): void {
    scene.resize(this.clientWidth, this.clientHeight, this.quality.quality);
  }

  private watchTheme(scene: RobotScene): void {
    const paint = (): void => {
      const style = getComputedStyle(this);
      const colour = (name: string): string => style.getPropertyValue(name).trim();
      scene.paint(colour('--room'), colour('--room-floor'), colour('--room-lines'));
    };
    const dark = matchMedia('(prefers-color-scheme: dark)');
    const observer = new MutationObserver(paint);
    observer.observe(document.documentElement, { attributeFilter: ['data-theme'] });
    dark.addEventListener('change', paint);
    this.disposals.push(() => dark.removeEventListener('change', paint), () => observer.disconnect());
    paint();
  }

  private listen(): void {
    const canvas = this.canvas;
    canvas.addEventListener('pointerdown', (event) => this.grab(event), { capture: true });
    canvas.addEventListener('pointermove', (event) => this.move(event));
    canvas.addEventListener('pointerup', () => this.release());
    canvas.addEventListener('pointercancel', () => this.release());
    canvas.addEventListener('keydown', (event) => this.turnByKey(event));
  }

  private at(event: PointerEvent): readonly [number, number] {
    const box = this.canvas.getBoundingClientRect();
    return [((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2];
  }

  private grab(event: PointerEvent): void {
    const picked = event.button === 0 ? this.scene?.pick(...this.at(event)) : null;
    if (!picked || !this.scene || this.desk.state.get().source !== 'simulated') return;
    event.stopImmediatePropagation(); // the camera stays where it is
    this.scene.controls.enabled = false;
    this.canvas.setPointerCapture(event.pointerId);
    this.grabbed = { ...picked, target: picked.world };
  }

  private move(event: PointerEvent): void {
    if (!this.scene) return;
    if (!this.grabbed) return this.hover(event);
    const target = this.scene.drag(...this.at(event), this.grabbed.world);
    this.grabbed = { ...this.grabbed, target };
    this.desk.pull({ link: this.grabbed.link, point: this.grabbed.point, target });
  }

  private release(): void {
    if (!this.grabbed || !this.scene) return;
    this.grabbed = null;
    this.scene.controls.enabled = true;
    this.scene.pull(null);
    this.desk.pull(null);
  }

  private hover(event: PointerEvent): void {
    const link = this.scene?.pick(...this.at(event))?.link ?? null;
    this.scene?.figure.mark(link);
    this.canvas.classList.toggle('over-robot', link !== null);
    const joint = this.desk.body.joints.find((one) => one.body === link);
    const servo = this.state?.servos.find((one) => one.id === joint?.servo);
    this.label.hidden = !joint;
    if (joint) this.label.textContent = `${joint.servo} ${jointTitle(joint)}: ${Math.round(servo?.position ?? joint.zero)}${servo?.torque ? '' : ', limp'}`;
  }

  private turnByKey(event: KeyboardEvent): void {
    const turn = { ArrowLeft: -TURN_RAD, ArrowRight: TURN_RAD }[event.key];
    if (turn === undefined || !this.scene) return;
    event.preventDefault();
    const { object, target } = this.scene.controls;
    object.position.sub(target).applyAxisAngle(object.up, turn).add(target);
  }
}

define('robot-view', RobotView);
