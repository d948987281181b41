// SPDX-License-Identifier: MIT
// Small pictures of a pose, drawn on a 2D canvas from the body's shapes: cheap enough for a row of steps or 128 pages, and without WebGL.
// The robot is seen from its front and slightly from its right, as in the room.

import { lowerFoot, trunkOn, ORIGIN } from '../../model/balance.ts';
import { angleIn, placeLinks } from '../../model/body.ts';
import type { Angles, Body, Shape } from '../../model/body.ts';
import { add, cross, length, rotate, scale, within } from '../../model/space.ts';
import type { Place, Vector } from '../../model/space.ts';

/** Visible metres above and below the floor. */
const SEEN = { above: 0.47, below: 0.035 };
const TO_CAMERA: Vector = unit([0.82, -0.5, 0.28]);
const RIGHT: Vector = unit(cross([0, 0, 1], TO_CAMERA));
const UP: Vector = cross(TO_CAMERA, RIGHT);
const LIGHT: Vector = unit([0.7, -0.25, 1]);
const SHADE = { dark: 0.5, bright: 0.62 };
const EDGES: readonly Vector[] = [
    [1, 0, 0],
    [-1, 0, 0],
    [0, 1, 0],
    [0, -1, 0],
    [0, 0, 1],
    [0, 0, -1],
];

function unit(v: Vector): Vector {
    return scale(v, 1 / length(v));
}

function dot(a: Vector, b: Vector): number {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

interface Painter {
    readonly context: CanvasRenderingContext2D;
    readonly at: (point: Vector) => readonly [number, number];
    readonly pixelsPerMetre: number;
}

function shaded(rgb: readonly number[], normal: Vector): string {
    const light = SHADE.dark + SHADE.bright * Math.max(0, dot(normal, LIGHT));
    const [r = 0, g = 0, b = 0] = rgb.map(value => Math.round(255 * Math.min(1, value ** 0.75 * light)));
    return `rgb(${r} ${g} ${b})`;
}

/** Draws the visible faces of a box. */
function box(painter: Painter, place: Place, half: Vector, rgb: readonly number[]): void {
    const { context, at } = painter;
    const axes = (
        [
            [1, 0, 0],
            [0, 1, 0],
            [0, 0, 1],
        ] as const
    ).map((axis, i) => scale(rotate(place.quat, axis), half[i] ?? 0));
    for (const face of EDGES) {
        const normal = rotate(place.quat, face);
        if (dot(normal, TO_CAMERA) <= 0) continue;
        const along = face.findIndex(value => value !== 0);
        const [u = ORIGIN.pos, v = ORIGIN.pos] = axes.filter((_, i) => i !== along);
        const middle = add(place.pos, scale(axes[along] ?? ORIGIN.pos, face[along] ?? 0));
        context.beginPath();
        for (const [a, b] of [
            [1, 1],
            [1, -1],
            [-1, -1],
            [-1, 1],
        ] as const)
            context.lineTo(...at(add(middle, add(scale(u, a), scale(v, b)))));
        context.closePath();
        context.fillStyle = context.strokeStyle = shaded(rgb, normal);
        context.fill();
        context.stroke(); // closes hairline gaps between faces
    }
}

function rod(painter: Painter, place: Place, radius: number, half: number, rgb: readonly number[], cap: CanvasLineCap): void {
    const { context, at, pixelsPerMetre } = painter;
    const axis = scale(rotate(place.quat, [0, 0, 1]), half);
    context.lineCap = cap;
    context.lineWidth = 2 * radius * pixelsPerMetre;
    context.strokeStyle = shaded(rgb, unit([0.6, -0.3, 0.5]));
    context.beginPath();
    context.moveTo(...at(add(place.pos, axis)));
    context.lineTo(...at(add(place.pos, scale(axis, -1))));
    context.stroke();
    context.lineWidth = 0.6;
}

function paint(painter: Painter, shape: Shape, place: Place, rgb: readonly number[]): void {
    const [a = 0, b = 0, c = 0] = shape.size;
    switch (shape.type) {
        case 'box':
            return box(painter, place, [a, b, c], rgb);
        case 'capsule':
            return rod(painter, place, a, b, rgb, 'round');
        case 'cylinder':
            return rod(painter, place, a, b, rgb, 'butt');
        case 'sphere':
            return rod(painter, place, a, 1e-5, rgb, 'round');
        default:
            return shape.type satisfies never;
    }
}

/** Draws the robot in this pose, standing on its lower foot, on a canvas of width x height (CSS pixels; the caller scales the context).
 *  Does not clear the canvas. */
export function drawPose(context: CanvasRenderingContext2D, body: Body, angles: Angles, width: number, height: number): void {
    const pixelsPerMetre = height / (SEEN.above + SEEN.below);
    const places = placeLinks(body, trunkOn(body, lowerFoot(body, angles), angles, ORIGIN), angleIn(angles));
    const trunk = places.get(body.links[0]?.name ?? '') ?? ORIGIN;
    const middle = dot(RIGHT, [trunk.pos[0], trunk.pos[1], 0]);
    const at = (point: Vector): readonly [number, number] => [
        width / 2 + (dot(point, RIGHT) - middle) * pixelsPerMetre,
        height - (SEEN.below + dot(point, UP) - dot([trunk.pos[0], trunk.pos[1], 0], UP)) * pixelsPerMetre,
    ];
    shadow(context, at([trunk.pos[0], trunk.pos[1], 0]), pixelsPerMetre);
    context.lineWidth = 0.6;
    const seen = body.shapes.flatMap(shape => {
        const link = places.get(shape.body);
        return link ? [{ shape, place: within(link, shape) }] : [];
    });
    seen.sort((a, b) => dot(a.place.pos, TO_CAMERA) - dot(b.place.pos, TO_CAMERA));
    for (const { shape, place } of seen) paint({ context, at, pixelsPerMetre }, shape, place, body.materials[shape.material] ?? [1, 1, 1]);
}

function shadow(context: CanvasRenderingContext2D, [x, y]: readonly [number, number], pixelsPerMetre: number): void {
    context.fillStyle = 'rgb(0 0 0 / 0.14)';
    context.beginPath();
    context.ellipse(x, y, 0.12 * pixelsPerMetre, 0.038 * pixelsPerMetre, 0, 0, 2 * Math.PI);
    context.fill();
}

/** Sizes the canvas for the screen's pixel ratio (at most 2), which empties it. Returns what draws on it in CSS pixels. */
export function sized(canvas: HTMLCanvasElement, width: number, height: number): CanvasRenderingContext2D | null {
    const sharpness = Math.min(window.devicePixelRatio, 2);
    canvas.width = Math.round(width * sharpness);
    canvas.height = Math.round(height * sharpness);
    const context = canvas.getContext('2d');
    context?.scale(sharpness, sharpness);
    return context;
}

/** Draws the picture anew. */
export function showPose(canvas: HTMLCanvasElement, body: Body, angles: Angles, width: number, height: number): void {
    const context = sized(canvas, width, height);
    if (context) drawPose(context, body, angles, width, height);
}
