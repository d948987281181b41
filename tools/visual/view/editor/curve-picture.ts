// SPDX-License-Identifier: MIT
// Draws curves on a canvas: time to the right, servo units upwards. Chosen joints are bold with way-points, the others faint; spans that
// are too fast are red and dashed. Independent of the document.

import { JOINTS, TICKS_PER_SECOND } from '../../model/motion.ts';
import type { Curve } from '../../model/motion.ts';
import type { TickSpan } from '../../model/curve-speed.ts';

export interface WayPoint {
    readonly joint: number;
    readonly step: number;
    /** Ticks from the page's beginning. */
    readonly tick: number;
    readonly position: number;
}

export interface CurveScene {
    /** The curve that is sent to the servos, with the shape applied. */
    readonly curve: Curve;
    /** The stored curve; null: the shape does not change it. */
    readonly stored: Curve | null;
    /** Servo positions in physics, JOINTS servo units per tick; null: unknown. */
    readonly followed: Float32Array | null;
    /** Converts positions of the chosen joints to degrees; null: their scales differ. */
    readonly degrees: ((position: number) => number) | null;
    readonly ticks: number;
    readonly joints: readonly number[];
    readonly chosen: ReadonlySet<number>;
    readonly fast: ReadonlyMap<number, readonly TickSpan[]>;
    readonly wayPoints: readonly WayPoint[];
    /** Duration of each step's movement and pause, in ticks. */
    readonly ends: readonly { readonly move: number; readonly pause: number }[];
    readonly cursor: number;
    /** Servo units at the lower and upper edge. */
    readonly low: number;
    readonly high: number;
}

export interface CurveColours {
    readonly line: string;
    readonly faint: string;
    readonly fast: string;
    readonly grid: string;
    readonly text: string;
    readonly ground: string;
    readonly chosen: readonly string[];
}

const POINT = 6; // pixels
const SECOND_TEXT = 40; // pixels of a time and the gap beside it
/** Seconds between two times on the axis. */
const SECONDS = [0.5, 1, 2, 5, 10, 20];
const EDGE = { left: 34, right: 40, top: 8, bottom: 18 };

/** Converts between ticks, positions and CSS pixels. */
export class CurveFrame {
    readonly width: number;
    readonly height: number;
    private readonly scene: Pick<CurveScene, 'ticks' | 'low' | 'high'>;

    constructor(scene: Pick<CurveScene, 'ticks' | 'low' | 'high'>, width: number, height: number) {
        this.scene = scene;
        this.width = width;
        this.height = height;
    }

    x(tick: number): number {
        return EDGE.left + (tick / Math.max(1, this.scene.ticks)) * (this.width - EDGE.left - EDGE.right);
    }

    y(position: number): number {
        const { low, high } = this.scene;
        return this.height - EDGE.bottom - ((position - low) / (high - low)) * (this.height - EDGE.top - EDGE.bottom);
    }

    tick(x: number): number {
        return ((x - EDGE.left) / (this.width - EDGE.left - EDGE.right)) * this.scene.ticks;
    }

    position(y: number): number {
        const { low, high } = this.scene;
        return low + ((this.height - EDGE.bottom - y) / (this.height - EDGE.top - EDGE.bottom)) * (high - low);
    }
}

export function drawCurves(context: CanvasRenderingContext2D, frame: CurveFrame, scene: CurveScene, colours: CurveColours): void {
    context.clearRect(0, 0, frame.width, frame.height);
    drawGrid(context, frame, scene, colours);
    context.save();
    context.beginPath();
    context.rect(EDGE.left - POINT, EDGE.top, frame.width - EDGE.left - EDGE.right + 2 * POINT, frame.height - EDGE.top - EDGE.bottom);
    context.clip();
    for (const joint of scene.joints) if (!scene.chosen.has(joint)) drawJoint(context, frame, scene.curve, joint, colours.faint, 1);
    for (const [i, joint] of [...scene.chosen].entries()) drawChosen(context, frame, scene, joint, chosenColour(colours, i));
    for (const joint of scene.joints) drawFast(context, frame, scene, joint, colours);
    context.restore();
    drawWayPoints(context, frame, scene, colours);
}

/** Stored curve dotted, sent curve bold, servo position thin. */
function drawChosen(
    context: CanvasRenderingContext2D,
    frame: CurveFrame,
    { curve, stored, followed }: CurveScene,
    joint: number,
    colour: string,
): void {
    context.setLineDash([2, 4]);
    if (stored) drawJoint(context, frame, stored, joint, colour, 1.5);
    context.setLineDash([]);
    drawJoint(context, frame, curve, joint, colour, 2);
    if (followed) drawJoint(context, frame, { ticks: Math.floor(followed.length / JOINTS), goals: followed }, joint, colour, 1);
}

