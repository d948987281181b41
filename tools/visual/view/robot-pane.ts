// SPDX-License-Identifier: MIT
// Controls of the simulated robot: time, power, battery, floor, firmware, player, servos and their faults.

import { NOMINAL_VOLTS, TICKS_PER_SECOND } from '../model/motion.ts';
import type { SessionState, ImageName, PanelButton } from './session/session.ts';
import type { RobotState } from '../robot/robot-state.ts';
import { ask } from './editor/ask-dialog.ts';
import { define, make, setText } from './element.ts';
import { pushRobot } from './push.ts';
import { ServoTable } from './servo-table.ts';
import { TEXTS } from './texts/texts.ts';
import { SessionElement } from './session-element.ts';
import './robot-pane.css';

/** Factors for the robot's time, with labels; without a label: real time. */
const SPEEDS: readonly (readonly [number, string?])[] = [[0.1, '0.1×'], [0.25, '¼×'], [0.5, '½×'], [1], [2, '2×'], [4, '4×']];
const PANEL: readonly (readonly [PanelButton, string])[] = [
    ['up', '▲'],
    ['down', '▼'],
    ['left', '◀'],
    ['right', '▶'],
    ['start', 'START'],
    ['mode', 'MODE'],
];
/** Labels as printed on the board. */
const LEDS = ['Power', 'TxD', 'RxD', 'Aux', 'Manage', 'Program', 'Play'];
const SEEN_LATE_MS = 50;
const RADIANS = Math.PI / 180;

export class RobotPane extends SessionElement {
    /** Tilts the picture (radians). */
    onTilt: (front: number, left: number) => void = () => undefined;
    private readonly speeds = new Map<number, HTMLButtonElement>();
    private readonly leds = make('div', { class: 'leds', role: 'img', 'aria-label': TEXTS.robotPane.lamps });
    private readonly clock = make('p', { class: 'clock' });
    private readonly floor = { tiltFront: 0, tiltLeft: 0, friction: 0.8 };

    connectedCallback(): void {
        this.replaceChildren(
            make('p', { class: 'only-simulated' }, TEXTS.robotPane.onlyInPage),
            make(
                'div',
                { class: 'sections' },
                this.timeSection(),
                this.powerSection(),
                this.roomSection(),
                this.imageSection(),
                this.lawSection(),
                this.give(new ServoTable()),
            ),
        );
        this.disposals.push(
            this.session.state.watch(state => this.render(state)),
            this.session.onFrame(state => {
                setText(this.clock, clockText(state));
                this.showLeds(state.leds);
            }),
        );
    }

    private render(state: SessionState): void {
        const isOff = state.source !== 'simulated';
        if (isOff !== this.classList.contains('off')) this.onTilt(isOff ? 0 : this.floor.tiltFront, isOff ? 0 : this.floor.tiltLeft);
        this.classList.toggle('off', isOff);
        for (const section of this.querySelectorAll<HTMLElement>('.sections > section')) section.inert = isOff; // for the keyboard, too
        for (const [speed, button] of this.speeds) button.setAttribute('aria-pressed', String(speed === state.speed));
    }

    private showLeds(bits: number): void {
        if (this.leds.dataset.bits === String(bits)) return;
        this.leds.dataset.bits = String(bits);
        this.leds.replaceChildren(...LEDS.map((name, i) => make('span', { class: (bits >> i) & 1 ? 'lit' : '' }, name)));
        const lit = LEDS.filter((_, i) => (bits >> i) & 1);
        this.leds.setAttribute('aria-label', TEXTS.robotPane.lit(lit));
    }

    private section(title: string, ...children: (Node | string)[]): HTMLElement {
        return make('section', { 'aria-label': title }, make('h2', {}, title), ...children);
    }

