// SPDX-License-Identifier: MIT
// Pictures of two versions of a page: poses of the new one, with the old ones as ghosts behind them.

import { anglesOf } from '../../model/body.ts';
import type { Body } from '../../model/body.ts';
import type { PageView, Step } from '../../model/page.ts';
import { make } from '../element.ts';
import { drawPose, sized } from './pose-picture.ts';

const SIZE = { width: 46, height: 54 };
const GHOST = 0.28;

function isSamePose(a: Step, b: Step): boolean {
    return a.positions.every((position, id) => position === b.positions[id]);
}

function picture(body: Body, before: Step | undefined, after: Step | undefined): HTMLCanvasElement {
    const canvas = make('canvas', { 'aria-hidden': 'true', class: after ? '' : 'gone' });
    const context = sized(canvas, SIZE.width, SIZE.height);
    if (!context) return canvas;
    const draw = (step: Step, alpha: number): void => {
        context.globalAlpha = alpha;
        drawPose(context, body, anglesOf(body, step.positions, new Map()), SIZE.width, SIZE.height);
    };
    if (before) draw(before, GHOST);
    if (after) draw(after, 1);
    return canvas;
}

/** One picture per step whose pose differs; if none does, one of the first step. */
export function ghosts(body: Body, before: PageView, after: PageView): HTMLElement {
    const count = Math.max(before.steps.length, after.steps.length);
    const steps = Array.from({ length: count }, (_, k) => [before.steps[k], after.steps[k]] as const);
    const different = steps.filter(([a, b]) => !a || !b || !isSamePose(a, b));
    return make(
        'span',
        { class: 'ghosts' },
        ...(different.length > 0 ? different : steps.slice(0, 1)).map(([a, b]) => picture(body, a, b)),
    );
}
