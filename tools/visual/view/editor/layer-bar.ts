// SPDX-License-Identifier: MIT
// Controls for what runs in parallel to a play: an overlaid page, joints moved by code. The robot does all of it.

import { jointAngle, nearestPosition } from '../../model/body.ts';
import type { Joint } from '../../model/body.ts';
import { pageOf } from '../../model/document.ts';
import { POSITION_MAX, POSITION_MIDDLE } from '../../model/motion.ts';
import { define, make, setDisabled, setText } from '../element.ts';
import { jointTitle, layersText } from '../texts/robot.ts';
import { TEXTS } from '../texts/texts.ts';
import { SessionElement } from '../session-element.ts';
import './layer-bar.css';

const AIM_DEGREES_S = 90;

export class LayerBar extends SessionElement {
    private readonly page = make('select', { 'aria-label': TEXTS.layers.motion });
    private readonly joints = make(
        'select',
        { 'aria-label': TEXTS.layers.joints },
        make('option', { value: 'own' }, TEXTS.layers.ownJoints),
        make('option', { value: 'chosen' }, TEXTS.layers.chosenJoints),
    );
    private readonly position = make('input', {
        type: 'number',
        min: 0,
        max: POSITION_MAX,
        value: POSITION_MIDDLE,
        'aria-label': TEXTS.servos.position,
    });
    private readonly amplitude = make('input', {
        type: 'number',
        min: 1,
        max: POSITION_MIDDLE,
        value: 60,
        'aria-label': TEXTS.layers.swingBy,
    });
    private readonly seconds = make('input', {
        type: 'number',
        min: 0.125,
        max: 30,
        step: 0.125,
        value: 2,
        'aria-label': TEXTS.layers.swingSeconds,
    });
    private readonly byCode = make('div', { class: 'by-code' });
    private readonly jointName = make('span', { class: 'joint' });
    private readonly status = make('p', { class: 'hint', role: 'status', 'aria-label': TEXTS.layers.state });
    private readonly startPlay = make('button', { onclick: () => this.session.runImage('play') }, TEXTS.layers.startPlay);
    private readonly actions: readonly HTMLButtonElement[] = [
        make('button', { onclick: () => this.lay() }, TEXTS.layers.lay),
        make('button', { onclick: () => void this.session.overlay({ kind: 'layer', page: null, joints: [] }) }, TEXTS.layers.off),
        make('button', { title: TEXTS.layers.aimHint, onclick: () => this.aim() }, TEXTS.layers.aim),
        make('button', { title: TEXTS.layers.swingHint, onclick: () => this.swing() }, TEXTS.layers.swing),
        make(
            'button',
            {
                title: TEXTS.layers.freeHint,
                onclick: () => void this.session.overlay({ kind: 'free', joints: this.chosen.map(({ servo }) => servo) }),
            },
            TEXTS.layers.free,
        ),
    ];
    private shown: readonly Uint8Array[] | null = null;
    private joint: Joint | null = null;

    connectedCallback(): void {
        const [lay, off, aim, swing, free] = this.actions;
        const [to, by, time] = [
            make('label', {}, TEXTS.layers.to, ' ', this.position),
            make('label', {}, '± ', this.amplitude),
            make('label', {}, TEXTS.layers.in, ' ', this.seconds, ' s'),
        ];
        this.byCode.replaceChildren(this.jointName, to, aim ?? '', make('span', { class: 'break' }), by, time, swing ?? '', free ?? '');
        this.replaceChildren(
            make('p', { class: 'hint' }, TEXTS.layers.purpose),
            make('div', { class: 'row' }, this.page, this.joints, lay ?? '', off ?? ''),
            this.byCode,
            make('div', { class: 'row' }, this.startPlay, this.status),
        );
        this.watch(() => this.render(), this.session.editor.state, this.session.state);
    }

    private get chosen(): Joint[] {
        const { joints } = this.session.editor.state.get();
        return this.session.body.joints.filter(({ servo }) => joints.has(servo));
    }

    private render(): void {
        const state = this.session.state.get();
        const { version, tab, source } = state;
        if (tab !== 'remote') return;
        const { document, gesture } = this.session.editor.state.get();
        if (this.shown !== document.pages && !gesture) this.list(document.pages); // not during a drag
        const isPlay = version?.image === 'play';
        for (const button of this.actions) setDisabled(button, !isPlay);
        this.startPlay.hidden = isPlay || version === null || source === 'yours';
        this.showJoint();
        const text =
            isPlay || version === null
                ? layersText(state)
                : source !== 'yours'
                  ? TEXTS.layers.needsPlay
                  : TEXTS.layers.needsPlayYours(version.board);
        setText(this.status, text);
    }

    private list(pages: readonly Uint8Array[]): void {
        this.shown = pages;
        const { editor } = this.session;
        const kept = this.page.value;
        this.page.replaceChildren(
            ...pages.flatMap((_, page) =>
                page > 0 && editor.format.isPlayable(pageOf(editor.state.get().document, page))
                    ? [make('option', { value: page }, `${page} ${editor.page(page).name}`)]
                    : [],
            ),
        );
        if ([...this.page.options].some(({ value }) => value === kept)) this.page.value = kept;
    }

    /** Shows the first of the chosen joints; the field starts at its zero position. */
    private showJoint(): void {
        const [joint = null] = this.chosen;
        this.byCode.classList.toggle('none', joint === null);
        if (joint === this.joint && this.jointName.textContent !== '') return;
        this.joint = joint;
        this.jointName.textContent = joint ? TEXTS.curves.line(joint.servo, jointTitle(joint)) : TEXTS.layers.chooseJoint;
        if (joint) this.position.value = String(Math.round(joint.zero));
    }

    private lay(): void {
        const isOnChosen = this.joints.value === 'chosen';
        const joints = isOnChosen ? this.chosen.map(({ servo }) => servo) : [];
        // Without joints the robot would take those of the motion.
        if (isOnChosen && joints.length === 0) return this.session.say({ text: TEXTS.layers.chooseJoint, tone: 'bad' });
        if (this.page.value !== '') void this.session.overlay({ kind: 'layer', page: Number(this.page.value), joints });
    }

    private aim(): void {
        const { joint } = this;
        if (joint)
            void this.session.overlay({ kind: 'aim', joint: joint.servo, position: this.within(joint), degreesPerSecond: AIM_DEGREES_S });
    }

    private swing(): void {
        const { joint } = this;
        if (!joint) return;
        const [amplitude, periodMs] = [Math.round(numberIn(this.amplitude)), Math.round(numberIn(this.seconds) * 1000)];
        void this.session.overlay({ kind: 'swing', joint: joint.servo, centre: this.within(joint), amplitude, periodMs });
    }

    /** The position in the field, limited to the joint's range. */
    private within(joint: Joint): number {
        const wanted = Number.isFinite(this.position.valueAsNumber) ? this.position.valueAsNumber : joint.zero;
        const position = nearestPosition(joint, jointAngle(joint, wanted));
        this.position.value = String(position);
        return position;
    }
}

/** An empty field gets its first number back. */
function numberIn(field: HTMLInputElement): number {
    if (!Number.isFinite(field.valueAsNumber)) field.value = field.defaultValue;
    return field.valueAsNumber;
}

define('layer-bar', LayerBar);
