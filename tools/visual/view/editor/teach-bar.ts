// SPDX-License-Identifier: MIT
// Teaching by hand: release limbs, move them (the simulated robot's in the picture, a real robot's by hand), hold them, add the pose as a
// step.

import { handLimb, footLimb } from '../../model/ik.ts';
import type { Body } from '../../model/body.ts';
import type { SessionState } from '../session/session.ts';
import { define, make, setDisabled } from '../element.ts';
import type { Store } from '../store.ts';
import { isPoseKnown, stillTaught } from './editing.ts';
import type { Editing } from './editing.ts';
import { TEXTS } from '../texts/texts.ts';
import { SessionElement } from '../session-element.ts';

export interface LimbGroup {
    readonly title: string;
    readonly isLeg: boolean;
    readonly servos: readonly number[];
}

export function limbGroups(body: Body): LimbGroup[] {
    const servos = (limb: ReturnType<typeof handLimb>): number[] => limb.links.flatMap(({ joint }) => (joint ? [joint.servo] : []));
    return [
        { title: TEXTS.teach.rightArm, isLeg: false, servos: servos(handLimb(body, 'right')) },
        { title: TEXTS.teach.leftArm, isLeg: false, servos: servos(handLimb(body, 'left')) },
        { title: TEXTS.teach.rightLeg, isLeg: true, servos: servos(footLimb(body, 'right')) },
        { title: TEXTS.teach.leftLeg, isLeg: true, servos: servos(footLimb(body, 'left')) },
    ];
}

export class TeachBar extends SessionElement {
    editing!: Store<Editing>; // set before it is connected
    /** Adds the robot's pose as a step. */
    add: () => void = () => undefined;
    private readonly limbs = new Map<LimbGroup, HTMLButtonElement>();
    private readonly adds = make('button', { onclick: () => this.add() }, TEXTS.teach.add);
    private readonly hold = make('button', { onclick: () => void this.holdAll() }, TEXTS.teach.hold);
    private readonly hint = make('p', { class: 'hint', role: 'status', 'aria-label': TEXTS.teach.state });
    private limp: readonly number[] = [];
    private source: SessionState['source'] = 'simulated';
    /** This bar made the simulated hand hold the body. */
    private isCarrying = false;
    /** Legs were released meanwhile. */
    private mustCarry = false;

    connectedCallback(): void {
        const row = make('div', { class: 'row' });
        for (const group of limbGroups(this.session.body)) {
            const button = make('button', { onclick: () => void this.toggle(group) }, group.title);
            this.limbs.set(group, button);
            row.append(button);
        }
        this.replaceChildren(make('h2', {}, TEXTS.teach.title), row, make('div', { class: 'row' }, this.hold, this.adds), this.hint);
        this.disposals.push(
            this.editing.watch(() => this.render()),
            this.session.state.watch(({ source }) => (source === this.source ? this.render() : this.leave(source))),
            this.session.editor.state.watch(() => this.render()),
            this.session.onFrame(({ servos }) => {
                const limp = servos.filter(servo => !servo.torque).map(servo => servo.id);
                if (limp.join() === this.limp.join()) return;
                this.takeLimp(limp);
            }),
        );
    }

    /** Takes the servos without torque. On the simulated robot a taught limb may have torque, so its button stays pressed. */
    private takeLimp(limp: readonly number[]): void {
        const { taught } = this.editing.get();
        const isSimulated = this.session.state.get().source === 'simulated';
        const still = isSimulated ? taught : stillTaught(taught, this.limp, limp);
        this.limp = limp;
        if (still.size === taught.size) this.render();
        else this.editing.set({ taught: still });
    }

    /** Another robot is used: nothing of it was released. */
    private leave(source: SessionState['source']): void {
        this.source = source;
        this.isCarrying = this.mustCarry = false;
        this.limp = [];
        this.editing.set({ taught: new Set() });
    }

    private render(): void {
        const { taught } = this.editing.get();
        const { editor } = this.session;
        this.adds.classList.toggle('primary', editor.page(editor.state.get().page).steps.length === 0); // then Play is not primary
        for (const [group, button] of this.limbs)
            button.setAttribute('aria-pressed', String(group.servos.every(servo => taught.has(servo))));
        const { source, connection } = this.session.state.get();
        const isSimulated = source === 'simulated';
        setDisabled(this.adds, !isPoseKnown(source, connection));
        setDisabled(this.hold, taught.size === 0 && this.limp.length === 0);
        this.hint.textContent = this.hold.disabled ? TEXTS.teach.stiff : isSimulated ? TEXTS.teach.limpSimulated : TEXTS.teach.limpYours;
    }

    /** Releases a limb, or holds it where it is. In the simulation a hand holds the body meanwhile: a pull at an arm would topple the
     *  robot, and limp legs do not carry it. */
    private async toggle(group: LimbGroup): Promise<void> {
        const { taught } = this.editing.get();
        const { mustCarry, source } = this;
        const isTaught = group.servos.every(servo => taught.has(servo));
        this.editing.set({ mode: 'hand', follow: false });
        this.mark(group, !isTaught);
        if (!isTaught && source === 'simulated') this.carry(group);
        const isDone = await this.session.setTorque(isTaught, group.servos);
        if (source !== this.source) return; // another robot is used by now
        if (!isDone) this.mark(group, isTaught);
        if (!isDone && !isTaught) this.mustCarry = mustCarry;
        if (isTaught === isDone) this.letStand();
    }

    private mark(group: LimbGroup, isTaught: boolean): void {
        const { taught } = this.editing.get();
        const others = [...taught].filter(servo => !group.servos.includes(servo));
        this.editing.set({ taught: new Set(isTaught ? [...others, ...group.servos] : others) });
    }

    private carry(group: LimbGroup): void {
        this.isCarrying = true;
        this.session.sim.hold(true);
        if (group.isLeg) this.mustCarry = true;
    }

    private async holdAll(): Promise<void> {
        const { taught } = this.editing.get();
        const { source } = this;
        this.editing.set({ taught: new Set() });
        const isDone = await this.session.setTorque(true, this.limp);
        if (source !== this.source) return;
        if (isDone) this.letStand();
        else this.editing.set({ taught });
    }

    /** Lets go of the body when nothing is taught any more. After teaching legs the robot may not stand, so the hand stays until Play or
     *  "Let go". */
    private letStand(): void {
        if (this.editing.get().taught.size > 0 || !this.isCarrying) return;
        this.isCarrying = false;
        if (this.mustCarry) {
            this.mustCarry = false;
            return this.session.say({ text: TEXTS.teach.handStays, tone: 'calm' });
        }
        this.session.sim.hold(false);
    }
}

define('teach-bar', TeachBar);
