// SPDX-License-Identifier: MIT
// Page layout, empty page, checksum, checks and links. All of it comes from motion/*.c through facts.ts and an instance of motion.wasm;
// none of the format is repeated here.

import * as facts from './facts.ts';
import type { MotionDocument } from './document.ts';
import type { Schedule, Step } from './page.ts';
import type { Law, Lead, Motion, PageFault } from './motion.ts';

/** `at...` are byte offsets; in a step, from the step's start. */
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

/** The page number that the C functions use to examine given bytes. Any but 0 works. */
const SCRATCH = 1;
const ERASED = 0xff;

export class PageFormat {
    readonly layout = PAGE_LAYOUT;
    /** The empty page, sealed. Must not be modified. */
    readonly empty: Uint8Array;
    /** Flash that was never written. Must not be modified. */
    readonly erased: Uint8Array;
    private readonly motion: Motion;
    /** The pages that are loaded in the instance. */
    private readonly loaded: (Uint8Array | null)[] = [];

    /** Takes over an instance of motion.wasm. */
    constructor(motion: Motion) {
        this.motion = motion;
        motion.clear(SCRATCH);
        this.empty = motion.page(SCRATCH);
        this.erased = new Uint8Array(this.layout.pageBytes).fill(ERASED);
    }

    /** A copy with a correct checksum. */
    sealed(bytes: Uint8Array): Uint8Array {
        this.take(bytes).seal(SCRATCH);
        return this.motion.page(SCRATCH);
    }

    /** The first fault of a page, or null. Erased flash is an empty page, not a damaged one. */
    fault(bytes: Uint8Array): PageFault | null {
        if (this.isErased(bytes)) return null;
        return this.take(bytes).check(SCRATCH);
    }

    isErased(bytes: Uint8Array): boolean {
        return bytes.every(byte => byte === ERASED);
    }

    /** Overwriting it loses nothing. */
    isEmpty(bytes: Uint8Array): boolean {
        return this.isErased(bytes) || bytes.every((byte, i) => byte === this.empty[i]);
    }

    /** The bytes are the same, or both pages are empty: erased flash and the empty page mean the same to a robot. */
    isSame(a: Uint8Array, b: Uint8Array): boolean {
        return a === b || a.every((byte, i) => byte === b[i]) || (this.isEmpty(a) && this.isEmpty(b));
    }

    /** As a robot is to have it. Edit seals what it saves, and sealed erased flash is a damaged page, so the empty page goes there instead. */
    forRobot(bytes: Uint8Array): Uint8Array {
        return this.isErased(bytes) ? this.empty : bytes;
    }

    /** It has an action: steps and a play count other than 0. */
    isPlayable(bytes: Uint8Array): boolean {
        if (this.fault(bytes) !== null || this.isErased(bytes)) return false;
        return this.take(bytes).isPlayable(SCRATCH);
    }

    /** Ticks (1/128 s) of a step (0..6) and of the pause after it. `from`: the joints before the page (servo units). */
    stepTicks(bytes: Uint8Array, step: number, from: ArrayLike<number>, law: Law = 'exact'): { move: number; pause: number } {
        return this.take(bytes).stepTicks(SCRATCH, step, from, law);
    }

    /** The CRC-16 of a page, as the robot reports it. */
    crc(bytes: Uint8Array): number {
        return this.take(bytes).crc(SCRATCH);
    }

    /** A position (servo units) mirrored to the joint on the other side. */
    mirrored(position: number): number {
        return this.motion.mirrored(position);
    }

    /** A step half-way between two, without a pause. A joint that either step does not use stays unused. In schedule 'time' the next step's
     *  time is split between them. */
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

    /** The code of remote buttons pressed together (bits); 0: none. */
    remoteCode(buttons: number): number {
        return this.motion.remoteCode(buttons);
    }

    /** Where a page leads. Empty if it is damaged or has no steps. */
    leads(bytes: Uint8Array): Lead[] {
        return this.take(bytes).leads(SCRATCH);
    }

    /** The page with its links updated after pages have moved (from -> to, 0: nothing is left there). Returns the same object if nothing
     *  changes, as with a damaged page. */
    relinked(bytes: Uint8Array, moved: ReadonlyMap<number, number>): Uint8Array {
        this.take(bytes).relink(SCRATCH, moved);
        const after = this.motion.page(SCRATCH);
        return after.every((byte, i) => byte === bytes[i]) ? bytes : after;
    }

    /** Pages that a play of `first` can reach, including itself, in order. None for the trim. */
    reach(document: MotionDocument, first: number): number[] {
        return first === 0 ? [] : this.load(document).reach(first);
    }

    /** Pages that a remote code calls, and all pages that those reach. */
    reachByCode(document: MotionDocument): ReadonlySet<number> {
        return new Set(this.load(document).reach(0));
    }

    /** Pages whose exit links form a circle. */
    exitCircles(document: MotionDocument): ReadonlySet<number> {
        const motion = this.load(document);
        return new Set(document.pages.flatMap((_, page) => (motion.exitsRound(page) ? [page] : [])));
    }

    /** Loads these bytes into SCRATCH. */
    private take(bytes: Uint8Array): Motion {
        this.loaded[SCRATCH] = null;
        this.motion.setPage(SCRATCH, bytes);
        return this.motion;
    }

    /** Loads all pages of a document. */
    private load(document: MotionDocument): Motion {
        for (const [page, bytes] of document.pages.entries()) {
            if (this.loaded[page] !== bytes) this.motion.setPage(page, bytes);
            this.loaded[page] = bytes;
        }
        return this.motion;
    }
}
