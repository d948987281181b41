// SPDX-License-Identifier: MIT
// Speed, amplitude and turn of the current play. They are sent to the robot while Play runs, and drawn in the curves. What the robot reports
// is shown: its values when it starts, and what somebody has typed.

import { AS_STORED, SHAPE_RANGES } from '../../model/motion.ts';
import type { Shape } from '../../model/motion.ts';
import type { SessionState } from '../session/session.ts';
import { define, make, setText } from '../element.ts';
import type { Store } from '../store.ts';
import { shapeText } from '../texts/robot.ts';
import { TEXTS } from '../texts/texts.ts';
import { SessionElement } from '../session-element.ts';
import './shape-bar.css';

const SLIDERS: readonly (keyof Shape)[] = ['rate', 'amplitude', 'blend'];
const PERCENT_STEP = 5;

export class ShapeBar extends SessionElement {
    shape!: Store<Shape>; // set before it is connected
    private readonly hint = make('p', { class: 'hint' });
    /** Changes that the robot has not answered yet. */
    private sending = 0;
    /** The robot's report when they were answered: older than they are. */
    private stale: SessionState['where'] = null;

    connectedCallback(): void {
        this.replaceChildren(
            make('h2', {}, TEXTS.remote.shape),
            ...SLIDERS.map(name => this.slider(name)),
            make(
                'div',
                { class: 'row' },
                make('button', { onclick: () => void this.set(AS_STORED, true) }, TEXTS.remote.asStored),
                this.hint,
            ),
        );
        this.disposals.push(this.session.state.watch(state => this.take(state)));
    }

    private take(state: SessionState): void {
        const { version, where } = state;
        setText(this.hint, shapeText(state));
        const isHeld = this.querySelector('input:active') !== null;
        if (version?.image !== 'play' || !where?.shape || where === this.stale || this.sending > 0 || isHeld) return;
        const [shown, reported] = [this.shape.get(), where.shape];
        // What is set is drawn, and physics begins anew: not at every answer of the robot.
        if (SLIDERS.some(name => shown[name] !== reported[name])) this.shape.set(reported);
    }

    private slider(name: keyof Shape): HTMLElement {
        const [min, max] = SHAPE_RANGES[name];
        const output = make('output');
        const input = make('input', { type: 'range', min, max, step: PERCENT_STEP });
        input.addEventListener('input', () => void this.set({ [name]: input.valueAsNumber }, false));
        input.addEventListener('change', () => void this.set({ [name]: input.valueAsNumber }, true));
        this.disposals.push(
            this.shape.watch(shape => {
                input.value = String(shape[name]);
                output.value = `${shape[name]} %`;
            }),
        );
        return make('label', { class: 'slider' }, make('span', {}, TEXTS.remote.shapes[name]), input, output);
    }

    /** tell: also sends the change to the robot if Play runs there. */
    private async set(change: Partial<Shape>, tell: boolean): Promise<void> {
        this.shape.set(change);
        const { state } = this.session;
        if (!tell || state.get().version?.image !== 'play') return;
        this.sending++;
        await this.session.shape(change);
        this.sending--;
        this.stale = state.get().where;
    }
}

define('shape-bar', ShapeBar);
