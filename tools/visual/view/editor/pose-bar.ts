// SPDX-License-Identifier: MIT
// Controls over the picture while a step is edited: what a drag does, positions of the chosen joints, view options, balance and collisions.

import { jointAngle, nearestPosition } from '../../model/body.ts';
import type { Joint } from '../../model/body.ts';
import type { Touch } from '../../model/trial.ts';
import type { RobotState } from '../../robot/robot-state.ts';
import { closesByItself, define, make, setText } from '../element.ts';
import type { Store } from '../store.ts';
import { isEditing, robotPositions } from './editing.ts';
import type { Editing, PictureMode } from './editing.ts';
import { changeStep } from './joint-edits.ts';
import { ShownFor } from './shown-for.ts';
import { jointTitle } from '../texts/robot.ts';
import { TEXTS } from '../texts/texts.ts';
import { touchesText } from '../texts/trials.ts';
import { SessionElement } from '../session-element.ts';
import { watchRobot } from '../watch-robot.ts';
import './pose-bar.css';

const OPTIONS = ['soleFlat', 'onionSkin', 'balance'] as const;
const KEEPS = ['lower', 'right', 'left'] as const;

export class PoseBar extends SessionElement {
    editing!: Store<Editing>; // set before it is connected
    /** Distance of the centre of mass inside the support polygon (metres); null: not computed. */
    margin: () => number | null = () => null;
    touches: () => readonly Touch[] = () => [];
    private readonly modes = new Map<PictureMode, HTMLButtonElement>();
    private readonly joints = make('div', { class: 'joints', role: 'group', 'aria-label': TEXTS.picture.chosenJoints });
    /** shown: position last written to the input. */
    private readonly fields = new Map<number, { readonly input: HTMLInputElement; readonly degrees: HTMLElement; shown: number }>();
    private readonly shownFor = new ShownFor();
    private readonly balance = make('p', { class: 'balance', role: 'status', 'aria-label': TEXTS.picture.balance });
    private readonly touch = make('p', { class: 'touch', role: 'status', 'aria-label': TEXTS.picture.limbsMeet });
    private readonly hint = make('p', { class: 'hint' });
    private robot: RobotState | null = null;

    connectedCallback(): void {
        const group = make('div', { class: 'modes', role: 'group', 'aria-label': TEXTS.picture.dragDoes });
        const { pose, poseHint, hand, handHint } = TEXTS.picture;
        const modes: readonly (readonly [PictureMode, string, string])[] = [
            ['pose', pose, poseHint],
            ['hand', hand, handHint],
        ];
        for (const [mode, title, hint] of modes) {
            const button = make('button', { title: hint, onclick: () => this.editing.set({ mode }) }, title);
            this.modes.set(mode, button);
            group.append(button);
        }
        this.replaceChildren(make('div', { class: 'row' }, group, this.options()), this.hint, this.joints, this.balance, this.touch);
        this.watch(() => this.render(), this.editing, this.session.state, this.session.editor.state);
        this.disposals.push(
            watchRobot(this.session, robot => {
                this.robot = robot;
                this.showBalance();
                this.showTouches();
            }),
        );
    }

    private options(): HTMLElement {
        const keep = make(
            'select',
            { 'aria-label': TEXTS.picture.whichStays, onchange: () => this.editing.set({ keep: keep.value as Editing['keep'] }) },
            ...KEEPS.map(value => make('option', { value }, TEXTS.picture[value])),
        );
        const boxes = OPTIONS.map(name => {
            const box = make('input', {
                type: 'checkbox',
                checked: this.editing.get()[name],
                onchange: () => this.editing.set({ [name]: box.checked }),
            });
            return make('label', {}, box, TEXTS.picture[name]);
        });
        const menu = make(
            'details',
            { class: 'options' },
            make('summary', {}, TEXTS.picture.view),
            make('div', { class: 'menu' }, ...boxes, make('label', {}, TEXTS.picture.stays, ' ', keep)),
        );
        this.disposals.push(closesByItself(menu));
        return menu;
    }

    private render(): void {
        const { mode } = this.editing.get();
        this.hidden = !isEditing(this.session.state.get().tab);
        if (this.hidden) return;
        for (const [name, button] of this.modes) button.setAttribute('aria-pressed', String(name === mode));
        const { joints } = this.session.editor.state.get();
        this.hint.textContent = mode === 'hand' ? TEXTS.picture.handHint : joints.size === 0 ? TEXTS.picture.poseHint : '';
        this.joints.hidden = mode === 'hand' || joints.size === 0;
        if (!this.joints.hidden) this.showJoints(joints);
    }

    private showJoints(chosen: ReadonlySet<number>): void {
        const joints = this.session.body.joints.filter(joint => chosen.has(joint.servo));
        if (joints.map(joint => joint.servo).join() !== [...this.fields.keys()].join()) {
            this.fields.clear();
            this.joints.replaceChildren(...joints.map(joint => this.field(joint)));
        }
        const { editor } = this.session;
        const { page, step } = editor.state.get();
        const isOther = this.shownFor.isOtherStep(editor.state.get());
        const isEmpty = editor.page(page).steps.length === 0;
        const pose = isEmpty && this.robot ? robotPositions(this.robot) : editor.poseAfter(page, step); // an edit starts from it
        for (const joint of joints) {
            const field = this.fields.get(joint.servo);
            const position = pose[joint.servo] ?? joint.zero;
            if (!field) continue;
            if (isOther || field.shown !== position) field.input.value = String(position); // else it would overwrite what is being typed
            field.shown = position;
            field.degrees.textContent = `${Math.round((jointAngle(joint, position) * 180) / Math.PI)}°`;
        }
    }

    private field(joint: Joint): HTMLElement {
        const [low, high] = [nearestPosition(joint, joint.low), nearestPosition(joint, joint.high)].sort((a, b) => a - b);
        const input = make('input', { type: 'number', min: low ?? 0, max: high ?? 0, step: 1, onchange: () => this.set(joint, input) });
        const degrees = make('output');
        this.fields.set(joint.servo, { input, degrees, shown: NaN });
        return make('label', {}, make('span', {}, TEXTS.curves.line(joint.servo, jointTitle(joint))), input, degrees);
    }

    private set(joint: Joint, input: HTMLInputElement): void {
        const field = this.fields.get(joint.servo);
        if (field) field.shown = NaN; // makes showJoints() rewrite the input
        if (!Number.isFinite(input.valueAsNumber)) return this.render();
        const { editor } = this.session;
        const position = nearestPosition(joint, jointAngle(joint, input.valueAsNumber));
        editor.dispatch(changeStep(editor, editor.state.get().document, new Map([[joint.servo, position]]), this.robot));
        this.render(); // an unchanged position does not change the document, so no event follows
    }

    private showBalance(): void {
        const margin = this.margin();
        const isInHand = this.editing.get().mode === 'hand' && this.robot?.isHeld === true;
        const text =
            margin === null
                ? ''
                : isInHand
                  ? TEXTS.picture.held
                  : margin < 0
                    ? TEXTS.picture.tips
                    : TEXTS.picture.margin(Math.round(margin * 1000));
        setText(this.balance, text);
        this.balance.dataset.tone = margin !== null && margin < 0 && !isInHand ? 'bad' : 'calm';
    }

    private showTouches(): void {
        setText(this.touch, this.hidden ? '' : touchesText(this.touches()));
    }
}

define('pose-bar', PoseBar);
