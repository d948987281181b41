// SPDX-License-Identifier: MIT
// Curves: what the firmware's player makes of the page, under either law, and as it is shaped.

import { degreesOf, jointTitle } from '../../model/body.ts';
import type { TickSpan } from '../../model/curve-speed.ts';
import type { Law } from '../../model/motion.ts';
import type { Desk } from '../desk.ts';
import { define, make } from '../element.ts';
import { CurveCanvas } from './curve-canvas.ts';
import type { Drawn } from './curve-canvas.ts';
import { LayerBar } from './layer-bar.ts';
import { PageHead } from './page-head.ts';
import { PlayBar } from './play-bar.ts';
import { ShapeBar } from './shape-bar.ts';
import { CURVE_TEXTS } from './step-texts.ts';
import { limbGroups } from './teach-bar.ts';
import './curves-pane.css';

const LAWS: readonly (readonly [Law, string, string])[] = [
    ['exact', 'Exact', 'Every way-point is met, in time'],
    ['classic', 'Classic', 'As the firmware of 2005 moved'],
];

export class CurvesPane extends HTMLElement {
    desk!: Desk; // set before it is connected
    private readonly laws = new Map<Law, HTMLButtonElement>();
    private readonly chips = new Map<number, HTMLButtonElement>();
    private readonly fast = make('p', { class: 'fast', role: 'status', 'aria-label': 'Too fast' });
    private readonly follow = make('input', { type: 'checkbox' });
    private readonly lines = make('p', { class: 'lines', role: 'status', 'aria-label': 'Other lines' });
    private readonly disposals: (() => void)[] = [];

    connectedCallback(): void {
        const give = <T extends HTMLElement & { desk: Desk }>(element: T): T => Object.assign(element, { desk: this.desk });
        const canvas = give(new CurveCanvas());
        canvas.onDrawn = drawn => {
            this.sayFast(drawn.fast);
            this.sayLines(drawn);
        };
        this.follow.addEventListener('change', () => canvas.setFollow(this.follow.checked));
        const shape = Object.assign(give(new ShapeBar()), { onShape: canvas.setShape.bind(canvas) });
        this.replaceChildren(
            make('p', { class: 'purpose' }, CURVE_TEXTS.purpose),
            give(new PageHead()),
            this.lawRow(),
            canvas,
            give(new PlayBar()),
            this.fast,
            this.lines,
            this.jointRow(),
            shape,
            give(new LayerBar()),
        );
        this.disposals.push(
            this.desk.editor.state.watch(({ joints, law }) => {
                for (const [servo, chip] of this.chips) chip.setAttribute('aria-pressed', String(joints.has(servo)));
                for (const [name, button] of this.laws) button.setAttribute('aria-pressed', String(name === law));
            }),
        );
    }

    disconnectedCallback(): void {
        for (const dispose of this.disposals.splice(0)) dispose();
    }

    private lawRow(): HTMLElement {
        const row = make('div', { class: 'row', role: 'group', 'aria-label': 'Law of motion' }, make('span', {}, 'Law:'));
        for (const [law, title, hint] of LAWS) {
            const button = make('button', { title: hint, onclick: () => this.desk.editor.select({ law }) }, title);
            this.laws.set(law, button);
            row.append(button);
        }
        row.append(make('label', { class: 'follow', title: CURVE_TEXTS.followHint }, this.follow, CURVE_TEXTS.follow));
        return row;
    }

    /** What the other lines are. */
    private sayLines(drawn: Drawn): void {
        const { joints } = this.desk.editor.state.get();
        const text = [
            drawn.isShaped && joints.size > 0 ? CURVE_TEXTS.stored : '',
            this.follow.checked ? this.lagText(drawn, joints.size > 0) : '',
        ]
            .filter(Boolean)
            .join(' ');
        if (this.lines.textContent !== text) this.lines.textContent = text;
    }

    private lagText({ lags, isUnknown }: Drawn, hasJoint: boolean): string {
        if (isUnknown) return CURVE_TEXTS.noLags;
        if (!hasJoint) return CURVE_TEXTS.lagsNeedJoint;
        return lags.size === 0
            ? CURVE_TEXTS.lagsComing
            : CURVE_TEXTS.lags(
                  this.desk.body.joints.flatMap(joint => {
                      const units = lags.get(joint.servo);
                      return units === undefined ? [] : [[joint.servo, degreesOf(joint, units)] as const];
                  }),
              );
    }

    private jointRow(): HTMLElement {
        const row = make('div', { class: 'joint-chips', role: 'group', 'aria-label': 'Joints to edit' });
        for (const { title, servos } of limbGroups(this.desk.body)) {
            row.append(make('button', { class: 'limb', onclick: () => this.desk.editor.select({ joints: new Set(servos) }) }, title));
        }
        for (const joint of [...this.desk.body.joints].sort((a, b) => a.servo - b.servo)) {
            const chip = make(
                'button',
                { title: jointTitle(joint), 'aria-label': `${joint.servo} ${jointTitle(joint)}`, onclick: () => this.toggle(joint.servo) },
                String(joint.servo),
            );
            this.chips.set(joint.servo, chip);
            row.append(chip);
        }
        return row;
    }

    private toggle(servo: number): void {
        const joints = new Set(this.desk.editor.state.get().joints);
        if (!joints.delete(servo)) joints.add(servo);
        this.desk.editor.select({ joints });
    }

    private sayFast(fast: ReadonlyMap<number, readonly TickSpan[]>): void {
        const text = fast.size === 0 ? CURVE_TEXTS.notFast : CURVE_TEXTS.fast([...fast.keys()]);
        if (this.fast.textContent !== text) this.fast.textContent = text;
        this.fast.dataset['tone'] = fast.size === 0 ? 'calm' : 'bad';
    }
}

define('curves-pane', CurvesPane);
