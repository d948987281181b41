// SPDX-License-Identifier: MIT
// Collects what to draw of a page's curves: sent and stored curves, way-points, and spans that are too fast.

import { tooFast } from '../../model/curve-speed.ts';
import { AS_STORED, JOINTS, POSITION_MAX, TICKS_PER_SECOND } from '../../model/motion.ts';
import type { Curve, Shape } from '../../model/motion.ts';
import { pageOf } from '../../model/document.ts';
import type { Editor } from '../session/editor.ts';
import type { CurveScene, WayPoint } from './curve-picture.ts';
import { stepTimes } from './step-times.ts';

const SPAN = { margin: 24, least: 120 };

export interface SceneOptions {
    readonly shape: Shape;
    readonly volts: number;
    /** Edges to keep during a drag, so that the picture does not move under the mouse. */
    readonly edges: Pick<CurveScene, 'low' | 'high'> | null;
}

function isShaped(shape: Shape): boolean {
    return (Object.keys(AS_STORED) as (keyof Shape)[]).some(name => shape[name] !== AS_STORED[name]);
}

/** Way-points and step times are as stored, without the shape. null: the page cannot be played. */
export function curveScene(editor: Editor, { shape, volts, edges }: SceneOptions): Omit<CurveScene, 'followed' | 'degrees'> | null {
    const { page, step, joints: chosen, document } = editor.state.get();
    const { steps } = editor.page(page);
    if (!editor.format.isPlayable(pageOf(document, page))) return null;
    const ends = stepTimes(editor, page).map(({ move, pause }) => ({ move: move * TICKS_PER_SECOND, pause: pause * TICKS_PER_SECOND }));
    const all = ends.reduce((sum, { move, pause }) => sum + move + pause, 0);
    const curveOf = (as: Shape): Curve | null => editor.curve(page, { ticks: Math.max(1, Math.ceil((all * 100) / as.rate)), shape: as });
    const curve = curveOf(shape);
    if (!curve) return null;
    const stored = isShaped(shape) ? curveOf(AS_STORED) : null;
    const joints = Array.from({ length: JOINTS }, (_, id) => id).filter(id => steps.some(({ positions }) => positions[id] !== null));
    const limit = editor.topSpeed(volts);
    const fast = new Map(joints.map(joint => [joint, tooFast(curve, joint, limit)] as const).filter(([, spans]) => spans.length > 0));
    const shown = joints.filter(joint => chosen.has(joint));
    const wayPoints = shown.flatMap(joint => wayPointsOf(editor, page, joint, ends));
    const { low, high } = edges ?? edgesOf(stored ? [curve, stored] : [curve], shown.length > 0 ? shown : joints);
    return {
        curve,
        stored,
        ticks: Math.max(curve.ticks, all),
        joints,
        chosen: new Set(shown),
        fast,
        wayPoints,
        ends,
        cursor: step,
        low,
        high,
    };
}

function wayPointsOf(editor: Editor, page: number, joint: number, ends: CurveScene['ends']): WayPoint[] {
    let tick = 0;
    return editor.page(page).steps.flatMap(({ positions }, step) => {
        const { move = 0, pause = 0 } = ends[step] ?? {};
        tick += move;
        const point = { joint, step, tick, position: positions[joint] ?? 0 };
        tick += pause;
        return positions[joint] === null ? [] : [point];
    });
}

function edgesOf(curves: readonly Curve[], joints: readonly number[]): { low: number; high: number } {
    let [low, high] = [POSITION_MAX, 0];
    for (const { ticks, goals } of curves) {
        for (let tick = 0; tick < ticks; tick++) {
            for (const joint of joints) {
                const goal = goals[tick * JOINTS + joint] ?? 0;
                if (goal < low) low = goal;
                if (goal > high) high = goal;
            }
        }
    }
    const half = Math.max(SPAN.least, high - low + 2 * SPAN.margin) / 2;
    const middle = (low + high) / 2;
    return { low: middle - half, high: middle + half };
}
