// SPDX-License-Identifier: MIT
// What goes on beside a play: a page laid over it, joints that code moves. The robot does all of it; here it is only told to.

import { jointAngle, jointTitle, nearestPosition } from '../../model/body.ts';
import type { Joint } from '../../model/body.ts';
import { pageOf } from '../../model/document.ts';
import { POSITION_MAX, POSITION_MIDDLE } from '../../model/motion.ts';
import type { Session } from '../session/session.ts';
import { define, make } from '../element.ts';
import { LAYER_TEXTS } from '../texts/steps.ts';
import { pageText } from '../texts/editor.ts';
import './layer-bar.css';

const AIM_DEGREES_S = 90;

export class LayerBar extends HTMLElement {
    session!: Session; // set before it is connected
    private readonly page = make('select', { 'aria-label': 'Page to lay over the play' });
    private readonly joints = make(
        'select',
        { 'aria-label': 'Joints of the layer' },
        make('option', { value: 'own' }, 'on its own joints'),
        make('option', { value: 'chosen' }, 'on the chosen joints'),
    );
    private readonly position = make('input', {
        type: 'number',
        min: 0,
        max: POSITION_MAX,
        value: POSITION_MIDDLE,
        'aria-label': 'Position',
    });
    private readonly amplitude = make('input', { type: 'number', min: 1, max: POSITION_MIDDLE, value: 60, 'aria-label': 'To and fro by' });
    private readonly seconds = make('input', {
        type: 'number',
        min: 0.125,
        max: 30,
        step: 0.125,
        value: 2,
        'aria-label': 'Seconds to and fro',
    });
    private readonly byCode = make('div', { class: 'by-code' });
    private readonly jointName = make('span', { class: 'joint' });
    private readonly status = make('p', { class: 'hint', role: 'status', 'aria-label': 'Beside the play' });
    private readonly startPlay = make('button', { onclick: () => this.session.runImage('play') }, 'Start Play');
    private readonly deeds: readonly HTMLButtonElement[] = [
        make('button', { onclick: () => this.lay() }, 'Lay over'),
        make('button', { onclick: () => void this.session.overlay({ kind: 'layer', page: null, joints: [] }) }, 'Layer off'),
        make('button', { title: 'Goes there and holds it there', onclick: () => this.aim() }, 'Aim'),
        make('button', { title: 'To and fro about the position', onclick: () => this.swing() }, 'Swing'),
        make(
            'button',
            {
                title: 'Back to the play',
                onclick: () => void this.session.overlay({ kind: 'free', joints: this.chosen.map(({ servo }) => servo) }),
            },
            'Free',
        ),
    ];
    private shown: readonly Uint8Array[] | null = null;
    private joint: Joint | null = null;
    private readonly disposals: (() => void)[] = [];

    connectedCallback(): void {
        const [lay, off, aim, swing, free] = this.deeds;
        const [to, by, time] = [
            make('label', {}, 'to ', this.position),
            make('label', {}, '± ', this.amplitude),
            make('label', {}, 'in ', this.seconds, ' s'),
        ];
        this.byCode.replaceChildren(this.jointName, to, aim ?? '', make('span', { class: 'break' }), by, time, swing ?? '', free ?? '');
        this.replaceChildren(
            make('p', { class: 'hint' }, LAYER_TEXTS.purpose),
            make('div', { class: 'row' }, this.page, this.joints, lay ?? '', off ?? ''),
            this.byCode,
            make('div', { class: 'row' }, this.startPlay, this.status),
        );
        this.disposals.push(
            this.session.editor.state.watch(() => this.render()),
            this.session.state.watch(() => this.render()),
        );
    }

    disconnectedCallback(): void {
        for (const dispose of this.disposals.splice(0)) dispose();
    }

    private get chosen(): Joint[] {
        const { joints } = this.session.editor.state.get();
        return this.session.body.joints.filter(({ servo }) => joints.has(servo));
    }

    private render(): void {
        const { version, tab, source } = this.session.state.get();
        if (tab !== 'remote') return;
        const { document, gesture } = this.session.editor.state.get();
        if (this.shown !== document.pages && !gesture) this.list(document.pages); // not at every frame of a drag
        const isPlay = version?.image === 'play';
        for (const button of this.deeds) button.disabled = !isPlay;
        this.startPlay.hidden = isPlay || version === null || source === 'yours';
        this.showJoint();
        const text = isPlay || version === null ? this.inForce() : source !== 'yours' ? LAYER_TEXTS.needsPlay : LAYER_TEXTS.needsPlayYours;
        if (this.status.textContent !== text) this.status.textContent = text;
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
        if (kept) this.page.value = kept;
    }

    /** The first of the chosen joints, from its middle on. */
    private showJoint(): void {
        const [joint = null] = this.chosen;
        this.byCode.classList.toggle('none', joint === null);
        if (joint === this.joint && this.jointName.textContent !== '') return;
        this.joint = joint;
        this.jointName.textContent = joint ? `${joint.servo} ${jointTitle(joint)}` : LAYER_TEXTS.chooseJoint;
        if (joint) this.position.value = String(Math.round(joint.zero));
    }

    /** What the robot says is in force. */
    private inForce(): string {
        const fields = this.session.state.get().where?.fields;
        const page = Number(fields?.get('layer') ?? 0);
        const aimed = Number.parseInt(fields?.get('aim') ?? '0', 16);
        const ids = this.session.body.joints
            .map(({ servo }) => servo)
            .filter(servo => (aimed >>> servo) & 1)
            .sort((a, b) => a - b);
        const parts = [
            page > 0 ? LAYER_TEXTS.page(pageText(page, this.session.editor.page(page).name)) : '',
            ids.length > 0 ? LAYER_TEXTS.joints(ids) : '',
        ];
        return parts.filter(Boolean).join(' ') || LAYER_TEXTS.none;
    }

    private lay(): void {
        const joints = this.joints.value === 'chosen' ? this.chosen.map(({ servo }) => servo) : [];
        void this.session.overlay({ kind: 'layer', page: Number(this.page.value), joints });
    }

    private aim(): void {
        const { joint } = this;
        if (joint)
            void this.session.overlay({ kind: 'aim', joint: joint.servo, position: this.within(joint), degreesPerSecond: AIM_DEGREES_S });
    }

    private swing(): void {
        const { joint } = this;
        const [amplitude, periodMs] = [Math.round(this.amplitude.valueAsNumber), Math.round(this.seconds.valueAsNumber * 1000)];
        if (!joint || !Number.isFinite(amplitude + periodMs)) return;
        void this.session.overlay({ kind: 'swing', joint: joint.servo, centre: this.within(joint), amplitude, periodMs });
    }

    /** The position in the field, as far as the body lets the joint. */
    private within(joint: Joint): number {
        const wanted = Number.isFinite(this.position.valueAsNumber) ? this.position.valueAsNumber : joint.zero;
        const position = nearestPosition(joint, jointAngle(joint, wanted));
        this.position.value = String(position);
        return position;
    }
}

define('layer-bar', LayerBar);
