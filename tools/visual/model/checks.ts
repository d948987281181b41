// SPDX-License-Identifier: MIT
// Checks of the page beyond those of m512: movement too fast for the servos, joints beyond their limits, poses that tip over, exit links in
// a circle. Each finding names the page, step and joint. Pure.

import { fastSteps } from './curve-speed.ts';
import { centreOfMass, lowerFoot, marginInside, supportPolygon, trunkOn, ORIGIN } from './balance.ts';
import { angleIn, anglesOf, jointAngle, placeLinks } from './body.ts';
import type { Body } from './body.ts';
import { pageOf } from './document.ts';
import type { MotionDocument } from './document.ts';
import { linkGraph } from './links.ts';
import type { Curve, PageFault } from './motion.ts';
import type { PageFormat } from './page-format.ts';
import { readPage } from './page.ts';
import type { Step } from './page.ts';
import { rotate } from './space.ts';

export type CheckKind = 'damaged' | 'too-fast' | 'out-of-reach' | 'tips-over' | 'exit-circle';

export interface PageFinding {
    readonly kind: CheckKind;
    readonly page: number;
    /** 0..6; null: the page as a whole. */
    readonly step: number | null;
    /** Servo ID; null: none in particular. */
    readonly joint: number | null;
    /** too-fast: multiple of the top speed; tips-over: metres outside the soles; else 0. */
    readonly amount: number;
    readonly fault: PageFault | null;
    /** The motion before it, without which there is no such finding; null: it is the motion's own. */
    readonly after: number | null;
}

/** Tolerance for rounding beyond the body's joint limits. Radians. */
const REACH_SLACK = 0.01;
/** Distance outside the soles from which a finding is made. Metres. */
const TIPS_M = 0.005;
/** A robot whose trunk leans more than 60 degrees is not meant to stand. Cosine. */
const UPRIGHT = 0.5;
/** A pause up to this length is part of a movement: 0.2 s, for the servos to arrive. */
const HELD_TICKS = 26;

export interface CheckOptions {
    readonly format: PageFormat;
    readonly body: Body;
    /** Highest speed to ask of a servo, in servo units per tick (Motion.topSpeed). */
    readonly topSpeed: number;
    /** The curve that the player makes of one page; null: none. */
    readonly curve: (page: number) => Curve | null;
}

function finding(kind: CheckKind, page: number, more: Partial<PageFinding> = {}): PageFinding {
    return { kind, page, step: null, joint: null, amount: 0, fault: null, after: null, ...more };
}

/** All findings of one page and of the way into its next page. They depend on the pages that it can reach. */
export function checkPage(document: MotionDocument, page: number, { format, body, topSpeed, curve }: CheckOptions): PageFinding[] {
    const bytes = pageOf(document, page);
    const fault = format.fault(bytes);
    if (fault !== null) return [finding('damaged', page, { fault })];
    if (page === 0 || !format.isPlayable(bytes)) return [];
    const played = curve(page);
    const { steps, next } = readPage(format, bytes);
    // Where step 1 of the next page begins is known here only.
    const fast = played ? fastSteps(played, topSpeed).filter(one => one.page === page || (one.page === next && one.step === 0)) : [];
    return [
        ...fast.map(one =>
            finding('too-fast', one.page, { step: one.step, joint: one.joint, amount: one.times, after: one.page === page ? null : page }),
        ),
        ...steps.flatMap((step, index) => checkReach(body, page, index, step)),
        ...checkBalance(body, page, steps, next === 0),
    ];
}

function checkReach(body: Body, page: number, index: number, step: Step): PageFinding[] {
    return body.joints.flatMap(joint => {
        const position = step.positions[joint.servo] ?? null;
        const angle = position === null ? 0 : jointAngle(joint, position);
        return angle < joint.low - REACH_SLACK || angle > joint.high + REACH_SLACK
            ? [finding('out-of-reach', page, { step: index, joint: joint.servo })]
            : [];
    });
}

/** Reports only the worst pose that the page holds; one finding is enough. Other poses are passed without a stop, as in a walk, and the
 *  swing may bring the robot back. Only physics can judge those. */
function checkBalance(body: Body, page: number, steps: readonly Step[], isEnd: boolean): PageFinding[] {
    const isHeld = (step: Step, index: number): boolean => step.pause > HELD_TICKS || (isEnd && index === steps.length - 1);
    const out = steps.map((step, index) => (isHeld(step, index) ? tipsOver(body, step) : 0));
    const worst = Math.max(0, ...out);
    return worst > TIPS_M ? [finding('tips-over', page, { step: out.indexOf(worst), amount: worst })] : [];
}

/** Metres by which the centre of mass lies outside the soles while the pose is held. 0 if the robot stands, lies, leans on its hands or
 *  does not use its legs. */
function tipsOver(body: Body, step: Step): number {
    if (body.joints.some(joint => joint.name.includes('hip') && (step.positions[joint.servo] ?? null) === null)) return 0;
    const angles = anglesOf(body, step.positions, new Map());
    const trunk = trunkOn(body, lowerFoot(body, angles), angles, ORIGIN);
    if (rotate(trunk.quat, [0, 0, 1])[2] < UPRIGHT) return 0;
    const places = placeLinks(body, trunk, angleIn(angles));
    const [x, y] = centreOfMass(body, places);
    const margin = marginInside(supportPolygon(body, places), [x, y]);
    return margin < 0 && Number.isFinite(margin) ? -margin : 0;
}

/** The findings of checkPage() of a document's pages. Only pages are checked again that have changed or that reach a changed one. */
export class PageChecks {
    private readonly known = new Map<number, { readonly reached: readonly Uint8Array[]; readonly found: readonly PageFinding[] }>();

    look(document: MotionDocument, options: CheckOptions): PageFinding[] {
        const worst = new Map<string, PageFinding>();
        for (const page of document.pages.keys()) {
            const reached = [page, ...options.format.reach(document, page)].map(one => pageOf(document, one));
            const before = this.known.get(page);
            const isSame = before?.reached.length === reached.length && reached.every((bytes, i) => bytes === before.reached[i]);
            const found = before && isSame ? before.found : checkPage(document, page, options);
            this.known.set(page, { reached, found });
            for (const one of found) {
                // Several motions may lead too fast into the same step.
                const key = one.kind === 'too-fast' ? `${one.page} ${one.step}` : `${one.kind} ${one.page} ${one.step} ${one.joint}`;
                if (one.amount >= (worst.get(key)?.amount ?? 0)) worst.set(key, one);
            }
        }
        return [...worst.values()];
    }
}

/** Findings on the links of all pages. m512 reports links that lead nowhere. */
export function checkLinks(format: PageFormat, document: MotionDocument): PageFinding[] {
    return linkGraph(format, document).nodes.flatMap(({ page, exitsRound }) => (exitsRound ? [finding('exit-circle', page)] : []));
}
