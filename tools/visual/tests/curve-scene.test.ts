// SPDX-License-Identifier: MIT
// What Curves draws of a shaped motion: the curve is the shaped one, the way-points stay on the stored values, which are edited.
import { expect, test } from 'vitest';
import { DocumentEditor } from '../app/editor.ts';
import { AS_STORED, JOINTS, TICKS_PER_SECOND } from '../model/motion.ts';
import type { Shape } from '../model/motion.ts';
import { CurveFrame, drawCurves } from '../view/editor/curve-picture.ts';
import { curveScene } from '../view/editor/curve-scene.ts';
import { BODY as body, libraryDocument, makeFormat, makeMotion } from './motion-bench.ts';

const { format } = await makeFormat();
const editor = new DocumentEditor(
    body,
    { format, player: await makeMotion(), document: await libraryDocument() },
    { changed: () => undefined, refused: () => undefined, opened: () => undefined },
);
const ELBOW = 5;
editor.select({ page: 3, joints: new Set([ELBOW]) }); // the wave

function sceneOf(shape: Partial<Shape>) {
    const scene = curveScene(editor, { shape: { ...AS_STORED, ...shape }, volts: 9.6, edges: null });
    if (!scene) throw new Error('the wave cannot be played');
    return scene;
}

test('as stored there is one curve, and it goes through its way-points', () => {
    const { stored, curve, wayPoints, ticks } = sceneOf({});
    expect(stored).toBeNull();
    expect(ticks).toBe(curve.ticks);
    expect(wayPoints.length).toBeGreaterThan(3);
    for (const { tick, position } of wayPoints) expect(curve.goals[(Math.round(tick) - 1) * JOINTS + ELBOW]).toBe(position);
});

test('at half the size the way-points stay on the stored curve, and the other one is half-way to the pose of page 1 (SHAPING.md)', () => {
    const { stored, curve, wayPoints } = sceneOf({ amplitude: 50 });
    const centre = editor.firstPose(1)[ELBOW] ?? 0;
    for (const { tick, position } of wayPoints) {
        const at = (Math.round(tick) - 1) * JOINTS + ELBOW;
        expect(stored?.goals[at]).toBe(position);
        expect(Math.abs((curve.goals[at] ?? 0) - (centre + (position - centre) / 2))).toBeLessThanOrEqual(0.5);
    }
});

test('at twice the speed the curve is half as long, and the way-points keep their times', () => {
    const { stored, curve, wayPoints, ticks } = sceneOf({ rate: 200 });
    expect(curve.ticks / (stored?.ticks ?? 1)).toBeCloseTo(0.5, 1);
    expect(ticks).toBe(stored?.ticks);
    expect(wayPoints).toEqual(sceneOf({}).wayPoints);
});

test('a drag keeps the edges that it began with; a page without action has no scene', () => {
    const edges = { low: 100, high: 900 };
    expect(curveScene(editor, { shape: AS_STORED, volts: 9.6, edges })).toMatchObject(edges);
    editor.select({ page: 100 });
    expect(curveScene(editor, { shape: AS_STORED, volts: 9.6, edges: null })).toBeNull();
});

test.each([1, 6, 28, 112])('the times of a motion of %i s do not run into each other, on a narrow screen either', seconds => {
    editor.select({ page: 3, joints: new Set([ELBOW]) });
    const scene = { ...sceneOf({}), followed: null, degrees: null, ticks: seconds * TICKS_PER_SECOND };
    const drawn: { readonly text: string; readonly x: number }[] = [];
    const fillText = (text: string, x: number): void => void drawn.push({ text, x });
    const measureText = (text: string) => ({ width: 7 * text.length });
    const context = new Proxy({ fillText, measureText } as unknown as CanvasRenderingContext2D, {
        get: (known, name) => Reflect.get(known, name) ?? (() => undefined),
    });
    const colours = { line: '', faint: '', fast: '', grid: '', text: '', ground: '', chosen: [''] };
    drawCurves(context, new CurveFrame(scene, 320, 200), scene, colours);
    const times = drawn.filter(({ text }) => text.endsWith(' s'));
    expect(times.length).toBeGreaterThan(2);
    for (const [i, { text, x }] of times.slice(0, -1).entries())
        expect(times[i + 1]?.x, text).toBeGreaterThanOrEqual(x + measureText(text).width);
});
