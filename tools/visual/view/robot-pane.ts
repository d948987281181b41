// SPDX-License-Identifier: MIT
// The laboratory of the simulated robot: time, power, floor, battery, servos and their faults.

import { NOMINAL_VOLTS, TICKS_PER_SECOND } from '../model/motion.ts';
import type { Session, SessionState, ImageName, PanelButton } from './session/session.ts';
import { ask } from './editor/ask-dialog.ts';
import { define, make, setText } from './element.ts';
import { pushRobot } from './push.ts';
import { ServoTable } from './servo-table.ts';
import { LAW_TEXTS, TEXTS } from './texts/robot.ts';
import './robot-pane.css';

const SPEEDS: readonly (readonly [number, string])[] = [
    [0.1, '0.1×'],
    [0.25, '¼×'],
    [0.5, '½×'],
    [1, 'real time'],
    [2, '2×'],
    [4, '4×'],
];
const PANEL: readonly (readonly [PanelButton, string])[] = [
    ['up', '▲'],
    ['down', '▼'],
    ['left', '◀'],
    ['right', '▶'],
    ['start', 'START'],
    ['mode', 'MODE'],
];
const LEDS = ['Power', 'TxD', 'RxD', 'Aux', 'Manage', 'Program', 'Play'];
const RADIANS = Math.PI / 180;

export class RobotPane extends HTMLElement {
    session!: Session; // set before it is connected
    /** Tells the picture to lean. */
    onTilt: (front: number, left: number) => void = () => undefined;
    private readonly speeds = new Map<number, HTMLButtonElement>();
    private readonly leds = make('div', { class: 'leds', role: 'img', 'aria-label': 'Lamps' });
    private readonly clock = make('p', { class: 'clock' });
    private readonly floor = { tiltFront: 0, tiltLeft: 0, friction: 0.8 };
    private readonly disposals: (() => void)[] = [];

    connectedCallback(): void {
        const servos = new ServoTable();
        servos.session = this.session;
        this.replaceChildren(
            make('p', { class: 'only-simulated' }, TEXTS.onlyInPage),
            make(
                'div',
                { class: 'sections' },
                this.timeSection(),
                this.powerSection(),
                this.roomSection(),
                this.imageSection(),
                this.lawSection(),
                servos,
            ),
        );
        this.disposals.push(
            this.session.state.watch(state => this.render(state)),
            this.session.onFrame(state => {
                setText(
                    this.clock,
                    `${(state.ticks / TICKS_PER_SECOND).toFixed(1)} s${state.lateMs > 50 ? `, ${Math.round(state.lateMs)} ms late` : ''}`,
                );
                this.showLeds(state.leds);
            }),
        );
    }

    disconnectedCallback(): void {
        for (const dispose of this.disposals.splice(0)) dispose();
    }

    private render(state: SessionState): void {
        this.classList.toggle('off', state.source !== 'simulated');
        for (const [speed, button] of this.speeds) button.setAttribute('aria-pressed', String(speed === state.speed));
    }

    private showLeds(bits: number): void {
        if (this.leds.dataset.bits === String(bits)) return;
        this.leds.dataset.bits = String(bits);
        this.leds.replaceChildren(...LEDS.map((name, i) => make('span', { class: (bits >> i) & 1 ? 'lit' : '' }, name)));
        const lit = LEDS.filter((_, i) => (bits >> i) & 1);
        this.leds.setAttribute('aria-label', `Lamps lit: ${lit.join(', ') || 'none'}`);
    }

    private section(title: string, ...children: (Node | string)[]): HTMLElement {
        return make('section', { 'aria-label': title }, make('h2', {}, title), ...children);
    }

    private timeSection(): HTMLElement {
        const row = make('div', { class: 'row' });
        const pause = make('button', { onclick: () => this.session.sim.setSpeed(0) }, 'Pause');
        this.speeds.set(0, pause);
        row.append(pause, make('button', { onclick: () => this.session.sim.oneTick() }, 'One tick'));
        for (const [speed, title] of SPEEDS) {
            const button = make('button', { onclick: () => this.session.sim.setSpeed(speed) }, title);
            this.speeds.set(speed, button);
            row.append(button);
        }
        const section = this.section('Time', row, this.clock);
        section.classList.add('time');
        return section;
    }

