// SPDX-License-Identifier: MIT
// All servos: goal, position, torque, alarms and a simulated fault for each. The chosen one is charted over time.

import type { RobotState, ServoState } from '../robot/robot-state.ts';
import { onChoice } from './choice.ts';
import { define, make, setText } from './element.ts';
import { ServoChart } from './servo-chart.ts';
import { jointTitle } from './texts/robot.ts';
import { TEXTS } from './texts/texts.ts';
import { SessionElement } from './session-element.ts';

const FRAMES_A_SECOND = 60;
const UPDATES_A_SECOND = 10;

interface Row {
    readonly goal: HTMLTableCellElement;
    readonly position: HTMLTableCellElement;
    readonly state: HTMLTableCellElement;
    readonly fault: HTMLSelectElement;
}

export class ServoTable extends SessionElement {
    private readonly chart = new ServoChart();
    private readonly rows = new Map<number, Row>();
    private frame = 0;

    connectedCallback(): void {
        const { servos: texts } = TEXTS;
        const body = make('tbody');
        for (const joint of [...this.session.body.joints].sort((a, b) => a.servo - b.servo))
            body.append(this.row(joint.servo, jointTitle(joint)));
        const head = make(
            'tr',
            {},
            ...['', texts.joint, texts.goal, texts.position, texts.state, texts.fault].map(title => make('th', { scope: 'col' }, title)),
        );
        this.replaceChildren(
            make(
                'section',
                { 'aria-label': texts.servos },
                make('h2', {}, texts.title),
                this.chart,
                make('div', { class: 'scroll' }, make('table', {}, make('thead', {}, head), body)),
            ),
        );
        this.chart.choose(13);
        this.disposals.push(
            this.session.onFrame(state => this.take(state)),
            this.session.state.watch(state => this.fillFaults(state.faultNames)),
        );
    }

    private row(servo: number, title: string): HTMLTableRowElement {
        const cells = { goal: make('td', { class: 'number' }), position: make('td', { class: 'number' }), state: make('td') };
        const fault = make('select', { 'aria-label': TEXTS.servos.faultOf(servo) });
        onChoice(fault, () => this.setFault(servo, fault));
        const choice = make('input', { type: 'radio', name: 'charted', 'aria-label': TEXTS.servos.draw(servo), checked: servo === 13 });
        choice.addEventListener('change', () => this.chart.choose(servo));
        this.rows.set(servo, { ...cells, fault });
        return make(
            'tr',
            {},
            make('td', {}, choice),
            make('th', { scope: 'row' }, `${servo} ${title}`),
            cells.goal,
            cells.position,
            cells.state,
            make('td', {}, fault),
        );
    }

    private fillFaults(names: readonly string[]): void {
        for (const { fault } of this.rows.values()) {
            if (fault.options.length === names.length + 1) continue;
            fault.replaceChildren(
                make('option', { value: '' }, TEXTS.servos.noFault),
                ...names.map((name, i) => make('option', { value: i }, TEXTS.servos.faults[name] ?? name)),
            );
        }
    }

    private setFault(servo: number, fault: HTMLSelectElement): void {
        for (let i = 0; i < fault.options.length - 1; i++) this.session.sim.setFault(servo, i, fault.value === String(i));
    }

    private take(state: RobotState): void {
        this.chart.take(state);
        if (this.frame++ % (FRAMES_A_SECOND / UPDATES_A_SECOND) !== 0 || this.offsetParent === null) return;
        for (const servo of state.servos) this.update(servo);
    }

    private update(servo: ServoState): void {
        const row = this.rows.get(servo.id);
        if (!row) return;
        setText(row.goal, servo.torque && servo.goalPos !== null ? String(servo.goalPos) : '–');
        setText(row.position, servo.position.toFixed(0));
        const alarms = TEXTS.servos.alarms.filter((_, i) => (servo.alarms >> i) & 1);
        setText(row.state, alarms.length > 0 ? alarms.join(', ') : servo.torque ? TEXTS.servos.holds : TEXTS.servos.limp);
        row.state.classList.toggle('alarm', alarms.length > 0);
    }
}

define('servo-table', ServoTable);
