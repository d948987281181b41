// SPDX-License-Identifier: MIT
// Speed, amplitude and turn of the current play. They are sent to the robot while Play runs, and drawn in the curves. A robot that starts or is
// connected has values of its own, which are shown then.

import { AS_STORED, SHAPE_RANGES } from '../../model/motion.ts';
import type { Shape } from '../../model/motion.ts';
import type { Session, SessionState } from '../session/session.ts';
import { define, make, setText } from '../element.ts';
import type { Store } from '../store.ts';
import { shapeText } from '../texts/robot.ts';
import { TEXTS } from '../texts/texts.ts';
import './shape-bar.css';

const SLIDERS: readonly (keyof Shape)[] = ['rate', 'amplitude', 'blend'];
const PERCENT_STEP = 5;

export class ShapeBar extends HTMLElement {
    session!: Session; // these are set before it is connected
    shape!: Store<Shape>;
    private readonly hint = make('p', { class: 'hint' });
    /** The start or connection whose values were taken. */
    private taken: SessionState['version'] = null;
    private readonly disposals: (() => void)[] = [];

    connectedCallback(): void {
        this.replaceChildren(
            make('h2', {}, TEXTS.remote.shape),
            ...SLIDERS.map(name => this.slider(name)),
            make('div', { class: 'row' }, make('button', { onclick: () => this.set(AS_STORED, true) }, TEXTS.remote.asStored), this.hint),
        );
        this.disposals.push(this.session.state.watch(state => this.take(state)));
    }

    private take(state: SessionState): void {
        const { version, where } = state;
        setText(this.hint, shapeText(state));
        if (!where?.shape || version === this.taken) return;
        this.taken = version;
        this.shape.set(where.shape);
    }

    disconnectedCallback(): void {
        for (const dispose of this.disposals.splice(0)) dispose();
    }

    private slider(name: keyof Shape): HTMLElement {
        const [min, max] = SHAPE_RANGES[name];
        const output = make('output');
        const input = make('input', { type: 'range', min, max, step: PERCENT_STEP });
        input.addEventListener('input', () => this.set({ [name]: input.valueAsNumber }, false));
        input.addEventListener('change', () => this.set({ [name]: input.valueAsNumber }, true));
        this.disposals.push(
            this.shape.watch(shape => {
                input.value = String(shape[name]);
                output.value = `${shape[name]} %`;
            }),
        );
        return make('label', { class: 'slider' }, make('span', {}, TEXTS.remote.shapes[name]), input, output);
    }

    /** tell: also sends the shape to the robot if Play runs there. */
    private set(change: Partial<Shape>, tell: boolean): void {
        this.shape.set(change);
        if (tell && this.session.state.get().version?.image === 'play') void this.session.shape(this.shape.get());
    }
}

define('shape-bar', ShapeBar);
