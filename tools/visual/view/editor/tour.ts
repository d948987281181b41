// SPDX-License-Identifier: MIT
// The tour: two minutes to the first wave. A card says what to do next and a ring shows where. It advances when the goal is reached, or by
// its button. It never acts for the user.

import type { RobotState } from '../../robot/robot-state.ts';
import { define, handOver, make, pictureCanvas, setText } from '../element.ts';
import type { Store } from '../store.ts';
import type { Editing } from './editing.ts';
import { TEXTS } from '../texts/texts.ts';
import { TourPlace } from './tour-place.ts';
import { tourStops } from './tour-stops.ts';
import type { TourStop } from './tour-stops.ts';
import { SessionElement } from '../session-element.ts';
import './tour.css';

/** Change in servo units from which the arm counts as dragged. */
const MOVED_UNITS = 25;
const RING_PX = 46;

export class TourCard extends SessionElement {
    editing!: Store<Editing>; // set before it is connected
    /** Screen position of a shape of the robot. */
    placeOf: (shape: string) => { readonly x: number; readonly y: number } | null = () => null;
    /** Called when a stop's target is in an area, not in the picture. */
    onArea: () => void = () => undefined;
    onSend: () => void = () => undefined;
    private readonly stops = tourStops();
    private readonly place = new TourPlace(this.stops.length);
    private robot: RobotState | null = null;
    private armBefore: readonly number[] = [];
    /** The one that got its steps here. The user may have chosen another one since. */
    private motion: number | null = null;
    private readonly heading = make('h2', {});
    private readonly text = make('p', { role: 'status', 'aria-label': TEXTS.tour.tour });
    private readonly next = make('button', { onclick: () => this.go(this.place.at + 1) }, TEXTS.tour.next);
    private readonly send = make('button', { class: 'primary', onclick: () => this.sendMotion() }, TEXTS.tour.send);
    private readonly quit = make('button', { onclick: () => this.end() }, TEXTS.tour.end);
    private readonly ring = make('div', { class: 'tour-ring', 'aria-hidden': true });

    connectedCallback(): void {
        this.hidden = true;
        this.setAttribute('role', 'region');
        this.setAttribute('aria-label', TEXTS.tour.tour);
        this.replaceChildren(
            this.heading,
            this.text,
            make(
                'div',
                { class: 'row' },
                make('button', { class: 'back', onclick: () => this.go(this.place.at - 1, true) }, TEXTS.tour.back),
                this.send,
                this.next,
                make('span', { class: 'space' }),
                this.quit,
            ),
        );
        this.ring.hidden = true;
        document.body.append(this.ring);
        this.disposals.push(
            this.session.onFrame(robot => {
                this.robot = robot;
                this.look();
            }),
            () => this.ring.remove(),
        );
        this.watch(() => this.look(), this.session.state, this.session.editor.state, this.editing);
    }

    start(): void {
        this.hidden = false;
        this.motion = null;
        this.go(0);
        this.next.focus();
    }

    /** Starts at the stop for a new motion, in Steps, for users who want to teach. */
    teach(): void {
        this.hidden = false;
        this.motion = null;
        this.session.show('steps');
        this.go(this.stops.findIndex(({ goal }) => goal === 'new-page'));
        this.look();
    }

    private end(): void {
        handOver(this, pictureCanvas(), () => (this.hidden = this.ring.hidden = true));
    }

    private go(to: number, isBack = false): void {
        if (!this.place.go(to, isBack)) return this.end();
        const { at } = this.place;
        this.armBefore = this.arm();
        this.heading.textContent = TEXTS.tour.title(at + 1, this.stops.length);
        this.next.textContent = this.isLast ? TEXTS.tour.done : at === 0 ? TEXTS.tour.start : TEXTS.tour.next;
        this.write();
        this.lead(this.stop?.target ?? '');
        this.showRing();
    }

    /** What the card says is true of the robot in the page: its arm is dragged in the picture, and Play writes to it. */
    private get isForThisRobot(): boolean {
        return this.session.state.get().source === 'simulated';
    }

