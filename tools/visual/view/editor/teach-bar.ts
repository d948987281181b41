// SPDX-License-Identifier: MIT
// Teaching by hand: release limbs, move them (the simulated robot's in the picture, a real robot's by hand), hold them, add the pose as a
// step.

import { handLimb, footLimb } from '../../model/ik.ts';
import type { Body } from '../../model/body.ts';
import { define, make, setDisabled } from '../element.ts';
import type { Store } from '../store.ts';
import { isPoseKnown } from './editing.ts';
import type { Editing } from './editing.ts';
import { Teaching } from './teaching.ts';
import type { LimbGroup } from './teaching.ts';
import { TEXTS } from '../texts/texts.ts';
import { SessionElement } from '../session-element.ts';

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
    private readonly hold = make('button', { onclick: () => void this.teaching.holdAll() }, TEXTS.teach.hold);
    private readonly hint = make('p', { class: 'hint', role: 'status', 'aria-label': TEXTS.teach.state });
    private teaching!: Teaching; // set when it is connected

    connectedCallback(): void {
        this.teaching = new Teaching(this.session, this.editing);
        const row = make('div', { class: 'row' });
        for (const group of limbGroups(this.session.body)) {
            const button = make('button', { onclick: () => void this.teaching.toggle(group) }, group.title);
            this.limbs.set(group, button);
            row.append(button);
        }
        this.replaceChildren(make('h2', {}, TEXTS.teach.title), row, make('div', { class: 'row' }, this.hold, this.adds), this.hint);
        this.disposals.push(
            this.editing.watch(() => this.render()),
            this.session.state.watch(({ source }) => {
                this.teaching.use(source);
                this.render();
            }),
            this.session.editor.state.watch(() => this.render()),
            this.session.onFrame(robot => this.teaching.take(robot) && this.render()),
        );
    }

    private render(): void {
        const { taught } = this.editing.get();
        const { editor } = this.session;
        this.adds.classList.toggle('primary', editor.page(editor.state.get().page).steps.length === 0); // then Play is not primary
        for (const [group, button] of this.limbs) button.setAttribute('aria-pressed', String(this.teaching.isTaught(group)));
        const { source, connection } = this.session.state.get();
        const isSimulated = source === 'simulated';
        setDisabled(this.adds, !isPoseKnown(source, connection));
        setDisabled(this.hold, taught.size === 0 && this.teaching.limp.length === 0);
        this.hint.textContent = this.hold.disabled ? TEXTS.teach.stiff : isSimulated ? TEXTS.teach.limpSimulated : TEXTS.teach.limpYours;
    }
}

define('teach-bar', TeachBar);