function chosenColour(colours: CurveColours, index: number): string {
    return colours.chosen[index % colours.chosen.length] ?? colours.line;
}

function drawGrid(
    context: CanvasRenderingContext2D,
    frame: CurveFrame,
    { ticks, ends, cursor, low, high, degrees, chosen }: CurveScene,
    colours: CurveColours,
): void {
    context.font = '12px system-ui, sans-serif';
    context.lineWidth = 1;
    let begin = 0;
    for (const [step, { move, pause }] of ends.entries()) {
        if (step === cursor) {
            context.fillStyle = colours.ground;
            context.fillRect(
                frame.x(begin),
                EDGE.top,
                frame.x(begin + move + pause) - frame.x(begin),
                frame.height - EDGE.top - EDGE.bottom,
            );
        }
        begin += move + pause;
        context.strokeStyle = colours.grid;
        vertical(context, frame, begin);
        context.fillStyle = colours.text;
        if (chosen.size === 0) context.fillText(String(step + 1), frame.x(begin - move - pause) + 4, EDGE.top + 10); // else at way-points
    }
    const every = high - low > 500 ? 200 : high - low > 200 ? 100 : 50;
    for (let position = Math.ceil(low / every) * every; position <= high; position += every) {
        context.strokeStyle = colours.grid;
        line(context, [
            [EDGE.left, frame.y(position)],
            [frame.width - EDGE.right, frame.y(position)],
        ]);
        context.fillText(String(position), 4, frame.y(position) + 4);
        if (degrees) context.fillText(`${Math.round(degrees(position))}°`, frame.width - EDGE.right + 8, frame.y(position) + 4);
    }
    const seconds = ticks / TICKS_PER_SECOND;
    const room = (frame.x(ticks) - frame.x(0)) / seconds;
    const between = SECONDS.find(some => some * room >= SECOND_TEXT) ?? Infinity;
    for (let second = 0; second <= seconds; second += between) secondText(context, frame, second);
}

/** Below the axis, never cut off by the edge. */
function secondText(context: CanvasRenderingContext2D, frame: CurveFrame, second: number): void {
    const text = `${second} s`;
    const x = frame.x(second * TICKS_PER_SECOND) - 6;
    context.fillText(text, Math.min(x, frame.width - context.measureText(text).width - 2), frame.height - 4);
}

function vertical(context: CanvasRenderingContext2D, frame: CurveFrame, tick: number): void {
    line(context, [
        [frame.x(tick), EDGE.top],
        [frame.x(tick), frame.height - EDGE.bottom],
    ]);
}

function line(context: CanvasRenderingContext2D, points: readonly (readonly [number, number])[]): void {
    context.beginPath();
    for (const [x, y] of points) context.lineTo(x, y);
    context.stroke();
}

/** Servo units of all joints, tick by tick. */
interface Way {
    readonly ticks: number;
    readonly goals: ArrayLike<number>;
}

/** Draws at most about one point per pixel. */
function trace(context: CanvasRenderingContext2D, frame: CurveFrame, { ticks, goals }: Way, joint: number, from: number, to: number): void {
    const stride = Math.max(1, Math.floor(ticks / frame.width));
    context.beginPath();
    for (let tick = from; tick < to; tick += stride) context.lineTo(frame.x(tick + 1), frame.y(goals[tick * JOINTS + joint] ?? 0));
    context.lineTo(frame.x(to), frame.y(goals[(to - 1) * JOINTS + joint] ?? 0));
    context.stroke();
}

function drawJoint(context: CanvasRenderingContext2D, frame: CurveFrame, way: Way, joint: number, colour: string, width: number): void {
    context.strokeStyle = colour;
    context.lineWidth = width;
    trace(context, frame, way, joint, 0, way.ticks);
}

function drawFast(context: CanvasRenderingContext2D, frame: CurveFrame, scene: CurveScene, joint: number, colours: CurveColours): void {
    context.strokeStyle = colours.fast;
    context.lineWidth = 3;
    context.setLineDash([5, 3]);
    for (const [from, to] of scene.fast.get(joint) ?? []) trace(context, frame, scene.curve, joint, from, to);
    context.setLineDash([]);
}

function drawWayPoints(context: CanvasRenderingContext2D, frame: CurveFrame, scene: CurveScene, colours: CurveColours): void {
    const order = [...scene.chosen];
    for (const point of scene.wayPoints) {
        context.beginPath();
        context.arc(frame.x(point.tick), frame.y(point.position), point.step === scene.cursor ? POINT : 4.5, 0, 2 * Math.PI);
        context.fillStyle = chosenColour(colours, order.indexOf(point.joint));
        context.fill();
        context.strokeStyle = colours.ground;
        context.lineWidth = 1.5;
        context.stroke();
        context.fillText(String(point.step + 1), frame.x(point.tick) + POINT + 1, frame.y(point.position) - POINT);
    }
}
