// SPDX-License-Identifier: MIT
// The curves of the page, computed by the firmware's own player and redrawn at every change. curve-hand.ts handles the input.

import type { TickSpan } from '../../model/curve-speed.ts';
import { jointAngle } from '../../model/body.ts';
import type { Body, Joint } from '../../model/body.ts';
import { AS_STORED, NOMINAL_VOLTS } from '../../model/motion.ts';
import type { Shape } from '../../model/motion.ts';
import { define, make, setText, withoutMenu } from '../element.ts';
import { jointTitle } from '../texts/robot.ts';
import { TEXTS } from '../texts/texts.ts';
import { CurveHand, jointAt, nearestPoint } from './curve-hand.ts';
import type { CurveDrawing } from './curve-hand.ts';
import { CurveFrame, drawCurves } from './curve-picture.ts';
import type { CurveColours, CurveScene, WayPoint } from './curve-picture.ts';
import { curveScene } from './curve-scene.ts';
import { ServoFollow } from './servo-follow.ts';
import { SessionElement } from '../session-element.ts';

export const CHOSEN_COLOURS = ['--curve-1', '--curve-2', '--curve-3', '--curve-4', '--curve-5', '--curve-6'];

/** What a drawing shows, as data. */
export interface Drawn {
    /** Spans that are too fast, by joint. */
    readonly fast: ReadonlyMap<number, readonly TickSpan[]>;
    readonly isShaped: boolean;
    /** Joints with bold lines, in order of their colours. */
    readonly chosen: readonly number[];
    /** Largest lag of the chosen joints in physics (servo units); empty: unknown. */
    readonly lags: ReadonlyMap<number, number>;
    /** Physics could not compute the lag. */
    readonly isUnknown: boolean;
}

export class CurveCanvas extends SessionElement {
    onDrawn: (drawn: Drawn) => void = () => undefined;
    private shape = AS_STORED;
    private readonly canvas = make('canvas', { tabindex: 0, role: 'img', 'aria-label': TEXTS.curves.curves });
    private readonly label = make('p', { class: 'point', 'aria-hidden': true });
    private drawing: CurveDrawing | null = null;
    private hand!: CurveHand; // this and `follow` need the session, so connectedCallback() makes them
    private follow!: ServoFollow;
    private request = 0;

    connectedCallback(): void {
        this.replaceChildren(this.canvas, this.label);
        this.hand = new CurveHand(this.session);
        this.follow = new ServoFollow(this.session, () => this.later());
        const { canvas } = this;
        withoutMenu(canvas);
        canvas.addEventListener('pointerdown', event => this.down(event));
        canvas.addEventListener('pointermove', event => this.move(event));
        canvas.addEventListener('pointerleave', () => (this.label.textContent = ''));
        canvas.addEventListener('pointerup', () => this.end(true));
        canvas.addEventListener('pointercancel', () => this.end(false));
        // A finger that touches no way-point scrolls the area.
        canvas.addEventListener('touchstart', event => this.hand.dragged && event.preventDefault(), { passive: false });
        canvas.addEventListener('keydown', event => this.hand.key(event) && event.preventDefault());
        canvas.addEventListener('keyup', () => this.hand.keyUp());
        canvas.addEventListener('blur', () => this.hand.keyUp());
        const sizes = new ResizeObserver(() => this.later());
        sizes.observe(this);
        const themes = new MutationObserver(() => this.later());
        themes.observe(document.documentElement, { attributeFilter: ['data-theme'] });
        this.disposals.push(
            () => this.end(true),
            () => this.follow.dispose(),
            () => sizes.disconnect(),
            () => themes.disconnect(),
            () => cancelAnimationFrame(this.request),
            this.session.editor.state.watch(() => this.later()),
        );
    }

    setShape(shape: Shape): void {
        this.shape = shape;
        this.later();
    }

    setFollow(on: boolean): void {
        this.follow.setOn(on);
    }

    /** Draws at most once per frame, and only while the area is shown. */
    private later(): void {
        if (this.request !== 0) return;
        this.request = requestAnimationFrame(() => {
            this.request = 0;
            if (this.clientWidth > 0) this.draw();
        });
    }

