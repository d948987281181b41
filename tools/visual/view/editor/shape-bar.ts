// SPDX-License-Identifier: MIT
// Speed, size and direction of what plays: drawn in the curves at once, and told to the robot while Play runs.

import { AS_STORED, SHAPE_RANGES } from '../../model/motion.ts';
import type { Shape } from '../../model/motion.ts';
import type { Desk } from '../desk.ts';
import { define, make } from '../element.ts';
import { CURVE_TEXTS } from './step-texts.ts';

const SLIDERS: readonly (readonly [keyof Shape, string])[] = [
    ['rate', 'Speed'],
    ['amplitude', 'Size'],
    ['blend', 'Left – right'],
];
const PERCENT_STEP = 5;

export class ShapeBar extends HTMLElement {
    desk!: Desk; // set before it is connected
    onShape: (shape: Shape) => void = () => undefined;
    private shape: Shape = AS_STORED;
    private readonly inputs = new Map<keyof Shape, { input: HTMLInputElement; output: HTMLOutputElement }>();
    private readonly hint = make('p', { class: 'hint' });
    private unwatch: () => void = () => undefined;

    connectedCallback(): void {
        const sliders = SLIDERS.map(([name, title]) => {
            const [min, max] = SHAPE_RANGES[name];
            const output = make('output', {}, `${this.shape[name]} %`);
            const input = make('input', { type: 'range', min, max, step: PERCENT_STEP, value: this.shape[name] });
            input.addEventListener('input', () => this.set({ ...this.shape, [name]: input.valueAsNumber }, false));
            input.addEventListener('change', () => this.set({ ...this.shape, [name]: input.valueAsNumber }, true));
            this.inputs.set(name, { input, output });
            return make('label', { class: 'slider' }, make('span', {}, title), input, output);
        });
        this.replaceChildren(
            make('h2', {}, 'Shape what plays'),
            ...sliders,
            make('div', { class: 'row' }, make('button', { onclick: () => this.set(AS_STORED, true) }, 'As stored'), this.hint),
        );
        this.unwatch = this.desk.state.watch(
            ({ version }) => (this.hint.textContent = version?.image === 'play' ? CURVE_TEXTS.shapes : CURVE_TEXTS.shapeNeedsPlay),
        );
    }

    disconnectedCallback(): void {
        this.unwatch();
    }

    /** tell: also to the robot, if Play runs there. */
    private set(shape: Shape, tell: boolean): void {
        this.shape = shape;
        for (const [name, { input, output }] of this.inputs) {
            input.value = String(shape[name]);
            output.value = `${shape[name]} %`;
        }
        this.onShape(shape);
        if (tell && this.desk.state.get().version?.image === 'play') void this.desk.shape(shape);
    }
}

define('shape-bar', ShapeBar);