    private write(): void {
        setText(this.text, this.isForThisRobot ? (this.stop?.text ?? '') : TEXTS.robotPane.onlyInPage);
        this.next.hidden = !this.isForThisRobot;
        this.quit.hidden = this.isForThisRobot && this.isLast; // its room is needed on a phone that lies, and Done does the same
        this.send.hidden = !this.isForThisRobot || this.stop?.goal !== 'send';
    }

    /** Moves the card out of the way of a target in the picture; scrolls a target in an area into view. */
    private lead(target: string): void {
        this.classList.toggle('low', target !== '' && !target.startsWith('#'));
        if (!target.startsWith('#')) return;
        this.onArea();
        this.find(target.slice(1))?.scrollIntoView({ block: 'nearest' });
    }

    private get isLast(): boolean {
        return this.place.at === this.stops.length - 1;
    }

    private get stop(): TourStop | null {
        return this.stops[this.place.at] ?? null;
    }

    private look(): void {
        if (this.hidden || !this.stop) return;
        this.write();
        if (!this.isForThisRobot || !this.place.isOver(this.isReached(this.stop))) return this.showRing();
        if (this.stop.goal === 'add') this.motion = this.session.editor.state.get().page;
        this.go(this.place.at + 1);
    }

    private sendMotion(): void {
        if (this.motion !== null) this.session.editor.select({ page: this.motion });
        this.onSend();
    }

    private arm(): number[] {
        return (this.robot?.servos ?? []).filter(servo => ARM.includes(servo.id)).map(servo => servo.position);
    }

    private isReached({ goal, steps }: TourStop): boolean {
        const { tab, where } = this.session.state.get();
        const { editor } = this.session;
        const { page } = editor.state.get();
        const view = editor.page(page);
        switch (goal) {
            case 'read':
            case 'send':
                return false;
            case 'steps-tab':
                return tab === 'steps';
            case 'new-page':
                return tab === 'steps' && view.steps.length === 0;
            case 'let-go':
                return ARM.every(servo => this.editing.get().taught.has(servo));
            case 'drag':
                return this.hasMoved() && this.holds();
            case 'add':
                return view.steps.length >= (steps ?? 1);
            case 'name':
                return view.name !== '';
            case 'times':
                return view.repetitions > 1;
            case 'play':
                return where?.state === 'playing' && where.page === page;
            default:
                return goal satisfies never;
        }
    }

    private hasMoved(): boolean {
        const now = this.arm();
        return now.some((position, i) => Math.abs(position - (this.armBefore[i] ?? position)) > MOVED_UNITS);
    }

    private holds(): boolean {
        return this.robot?.servos.filter(servo => ARM.includes(servo.id)).every(servo => servo.torque) === true;
    }

    private showRing(): void {
        const target = this.isForThisRobot ? (this.stop?.target ?? '') : '';
        const box = target.startsWith('#') ? this.boxOf(target.slice(1)) : this.boxOfShape(target);
        this.ring.hidden = box === null;
        if (!box) return;
        const { style } = this.ring;
        for (const [name, value] of Object.entries(box)) style.setProperty(name, `${Math.round(value)}px`);
    }

    /** Box around a tab, button or field with this accessible name. */
    private boxOf(name: string): { left: number; top: number; width: number; height: number } | null {
        const box = this.find(name)?.getBoundingClientRect();
        return box && box.width > 0 ? { left: box.left - 4, top: box.top - 4, width: box.width + 8, height: box.height + 8 } : null;
    }

    private find(name: string): HTMLElement | undefined {
        const all = document.querySelectorAll<HTMLElement>('[role="tab"], .area:not([hidden]) button, .area:not([hidden]) input');
        return [...all].find(element => (element.getAttribute('aria-label') ?? element.textContent) === name);
    }

    private boxOfShape(shape: string): { left: number; top: number; width: number; height: number } | null {
        const at = shape === '' ? null : this.placeOf(shape);
        return at && { left: at.x - RING_PX / 2, top: at.y - RING_PX / 2, width: RING_PX, height: RING_PX };
    }
}

/** Servos of the right arm. */
const ARM: readonly number[] = [1, 3, 5];

define('tour-card', TourCard);