    private draw(): void {
        const scene = this.makeScene();
        const [width, height] = [this.clientWidth, this.clientHeight];
        const sharpness = Math.min(devicePixelRatio, 2);
        const [w, h] = [Math.round(width * sharpness), Math.round(height * sharpness)];
        if (this.canvas.width !== w || this.canvas.height !== h) Object.assign(this.canvas, { width: w, height: h });
        const context = this.canvas.getContext('2d');
        if (!context) return;
        context.setTransform(sharpness, 0, 0, sharpness, 0, 0);
        context.clearRect(0, 0, width, height);
        this.drawing = scene && { scene, frame: new CurveFrame(this.hand.dragged ?? scene, width, height) };
        if (this.drawing) drawCurves(context, this.drawing.frame, this.drawing.scene, this.colours());
        this.onDrawn({
            fast: scene?.fast ?? new Map(),
            isShaped: !!scene?.stored,
            chosen: [...(scene?.chosen ?? [])],
            lags: this.lags(scene),
            isUnknown: this.follow.isUnknown,
        });
    }

    private lags(scene: CurveScene | null): Map<number, number> {
        return new Map(
            [...(scene?.chosen ?? [])].flatMap(joint => {
                const lag = scene && this.follow.lag(scene.curve, joint);
                return lag === null ? [] : [[joint, lag] as const];
            }),
        );
    }

    private makeScene(): CurveScene | null {
        const {
            shape,
            hand,
            session: { editor, state },
        } = this;
        const scene = curveScene(editor, { shape, volts: state.get().where?.batteryVolts || NOMINAL_VOLTS, edges: hand.dragged });
        if (!scene) return null;
        this.follow.look(scene.curve.ticks, shape);
        return { ...scene, followed: this.follow.positions, degrees: degreesFor(this.session.body, scene.chosen) };
    }

    private colours(): CurveColours {
        const style = getComputedStyle(this);
        const colour = (name: string): string => style.getPropertyValue(name).trim();
        return {
            line: colour('--ink'),
            faint: colour('--curve-faint'),
            fast: colour('--bad'),
            grid: colour('--line'),
            text: colour('--ink-soft'),
            ground: colour('--panel-low'),
            chosen: CHOSEN_COLOURS.map(colour),
        };
    }

    private down(event: PointerEvent): void {
        if (event.button !== 0 || !this.drawing) return;
        event.preventDefault(); // prevents text selection
        this.canvas.focus({ preventScroll: true });
        if (this.hand.down(this.drawing, event, event.shiftKey || event.ctrlKey)) this.canvas.setPointerCapture(event.pointerId);
    }

    private move(event: PointerEvent): void {
        if (this.hand.dragged) this.hand.move(event);
        else this.hover(event);
    }

    private hover(event: PointerEvent): void {
        const { drawing } = this;
        const point = drawing && nearestPoint(drawing, event);
        this.canvas.classList.toggle('over-point', !!point);
        const joint = point?.joint ?? (drawing && jointAt(drawing, event));
        const servo = this.session.body.joints.find(one => one.servo === joint);
        setText(this.label, servo ? lineText(servo, point ?? null) : '');
    }

    private end(keep: boolean): void {
        if (this.hand.up(keep)) this.later();
    }
}

function lineText(joint: Joint, point: WayPoint | null): string {
    const title = jointTitle(joint);
    if (!point) return TEXTS.curves.line(joint.servo, title);
    const degrees = `${Math.round((jointAngle(joint, point.position) * 180) / Math.PI)}°`;
    return TEXTS.curves.atStep(joint.servo, title, point.step + 1, point.position, degrees);
}

/** Converts positions to degrees. null: no joints, or they differ in direction, zero or scale; joints of one limb do not. */
export function degreesFor(body: Body, servos: ReadonlySet<number>): ((position: number) => number) | null {
    const joints = body.joints.filter(({ servo }) => servos.has(servo));
    const [first] = joints;
    if (!first) return null;
    const isAlike = joints.every(
        one => one.direction === first.direction && one.zero === first.zero && one.radiansPerUnit === first.radiansPerUnit,
    );
    return isAlike ? position => (jointAngle(first, position) * 180) / Math.PI : null;
}

define('curve-canvas', CurveCanvas);
