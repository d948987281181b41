// SPDX-License-Identifier: MIT
// Where things stand in a page, its empty form, its checksum, its checks and its links: all of it from motion/*.c, through facts.ts
// and an instance of motion.wasm. Nothing of the format is written here.

import * as facts from './facts.ts';
import type { MotionDocument } from './document.ts';
import type { Schedule, Step } from './page.ts';
import type { Law, Lead, Motion, PageFault } from './motion.ts';

/** `at...` are byte offsets, in a step from its beginning. */
export const PAGE_LAYOUT = {
    pageBytes: facts.PAGE_BYTES,
    pageCount: facts.PAGE_COUNT,
    joints: facts.PAGE_JOINTS,
    stepsMax: facts.PAGE_STEPS,
    stepBytes: facts.PAGE_STEP_BYTES,
    nameBytes: facts.PAGE_NAME_BYTES,
    atName: facts.PAGE_AT_NAME,
    atPlayCount: facts.PAGE_AT_PLAY_COUNT,
    atSchedule: facts.PAGE_AT_SCHEDULE,
    atBlendRight: facts.PAGE_AT_BLEND_RIGHT,
    atBlendLeft: facts.PAGE_AT_BLEND_LEFT,
    atSteps: facts.PAGE_AT_STEPS,
    atPlayCode: facts.PAGE_AT_PLAY_CODE,
    atSpeed: facts.PAGE_AT_SPEED,
    atAccelTime: facts.PAGE_AT_ACCEL_TIME,
    atNext: facts.PAGE_AT_NEXT_PAGE,
    atExit: facts.PAGE_AT_EXIT_PAGE,
    atLinked1: facts.PAGE_AT_LINKED1_PAGE,
    atLinked1Code: facts.PAGE_AT_LINKED1_CODE,
    atLinked2: facts.PAGE_AT_LINKED2_PAGE,
    atLinked2Code: facts.PAGE_AT_LINKED2_CODE,
    atCompliance: facts.PAGE_AT_COMPLIANCE,
    atStep0: facts.PAGE_AT_STEP0,
    atStepPause: facts.PAGE_STEP_AT_PAUSE,
    atStepTime: facts.PAGE_STEP_AT_SPEED,
    scheduleSpeed: facts.PAGE_SCHEDULE_SPEED,
    scheduleTime: facts.PAGE_SCHEDULE_TIME,
    posMax: facts.PAGE_POS_MAX,
    posUnused: facts.PAGE_POS_UNUSED,
    posTorqueOff: facts.PAGE_POS_TORQUE_OFF,
} as const;

/** The page that the C functions work on when they are asked about bytes. Any but 0 does. */
const SCRATCH = 1;
const ERASED = 0xff;

export class PageFormat {
    readonly layout = PAGE_LAYOUT;
    /** The empty page, sealed. Not to be written. */
    readonly empty: Uint8Array;
    /** Flash that was never written. Not to be written. */
    readonly erased: Uint8Array;
    private readonly motion: Motion;
    /** The pages that the instance has. */
    private readonly loaded: (Uint8Array | null)[] = [];

    /** Takes an instance of motion.wasm for itself. */
    constructor(motion: Motion) {
        this.motion = motion;
        motion.clear(SCRATCH);
        this.empty = motion.page(SCRATCH);
        this.erased = new Uint8Array(this.layout.pageBytes).fill(ERASED);
    }

    /** A copy whose checksum is right. */
    sealed(bytes: Uint8Array): Uint8Array {
        this.take(bytes).seal(SCRATCH);
        return this.motion.page(SCRATCH);
    }

    /** The first thing that is wrong with a page, or null. Erased flash is a page without contents, not a damaged one. */
    fault(bytes: Uint8Array): PageFault | null {
        if (this.isErased(bytes)) return null;
        return this.take(bytes).check(SCRATCH);
    }

    /** Flash that was never written. */
    isErased(bytes: Uint8Array): boolean {
        return bytes.every(byte => byte === ERASED);
    }

