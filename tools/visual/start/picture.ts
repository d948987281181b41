// SPDX-License-Identifier: MIT
// A motion as a small animated picture (SVG), or as a still one for people who prefer reduced motion.

import { STROKES, VIEW, strokePixels } from './outline.ts';
import type { Outline } from './outline.ts';

const FRAMES_PER_SECOND = 12.8;
/** The last pose stays this long before the loop restarts. */
const REST_FRAMES = 8;

export function picture(frames: readonly Outline[], moves: boolean): string {
    const still = frames[Math.floor(frames.length * 0.45)] ?? [];
    const all = [...frames, ...Array<Outline>(REST_FRAMES).fill(frames.at(-1) ?? [])];
    const seconds = (all.length / FRAMES_PER_SECOND).toFixed(2);
    const strokes = STROKES.map(({ widthM, colour, isRound = false, points }, i) => {
        const at = (frame: Outline): string => (frame[i] ?? []).join(' ');
        const isMoving = moves && all.some(frame => at(frame) !== at(all[0] ?? []));
        const motion = isMoving
            ? `<animate attributeName="points" dur="${seconds}s" repeatCount="indefinite" values="${all.map(at).join(';')}"/>`
            : '';
        const isFilled = points.length > 2;
        const kind = `stroke="${colour}" stroke-width="${strokePixels(widthM)}" fill="${isFilled ? colour : 'none'}"`;
        return `<polyline points="${at(moves ? (all[0] ?? []) : still)}" ${kind}${isRound ? ' stroke-linecap="round"' : ''}>${motion}</polyline>`;
    });
    return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="-12 -24 ${VIEW + 24} ${VIEW + 24}"><ellipse cx="${VIEW / 2}" cy="290" rx="86" ry="18" fill="#0003"/><g stroke-linejoin="round">${strokes.join('')}</g></svg>\n`;
}
