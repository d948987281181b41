// SPDX-License-Identifier: MIT
// The area Curves: the firmware player's output for the page, under the selected law and with the shape applied.

import type { TickSpan } from '../../model/curve-speed.ts';
import type { Shape } from '../../model/motion.ts';
import type { Tab } from '../session/session.ts';
import { define, make, setText } from '../element.ts';
import type { Store } from '../store.ts';
import { lagText } from '../texts/editor.ts';
import { jointTitle } from '../texts/robot.ts';
import { TEXTS } from '../texts/texts.ts';
import { busiestLimb } from '../../model/busiest-limb.ts';
import { CHOSEN_COLOURS, CurveCanvas } from './curve-canvas.ts';
import type { Drawn } from './curve-canvas.ts';
import { PageHead } from './page-head.ts';
import { PlayBar } from './play-bar.ts';
import { limbGroups } from './teach-bar.ts';
import { SessionElement } from '../session-element.ts';
import './curves-pane.css';

export class CurvesPane extends SessionElement {
    shape!: Store<Shape>; // set before it is connected
    private readonly chips = new Map<number, HTMLButtonElement>();
    private readonly legend = make('ul', { class: 'legend', 'aria-label': TEXTS.curves.lines });
    private readonly fast = make('p', { class: 'fast', role: 'status', 'aria-label': TEXTS.curves.tooFast });
    private readonly follow = make('input', { type: 'checkbox' });
    private readonly lines = make('p', { class: 'lines', role: 'status', 'aria-label': TEXTS.curves.otherLines });
    private shownTab: Tab | null = null;

    connectedCallback(): void {
        const canvas = this.give(new CurveCanvas());
        canvas.onDrawn = drawn => {
            this.sayFast(drawn.fast);
            this.sayLines(drawn);
            this.sayLegend(drawn);
        };
        this.follow.addEventListener('change', () => canvas.setFollow(this.follow.checked));
        this.replaceChildren(
            make('p', { class: 'purpose' }, TEXTS.curves.purpose),
            this.give(new PageHead()),
            canvas,
            this.legend,
            this.give(new PlayBar()),
            this.fast,
            this.lines,
            make('label', { class: 'follow', title: TEXTS.curves.followHint }, this.follow, TEXTS.curves.follow),
            this.jointRow(),
        );
        this.disposals.push(
            this.session.editor.state.watch(({ joints }) => {
                for (const [servo, chip] of this.chips) chip.setAttribute('aria-pressed', String(joints.has(servo)));
            }),
            this.session.state.watch(({ tab }) => {
                if (tab === 'curves' && this.shownTab !== tab) this.beginWithLimb();
                this.shownTab = tab;
            }),
            this.shape.watch(shape => canvas.setShape(shape)),
        );
    }

    /** Eighteen lines at once are unreadable, so at first the limb that moves most is chosen. */
    private beginWithLimb(): void {
        const { editor, body } = this.session;
        const { page, joints } = editor.state.get();
        if (joints.size > 0) return;
        const servos = busiestLimb(limbGroups(body), editor.page(page).steps);
        if (servos.length > 0) editor.select({ joints: new Set(servos) });
    }

    private sayLegend({ chosen }: Drawn): void {
        const key = chosen.join();
        if (key === this.legend.dataset.joints) return;
        this.legend.dataset.joints = key;
        const { joints } = this.session.body;
        const items = chosen.map((servo, i) => {
            const joint = joints.find(one => one.servo === servo);
            const item = make('li', {}, TEXTS.curves.line(servo, joint ? jointTitle(joint) : ''));
            item.style.setProperty('--line-colour', `var(${CHOSEN_COLOURS[i % CHOSEN_COLOURS.length]})`);
            return item;
        });
        this.legend.replaceChildren(...(items.length > 0 ? items : [make('li', { class: 'none' }, TEXTS.curves.noLine)]));
    }

    /** Explains the dotted and thin lines. */
    private sayLines(drawn: Drawn): void {
        const text = [
            drawn.isShaped && drawn.chosen.length > 0 ? TEXTS.curves.stored : '',
            this.follow.checked ? lagText(drawn, this.session.body) : '',
        ]
            .filter(Boolean)
            .join(' ');
        setText(this.lines, text);
    }

    private jointRow(): HTMLElement {
        const row = make('div', { class: 'joint-chips', role: 'group', 'aria-label': TEXTS.curves.joints });
        for (const { title, servos } of limbGroups(this.session.body)) {
            row.append(make('button', { class: 'limb', onclick: () => this.session.editor.select({ joints: new Set(servos) }) }, title));
        }
        for (const joint of [...this.session.body.joints].sort((a, b) => a.servo - b.servo)) {
            const chip = make(
                'button',
                {
                    title: jointTitle(joint),
                    'aria-label': TEXTS.curves.line(joint.servo, jointTitle(joint)),
                    onclick: () => this.toggle(joint.servo),
                },
                String(joint.servo),
            );
            this.chips.set(joint.servo, chip);
            row.append(chip);
        }
        return row;
    }

    private toggle(servo: number): void {
        const joints = new Set(this.session.editor.state.get().joints);
        if (!joints.delete(servo)) joints.add(servo);
        this.session.editor.select({ joints });
    }

    private sayFast(fast: ReadonlyMap<number, readonly TickSpan[]>): void {
        const text = fast.size === 0 ? TEXTS.curves.notFast : TEXTS.curves.fast([...fast.keys()]);
        setText(this.fast, text);
        this.fast.dataset.tone = fast.size === 0 ? 'calm' : 'bad';
    }
}

define('curves-pane', CurvesPane);
