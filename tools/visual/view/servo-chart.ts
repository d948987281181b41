// SPDX-License-Identifier: MIT
// Goals and positions of one servo over the last six seconds of robot time, tick by tick.

import { TICKS_PER_SECOND } from '../model/motion.ts';
import type { RobotState } from '../robot/robot-state.ts';
import { define, make } from './element.ts';
import { TEXTS } from './texts/texts.ts';

const TICKS = TICKS_PER_SECOND * 6;
const MARGIN_UNITS = 12;
const LEAST_SPAN = 80;
const DRAWN_EVERY_MS = 60;

export class ServoChart extends HTMLElement {
    private readonly canvas = make('canvas', { role: 'img' });
    private readonly goals: number[] = [];
    private readonly positions: number[] = [];
    private servo = 0;
    private drawnMs = 0;

    connectedCallback(): void {
        this.replaceChildren(this.canvas);
    }

    /** Charts another servo, from an empty chart. */
    choose(servo: number): void {
        this.servo = servo;
        this.goals.length = this.positions.length = 0;
        this.canvas.setAttribute('aria-label', TEXTS.servos.chart(servo));
    }

    take(state: RobotState): void {
        const index = state.servos.findIndex(servo => servo.id === this.servo);
        const row = 2 * state.servos.length;
        if (index < 0) return;
        for (let at = 2 * index; at < state.trace.length; at += row) {
            this.goals.push(state.trace[at] ?? 0);
            this.positions.push(state.trace[at + 1] ?? 0);
        }
        for (const list of [this.goals, this.positions]) list.splice(0, Math.max(0, list.length - TICKS));
        const nowMs = performance.now();
        if (nowMs - this.drawnMs < DRAWN_EVERY_MS || this.offsetParent === null) return;
        this.drawnMs = nowMs;
        this.draw();
    }

    private draw(): void {
        const width = this.clientWidth * devicePixelRatio;
        const height = this.clientHeight * devicePixelRatio;
        if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
        const context = this.canvas.getContext('2d');
        if (!context || this.goals.length < 2) return;
        const all = [...this.goals, ...this.positions];
        const middle = (Math.min(...all) + Math.max(...all)) / 2;
        const half = Math.max(LEAST_SPAN, Math.max(...all) - Math.min(...all) + 2 * MARGIN_UNITS) / 2;
        context.clearRect(0, 0, width, height);
        const style = getComputedStyle(this);
        const y = (units: number): number => height * (0.5 - (units - middle) / (2 * half));
        const line = (values: readonly number[], colour: string, dash: number[]): void => {
            context.beginPath();
            for (const [i, value] of values.entries()) context.lineTo(width * (1 - (values.length - 1 - i) / TICKS), y(value));
            context.strokeStyle = style.getPropertyValue(colour);
            context.setLineDash(dash);
            context.lineWidth = 1.5 * devicePixelRatio;
            context.stroke();
        };
        context.font = `${11 * devicePixelRatio}px ${style.fontFamily}`;
        context.fillStyle = style.getPropertyValue('--ink-soft');
        context.fillText(String(Math.round(middle + half)), 4, 12 * devicePixelRatio);
        context.fillText(String(Math.round(middle - half)), 4, height - 4);
        line(this.goals, '--ink-soft', [5 * devicePixelRatio, 4 * devicePixelRatio]);
        line(this.positions, '--accent', []);
    }
}

define('servo-chart', ServoChart);
