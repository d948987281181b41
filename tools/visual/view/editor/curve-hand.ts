// SPDX-License-Identifier: MIT
// Input on the curves. Mouse or finger: dragging a way-point vertically changes a position, horizontally a time; a click chooses a joint.
// Keys: left and right choose the step, up and down turn the chosen joints, Alt with left and right changes the time.

import { JOINTS, POSITION_MAX, TICKS_PER_SECOND } from '../../model/motion.ts';
import { BYTE_MAX } from '../../model/page.ts';
import type { Session } from '../session/session.ts';
import type { Gesture } from '../session/editor.ts';
import type { CurveFrame, CurveScene, WayPoint } from './curve-picture.ts';
import { JointTurn } from './joint-turn.ts';
import { nearestSetting } from './step-times.ts';

const NEAR_PX = { mouse: 12, finger: 26 };
/** Distance of a drag after which its direction decides between position and time. */
const CLEAR_PX = 4;
const COARSE_UNITS = 10;

/** The current drawing on the canvas. */
export interface CurveDrawing {
    readonly scene: CurveScene;
    readonly frame: CurveFrame;
}

/** A point on the canvas in pixels, and the type of its pointer; `touch`: a finger. */
interface Spot {
    readonly pointerType: string;
    readonly offsetX: number;
    readonly offsetY: number;
}

interface Drag extends CurveDrawing {
    readonly point: WayPoint;
    readonly gesture: Gesture;
    readonly start: Spot;
    axis: 'position' | 'time' | null;
}

export class CurveHand {
    private readonly session: Session;
    private readonly arrows: JointTurn;
    private drag: Drag | null = null;

    constructor(session: Session) {
        this.session = session;
        const { editor, body } = session;
        this.arrows = new JointTurn(editor, body, (start, positions) =>
            editor.edits.setJoints(start, editor.state.get().page, [editor.state.get().step], positions),
        );
    }

    /** The scene in which the drag began: its edges stay during the drag. null: no drag. */
    get dragged(): CurveScene | null {
        return this.drag?.scene ?? null;
    }

    /** true: a drag of a way-point begins; capture the pointer. */
    down(drawing: CurveDrawing, spot: Spot, add: boolean): boolean {
        const { editor } = this.session;
        const point = nearestPoint(drawing, spot);
        if (!point) {
            const joint = jointAt(drawing, spot);
            if (joint !== null) editor.select({ joints: new Set(add ? [...editor.state.get().joints, joint] : [joint]) });
            return false;
        }
        editor.select({ step: point.step, steps: new Set([point.step]) });
        this.drag = {
            ...drawing,
            point,
            gesture: editor.gesture('drag'),
            start: { offsetX: spot.offsetX, offsetY: spot.offsetY, pointerType: spot.pointerType },
            axis: null,
        };
        return true;
    }

    move(spot: Spot): void {
        const { drag } = this;
        if (!drag) return;
        const [dx, dy] = [spot.offsetX - drag.start.offsetX, spot.offsetY - drag.start.offsetY];
        drag.axis ??= Math.hypot(dx, dy) < CLEAR_PX ? null : Math.abs(dx) > Math.abs(dy) ? 'time' : 'position';
        const { editor } = this.session;
        const { page } = editor.state.get();
        const { point, gesture, frame } = drag;
        if (drag.axis === 'position') {
            const position = Math.min(Math.max(Math.round(point.position + frame.position(dy) - frame.position(0)), 0), POSITION_MAX);
            gesture.change(editor.edits.setJoints(gesture.start, page, [point.step], new Map([[point.joint, position]])));
        } else if (drag.axis === 'time' && editor.page(page).schedule === 'time') {
            const begin = drag.scene.ends[point.step]?.move ?? 0;
            const seconds = Math.max(0, begin + frame.tick(dx) - frame.tick(0)) / TICKS_PER_SECOND;
            gesture.change(
                editor.edits.setTime(gesture.start, page, [point.step], nearestSetting(editor, page, point.step, 'time', seconds)),
            );
        }
    }

    /** Ends a drag. keep: false reverts it. Returns true if there was one. */
    up(keep: boolean): boolean {
        const { drag } = this;
        this.drag = null;
        if (keep) drag?.gesture.finish();
        else drag?.gesture.cancel();
        return drag !== null;
    }

    /** true: the key was handled. */
    key(event: KeyboardEvent): boolean {
        const side = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
        const turn = { ArrowUp: 1, ArrowDown: -1 }[event.key];
        if (event.key === 'Escape') this.escape();
        else if (turn !== undefined) this.turn(turn * (event.shiftKey ? COARSE_UNITS : 1));
        else if (side !== undefined && event.altKey) this.changeTime(side);
        else if (side !== undefined) this.chooseStep(side);
        else return false;
        return true;
    }

    keyUp(): void {
        this.arrows.end(true);
    }

    private escape(): void {
        this.up(false);
        this.arrows.end(false);
    }

    private turn(units: number): void {
        const { editor } = this.session;
        const { page, step, joints } = editor.state.get();
        if (joints.size > 0) this.arrows.turn(units, () => editor.poseAfter(page, step));
    }

    private chooseStep(by: number): void {
        const { editor } = this.session;
        const { page, step } = editor.state.get();
        const to = Math.max(0, Math.min(step + by, editor.page(page).steps.length - 1)); // also without steps
        editor.select({ step: to, steps: new Set([to]) });
    }

    private changeTime(by: number): void {
        const { editor } = this.session;
        const { page, step, document } = editor.state.get();
        if (editor.page(page).schedule !== 'time') return; // the byte is a speed
        const time = Math.min(Math.max((editor.page(page).steps[step]?.time ?? 0) + by, 0), BYTE_MAX);
        editor.dispatch(editor.edits.setTime(document, page, [step], time));
    }
}

/** Distance in pixels at which a pointer still hits. */
function reachPx(pointerType: string): number {
    return pointerType === 'touch' ? NEAR_PX.finger : NEAR_PX.mouse;
}

/** The nearest way-point within reach of the pointer. */
export function nearestPoint({ scene, frame }: CurveDrawing, { offsetX, offsetY, pointerType }: Spot): WayPoint | null {
    const distance = (point: WayPoint): number => Math.hypot(frame.x(point.tick) - offsetX, frame.y(point.position) - offsetY);
    const near = scene.wayPoints.filter(point => distance(point) < reachPx(pointerType)).sort((a, b) => distance(a) - distance(b));
    return near[0] ?? null;
}

/** The joint whose curve is nearest and within reach of the pointer. */
export function jointAt({ scene, frame }: CurveDrawing, { offsetX, offsetY, pointerType }: Spot): number | null {
    const tick = Math.min(Math.max(Math.round(frame.tick(offsetX)) - 1, 0), scene.curve.ticks - 1);
    const off = (joint: number): number => Math.abs(frame.y(scene.curve.goals[tick * JOINTS + joint] ?? 0) - offsetY);
    const [near] = [...scene.joints].sort((a, b) => off(a) - off(b));
    return near !== undefined && off(near) < reachPx(pointerType) ? near : null;
}