    private powerSection(): HTMLElement {
        const row = make(
            'div',
            { class: 'row' },
            make('button', { onclick: () => this.session.sim.setPower(true) }, 'Power on'),
            make('button', { onclick: () => this.session.sim.setPower(false) }, 'Power off'),
            make('button', { onclick: () => void this.session.setTorque(false) }, 'Torque off'),
        );
        for (const [name, sign] of PANEL) row.append(this.panelButton(name, sign));
        return this.section(
            'Power and panel',
            row,
            this.leds,
            this.slider('Battery', 6, 12.6, 0.1, NOMINAL_VOLTS, ' V', volts => this.session.sim.setBattery(volts)),
        );
    }

    private panelButton(name: PanelButton, sign: string): HTMLButtonElement {
        const button = make('button', { 'aria-label': `panel button ${name}` }, sign);
        button.addEventListener('pointerdown', () => this.session.sim.press(name, true));
        for (const end of ['pointerup', 'pointerleave'] as const) button.addEventListener(end, () => this.session.sim.press(name, false));
        const isPress = ({ key }: KeyboardEvent): boolean => key === 'Enter' || key === ' ';
        button.addEventListener('keydown', event => isPress(event) && !event.repeat && this.session.sim.press(name, true));
        button.addEventListener('keyup', event => isPress(event) && this.session.sim.press(name, false));
        button.addEventListener('blur', () => this.session.sim.press(name, false));
        return button;
    }

    private roomSection(): HTMLElement {
        const set = (change: Partial<typeof this.floor>): void => {
            Object.assign(this.floor, change);
            this.session.sim.setFloor({ ...this.floor });
            this.onTilt(this.floor.tiltFront, this.floor.tiltLeft);
        };
        return this.section(
            'Hand and floor',
            make(
                'div',
                { class: 'row' },
                make('button', { onclick: () => this.session.sim.hold(true) }, 'Put on its feet'),
                make('button', { onclick: () => pushRobot(this.session, 1) }, 'Push ahead'),
                make('button', { onclick: () => pushRobot(this.session, -1) }, 'Push back'),
            ),
            this.slider('Slope to the front', -15, 15, 1, 0, '°', angle => set({ tiltFront: angle * RADIANS })),
            this.slider('Slope to the left', -15, 15, 1, 0, '°', angle => set({ tiltLeft: angle * RADIANS })),
            this.slider('Grip of the floor', 0, 1.5, 0.05, 0.8, '', friction => set({ friction })),
        );
    }

    private imageSection(): HTMLElement {
        const image = (name: ImageName, title: string): HTMLButtonElement =>
            make('button', { onclick: () => this.session.runImage(name) }, title);
        return this.section(
            'Firmware',
            make(
                'div',
                { class: 'row' },
                image('play', 'Run Play'),
                image('edit', 'Run Edit'),
                make('button', { onclick: () => void this.askForget() }, 'Factory fresh'),
            ),
        );
    }

    private lawSection(): HTMLElement {
        const row = make('div', { class: 'row' });
        for (const [law, title, hint] of [
            ['exact', LAW_TEXTS.exact, LAW_TEXTS.exactHint],
            ['classic', LAW_TEXTS.classic, LAW_TEXTS.classicHint],
        ] as const) {
            const button = make('button', { title: hint, onclick: () => this.session.editor.select({ law }) }, title);
            this.disposals.push(this.session.editor.state.watch(state => button.setAttribute('aria-pressed', String(state.law === law))));
            row.append(button);
        }
        return this.section(LAW_TEXTS.title, row, make('p', { class: 'hint' }, LAW_TEXTS.hint));
    }

    private async askForget(): Promise<void> {
        if ((await ask('Factory fresh?', TEXTS.factoryFresh, [['Forget everything', 'forget']])) !== null) await this.session.forget();
    }

    private slider(
        title: string,
        min: number,
        max: number,
        step: number,
        value: number,
        unit: string,
        set: (value: number) => void,
    ): HTMLElement {
        const output = make('output', {}, `${value}${unit}`);
        const input = make('input', { type: 'range', min, max, step, value });
        input.addEventListener('input', () => {
            output.value = `${input.valueAsNumber}${unit}`;
            set(input.valueAsNumber);
        });
        return make('label', { class: 'slider' }, make('span', {}, title), input, output);
    }
}

define('robot-pane', RobotPane);