    /** Nothing is lost when it is overwritten. */
    isEmpty(bytes: Uint8Array): boolean {
        return this.isErased(bytes) || bytes.every((byte, i) => byte === this.empty[i]);
    }

    /** The same bytes, or both nothing: erased flash and the empty page are the same to a robot. */
    isSame(a: Uint8Array, b: Uint8Array): boolean {
        return a === b || a.every((byte, i) => byte === b[i]) || (this.isEmpty(a) && this.isEmpty(b));
    }

    /** It has an action: steps, and a play count that is not 0. */
    isPlayable(bytes: Uint8Array): boolean {
        if (this.fault(bytes) !== null || this.isErased(bytes)) return false;
        return this.take(bytes).isPlayable(SCRATCH);
    }

    /** Ticks of 1/128 s of a step (0..6) and of the pause behind it. `from`: where the joints stand before the page (servo units). */
    stepTicks(bytes: Uint8Array, step: number, from: ArrayLike<number>, law: Law = 'exact'): { move: number; pause: number } {
        return this.take(bytes).stepTicks(SCRATCH, step, from, law);
    }

    /** The CRC-16 of a page, as the robot tells it. */
    crc(bytes: Uint8Array): number {
        return this.take(bytes).crc(SCRATCH);
    }

    /** A position (servo units) as the joint on the other side has it. */
    mirrored(position: number): number {
        return this.motion.mirrored(position);
    }

    /** The step half-way from one to the next, without a pause: a joint that one of them does not use stays unused. Its time is that share of
     *  the next one's, in time base, which keeps the rest. */
    between(a: Step, b: Step, schedule: Schedule): readonly [between: Step, next: Step] {
        const positions = a.positions.map((from, id) => {
            const to = b.positions[id] ?? null;
            return from === null || to === null ? null : this.motion.positionBetween(from, to);
        });
        if (schedule === 'speed') return [{ positions, time: b.time, pause: 0 }, b];
        const { share, rest } = this.motion.timeSplit(b.time);
        return [
            { positions, time: share, pause: 0 },
            { ...b, time: rest },
        ];
    }

    /** The code that buttons of a remote give together (their bits); 0: none. */
    remoteCode(buttons: number): number {
        return this.motion.remoteCode(buttons);
    }

    /** Where a page leads; nowhere when it is damaged or has no steps. */
    leads(bytes: Uint8Array): Lead[] {
        return this.take(bytes).leads(SCRATCH);
    }

    /** A page whose links follow pages that have moved (from -> to, 0: nothing is left there); the same object when nothing changes, as for
     *  a damaged page. */
    relinked(bytes: Uint8Array, moved: ReadonlyMap<number, number>): Uint8Array {
        this.take(bytes).relink(SCRATCH, moved);
        const after = this.motion.page(SCRATCH);
        return after.every((byte, i) => byte === bytes[i]) ? bytes : after;
    }

    /** Pages that a play of `first` can come to, itself too, in order. None for the trim. */
    reach(document: MotionDocument, first: number): number[] {
        return first === 0 ? [] : this.load(document).reach(first);
    }

    /** Pages that a code of the remote calls, and all that those lead to. */
    reachByCode(document: MotionDocument): ReadonlySet<number> {
        return new Set(this.load(document).reach(0));
    }

    /** Pages whose exit links go round. */
    exitCircles(document: MotionDocument): ReadonlySet<number> {
        const motion = this.load(document);
        return new Set(document.pages.flatMap((_, page) => (motion.exitsRound(page) ? [page] : [])));
    }

    /** The instance with these bytes in SCRATCH. */
    private take(bytes: Uint8Array): Motion {
        this.loaded[SCRATCH] = null;
        this.motion.setPage(SCRATCH, bytes);
        return this.motion;
    }

    /** The instance with all pages of a document. */
    private load(document: MotionDocument): Motion {
        for (const [page, bytes] of document.pages.entries()) {
            if (this.loaded[page] !== bytes) this.motion.setPage(page, bytes);
            this.loaded[page] = bytes;
        }
        return this.motion;
    }
}
