// SPDX-License-Identifier: MIT
// Teaching by hand: let limbs of the robot go, move them (in the picture the simulated one's, by your own hand yours), hold
// them, take the pose as a step.

import { handLimb, footLimb } from '../../model/ik.ts';
import type { Body } from '../../model/body.ts';
import type { RobotState } from '../../robot/robot-state.ts';
import type { Desk } from '../desk.ts';
import { define, make } from '../element.ts';
import type { Store } from '../store.ts';
import type { Editing } from './editing.ts';
import { TEACH_TEXTS } from './step-texts.ts';

export interface LimbGroup {
  readonly title: string;
  readonly servos: readonly number[];
}

export function limbGroups(body: Body): LimbGroup[] {
  const servos = (limb: ReturnType<typeof handLimb>): number[] => limb.links.flatMap(({ joint }) => (joint ? [joint.servo] : []));
  return [
    { title: 'Right arm', servos: servos(handLimb(body, 'right')) }, { title: 'Left arm', servos: servos(handLimb(body, 'left')) },
    { title: 'Right leg', servos: servos(footLimb(body, 'right')) }, { title: 'Left leg', servos: servos(footLimb(body, 'left')) },
  ];
}

export class TeachBar extends HTMLElement {
  desk!: Desk; // these are set before it is connected
  editing!: Store<Editing>;
  /** Takes the robot's pose as a step. */
  add: () => void = () => undefined;
  private readonly limbs = new Map<LimbGroup, HTMLButtonElement>();
  private readonly hold = make('button', { onclick: () => void this.holdAll() }, 'Hold');
  private readonly hint = make('p', { class: 'hint' });
  private limp = '';
  private readonly disposals: (() => void)[] = [];

  connectedCallback(): void {
    const row = make('div', { class: 'row' });
    for (const group of limbGroups(this.desk.body)) {
      const button = make('button', { 'aria-pressed': 'false', onclick: () => void this.toggle(group) }, group.title);
      this.limbs.set(group, button);
      row.append(button);
    }
    this.replaceChildren(make('h2', {}, 'Teach by hand: let go of'), row,
      make('div', { class: 'row' }, this.hold, make('button', { class: 'primary', onclick: () => this.add() }, 'Add step from the robot')), this.hint);
    this.disposals.push(this.desk.onFrame((robot) => this.render(robot)));
    this.say(new Set());
  }

  disconnectedCallback(): void {
    for (const dispose of this.disposals.splice(0)) dispose();
  }

  private render(robot: RobotState): void {
    const limp = robot.servos.filter((servo) => !servo.torque).map((servo) => servo.id);
    if (limp.join() === this.limp) return;
    this.limp = limp.join();
    this.say(new Set(limp));
  }

  private say(limp: ReadonlySet<number>): void {
    for (const [group, button] of this.limbs) button.setAttribute('aria-pressed', String(group.servos.every((servo) => limp.has(servo))));
    this.hold.disabled = limp.size === 0;
    const isSimulated = this.desk.state.get().source === 'simulated';
    this.hint.textContent = limp.size === 0 ? TEACH_TEXTS.stiff : isSimulated ? TEACH_TEXTS.limpSimulated : TEACH_TEXTS.limpYours;
  }

  /** Lets a limb go, or holds it where it is. */
  private async toggle(group: LimbGroup): Promise<void> {
    const isLimp = this.limbs.get(group)?.getAttribute('aria-pressed') === 'true';
    if (!isLimp) this.editing.set({ mode: 'hand', follow: false });
    await this.desk.setTorque(isLimp, group.servos);
  }

  private async holdAll(): Promise<void> {
    await this.desk.setTorque(true, this.limp === '' ? [] : this.limp.split(',').map(Number));
  }
}

define('teach-bar', TeachBar);
