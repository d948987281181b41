// SPDX-License-Identifier: MIT
// Draws the robot as a few strokes, seen from the front left and slightly above. Far limbs come first, near ones last.

import { rotate } from '../model/space.ts';
import type { Place, Vector } from '../model/space.ts';

export interface Stroke {
    readonly link: string;
    /** Metres, in the frame of the link. */
    readonly points: readonly Vector[];
    readonly widthM: number;
    readonly colour: string;
    readonly isRound?: boolean;
}

const DARK = '#2b3036';
const GREY = '#c2c7cc';
const BLUE = '#2a6aad';
const SOLE = '#1a1a1c';
const EYES = '#fac833';

/** A vertical stroke between two heights of a link. */
function bar(link: string, from: number, to: number, widthM: number, colour: string, x = 0): Stroke {
    const points = [from, to].map((z): Vector => [x, 0, z]);
    return { link, points, widthM, colour };
}

function limbs(side: 'right' | 'left'): Stroke[] {
    const out = side === 'right' ? -1 : 1;
    const sole = [0.042, -0.058].flatMap((x, i): Vector[] => [0.03, -0.03].map(y => [x, i === 0 ? y : -y, -0.028]));
    return [
        { link: `${side}_shoulder`, points: [0, 0.036].map((y): Vector => [0, out * y, -0.006]), widthM: 0.03, colour: GREY },
        bar(`${side}_upper_arm`, 0.016, -0.066, 0.034, DARK),
        { ...bar(`${side}_forearm`, -0.05, -0.096, 0.026, BLUE), isRound: true },
        bar(`${side}_forearm`, 0.012, -0.04, 0.034, DARK),
        { link: `${side}_foot`, points: sole, widthM: 0.008, colour: SOLE },
        bar(`${side}_foot`, -0.024, 0.01, 0.042, DARK),
        bar(`${side}_shank`, -0.075, -0.016, 0.034, GREY, 0.009),
        bar(`${side}_shank`, -0.042, 0.016, 0.036, DARK, 0.003),
        bar(`${side}_thigh`, -0.062, -0.006, 0.036, GREY, -0.008),
        bar(`${side}_hip_yaw`, 0.008, -0.05, 0.036, GREY),
        bar(`${side}_hip`, -0.02, 0.026, 0.04, DARK),
    ];
}

/** From far to near, as seen from the front left. */
export const STROKES: readonly Stroke[] = [
    ...limbs('right'),
    bar('trunk', -0.072, -0.05, 0.1, GREY),
    bar('trunk', -0.06, 0.016, 0.094, BLUE, -0.01),
    bar('neck', -0.01, 0.03, 0.024, GREY),
    bar('head', 0.002, 0.04, 0.058, BLUE),
    { link: 'head', points: [-0.014, 0.014].map((y): Vector => [0.024, y, 0.024]), widthM: 0.007, colour: EYES, isRound: true },
    ...limbs('left'),
];

/** The points of all strokes in a picture of VIEW pixels, x and y in turn. */
export type Outline = readonly (readonly number[])[];

export const VIEW = 320;
const PIXELS_PER_M = 720;
const TURN_RAD = -0.61;
const ABOVE_RAD = 0.2;
const GROUND_Y = 288;

export function strokePixels(widthM: number): number {
    return Math.round(widthM * PIXELS_PER_M);
}

/** The picture is centred on the robot. */
export function outline(places: ReadonlyMap<string, Place>): Outline {
    const all = [...places.values()].map(({ pos }) => pos);
    const middle = (axis: 0 | 1): number => all.reduce((sum, pos) => sum + pos[axis], 0) / all.length;
    const [aheadM, leftM] = [middle(0), middle(1)];
    return STROKES.map(({ link, points }) => {
        const place = places.get(link);
        if (!place) throw new Error(`start page: the body has no link "${link}"`);
        return points.flatMap(point => {
            const [x, y, z] = rotate(place.quat, point);
            return pixels([place.pos[0] + x - aheadM, place.pos[1] + y - leftM, place.pos[2] + z]);
        });
    });
}

function pixels([x, y, z]: Vector): [number, number] {
    const across = y * Math.cos(TURN_RAD) + x * Math.sin(TURN_RAD);
    const near = x * Math.cos(TURN_RAD) - y * Math.sin(TURN_RAD);
    return [
        Math.round(VIEW / 2 + across * PIXELS_PER_M),
        Math.round(GROUND_Y - (z * Math.cos(ABOVE_RAD) - near * Math.sin(ABOVE_RAD)) * PIXELS_PER_M),
    ];
}