    private timeSection(): HTMLElement {
        const row = make('div', { class: 'row' });
        const pause = make('button', { onclick: () => this.session.sim.setSpeed(0) }, TEXTS.robotPane.pause);
        this.speeds.set(0, pause);
        row.append(pause, make('button', { onclick: () => this.session.sim.oneTick() }, TEXTS.robotPane.oneTick));
        for (const [speed, title] of SPEEDS) {
            const button = make('button', { onclick: () => this.session.sim.setSpeed(speed) }, title ?? TEXTS.robotPane.realTime);
            this.speeds.set(speed, button);
            row.append(button);
        }
        const section = this.section(TEXTS.robotPane.time, row, this.clock);
        section.classList.add('time');
        return section;
    }

    private powerSection(): HTMLElement {
        const row = make(
            'div',
            { class: 'row' },
            make('button', { onclick: () => this.session.sim.setPower(true) }, TEXTS.robotPane.powerOn),
            make('button', { onclick: () => this.session.sim.setPower(false) }, TEXTS.robotPane.powerOff),
            make('button', { onclick: () => void this.session.setTorque(false) }, TEXTS.robotPane.torqueOff),
        );
        for (const [name, sign] of PANEL) row.append(this.panelButton(name, sign));
        return this.section(
            TEXTS.robotPane.power,
            row,
            this.leds,
            this.slider(TEXTS.robotPane.battery, 6, 12.6, 0.1, NOMINAL_VOLTS, ' V', volts => this.session.sim.setBattery(volts)),
        );
    }

    private panelButton(name: PanelButton, sign: string): HTMLButtonElement {
        const button = make('button', { 'aria-label': TEXTS.robotPane.panel[name] }, sign);
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
            TEXTS.robotPane.room,
            make(
                'div',
                { class: 'row' },
                make('button', { onclick: () => this.session.sim.hold(true) }, TEXTS.robotPane.stand),
                make('button', { onclick: () => pushRobot(this.session, 1) }, TEXTS.robotPane.pushAhead),
                make('button', { onclick: () => pushRobot(this.session, -1) }, TEXTS.robotPane.pushBack),
            ),
            this.slider(TEXTS.robotPane.slopeFront, -15, 15, 1, 0, '°', angle => set({ tiltFront: angle * RADIANS })),
            this.slider(TEXTS.robotPane.slopeLeft, -15, 15, 1, 0, '°', angle => set({ tiltLeft: angle * RADIANS })),
            this.slider(TEXTS.robotPane.grip, 0, 1.5, 0.05, 0.8, '', friction => set({ friction })),
        );
    }

    private imageSection(): HTMLElement {
        const image = (name: ImageName, title: string): HTMLButtonElement =>
            make('button', { onclick: () => this.session.runImage(name) }, title);
        return this.section(
            TEXTS.robotPane.firmware,
            make(
                'div',
                { class: 'row' },
                image('play', TEXTS.robotPane.runPlay),
                image('edit', TEXTS.robotPane.runEdit),
                make('button', { onclick: () => void this.askForget() }, TEXTS.robotPane.fresh),
            ),
        );
    }

    private lawSection(): HTMLElement {
        const row = make('div', { class: 'row' });
        for (const [law, title, hint] of [
            ['exact', TEXTS.robotPane.exact, TEXTS.robotPane.exactHint],
            ['classic', TEXTS.robotPane.classic, TEXTS.robotPane.classicHint],
        ] as const) {
            const button = make('button', { title: hint, onclick: () => this.session.editor.select({ law }) }, title);
            this.disposals.push(this.session.editor.state.watch(state => button.setAttribute('aria-pressed', String(state.law === law))));
            row.append(button);
        }
        return this.section(TEXTS.robotPane.law, row, make('p', { class: 'hint' }, TEXTS.robotPane.lawHint));
    }

    private async askForget(): Promise<void> {
        const { robotPane } = TEXTS;
        if ((await ask(robotPane.askFresh, robotPane.freshMeans, [[robotPane.forget, 'forget']])) !== null) await this.session.forget();
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

/** The robot's time, and its delay if that is noticeable. */
function clockText({ ticks, lateMs }: RobotState): string {
    const seconds = (ticks / TICKS_PER_SECOND).toFixed(1);
    return lateMs > SEEN_LATE_MS ? TEXTS.robotPane.late(seconds, Math.round(lateMs)) : `${seconds} s`;
}

define('robot-pane', RobotPane);
