// SPDX-License-Identifier: MIT
// The firmware's page checks and player (motion.wasm) with names and types. board/motion_api.h documents the functions. Pure: the instance
// is passed in.

import * as facts from './facts.ts';

export const { PAGE_BYTES, PAGE_COUNT } = facts;
export const JOINTS = facts.PAGE_JOINTS;
export const TICKS_PER_SECOND = facts.PLAYER_TICKS_PER_SECOND;
/** The longest part of a play that the player gives at once: 128 s. */
export const CURVE_TICKS_MOST = facts.MOTION_API_CURVE_TICKS;
/** Servo positions are 0..POSITION_MAX. */
export const POSITION_MAX = facts.PAGE_POS_MAX;
/** Servo position in the middle of its range. */
export const POSITION_MIDDLE = facts.PAGE_POS_MIDDLE;
/** The page of the motion library that takes the robot to its standing pose. */
export const STANDING_PAGE = 1;
/** Battery voltage to assume if it is unknown: a CM-5's eight cells. */
export const NOMINAL_VOLTS = 9.6;

/** Bytes per tick in Curve.marks. */
export const MARK_BYTES = facts.MOTION_API_MARK_BYTES;

export type Law = 'exact' | 'classic';
export const LAW_OF: Readonly<Record<Law, number>> = { exact: facts.PLAYER_LAW_EXACT, classic: facts.PLAYER_LAW_CLASSIC };

/** Faults of a page, by page_status_t. */
const PAGE_FAULTS = {
    [facts.PAGE_ERR_CHECKSUM]: 'checksum',
    [facts.PAGE_ERR_STEPS]: 'steps',
    [facts.PAGE_ERR_SCHEDULE]: 'schedule',
    [facts.PAGE_ERR_SPEED]: 'speed',
    [facts.PAGE_ERR_POSITION]: 'position',
} as const;
export type PageFault = (typeof PAGE_FAULTS)[keyof typeof PAGE_FAULTS];
const FAULT_OF: Readonly<Record<number, PageFault>> = PAGE_FAULTS;

/** Kinds of leads, by motion_api_lead_t: links that a play follows, and partners for blending. */
const LEADS = {
    [facts.MOTION_API_LEAD_NEXT]: 'next',
    [facts.MOTION_API_LEAD_EXIT]: 'exit',
    [facts.MOTION_API_LEAD_LINKED1]: 'linked1',
    [facts.MOTION_API_LEAD_LINKED2]: 'linked2',
    [facts.MOTION_API_LEAD_BLEND_RIGHT]: 'blendRight',
    [facts.MOTION_API_LEAD_BLEND_LEFT]: 'blendLeft',
} as const;
export type LeadKind = (typeof LEADS)[keyof typeof LEADS];
const LEAD_OF: Readonly<Record<number, LeadKind>> = LEADS;

/** code: the remote's code that selects this lead; 0: none is needed. */
export interface Lead {
    readonly kind: LeadKind;
    readonly to: number;
    readonly code: number;
}

/** Modifies a play, in percent. A negative blend is to the left. Ranges: SHAPE_RANGES. */
export interface Shape {
    readonly rate: number;
    readonly amplitude: number;
    readonly blend: number;
}

export const AS_STORED: Shape = { rate: facts.SHAPE_NORMAL, amplitude: facts.SHAPE_NORMAL, blend: 0 };
export const SHAPE_RANGES: Readonly<Record<keyof Shape, readonly [least: number, most: number]>> = {
    rate: [facts.SHAPE_RATE_MIN, facts.SHAPE_RATE_MAX],
    amplitude: [0, facts.SHAPE_AMPLITUDE_MAX],
    blend: [-facts.SHAPE_BLEND_MAX, facts.SHAPE_BLEND_MAX],
};

/** Part of a play. Each tick has JOINTS goals (servo units) and MARK_BYTES of marks: page, step, events. */
export interface Curve {
    readonly ticks: number;
    readonly goals: Uint16Array;
    readonly marks: Uint8Array;
    readonly ended: boolean;
}

/** The exports of motion.wasm. It has no imports. */
export interface MotionExports {
    readonly memory: { readonly buffer: ArrayBuffer };
    _initialize(): void;
    motion_api_pages(): number;
    motion_api_check(page: number): number;
    motion_api_seal(page: number): void;
    motion_api_clear(page: number): void;
    motion_api_is_playable(page: number): number;
    motion_api_crc16(page: number): number;
    motion_api_mirrored(pos: number): number;
    motion_api_pos_between(a: number, b: number): number;
    motion_api_time_between(time: number): number;
    motion_api_remote_code(buttons: number): number;
    motion_api_leads(page: number): number;
    motion_api_leads_table(): number;
    motion_api_reach(first: number): number;
    motion_api_exits_round(page: number): number;
    motion_api_moved(): number;
    motion_api_relink(page: number): void;
    motion_api_pose(): number;
    motion_api_first_pose(page: number): number;
    motion_api_pose_after(page: number, step: number): void;
    motion_api_step_ticks(page: number, step: number, law: number): number;
    motion_api_pause_ticks(page: number, step: number, law: number): number;
    motion_api_shape(rate: number, amplitude: number, blend: number): number;
    motion_api_top_speed_q4_4(decivolts: number): number;
    motion_api_start(page: number, law: number, mode: number, code: number, present: number): number;
    motion_api_code(code: number): void;
    motion_api_curve(ticks: number): number;
    motion_api_curve_goals(): number;
    motion_api_curve_marks(): number;
}

/** A motion area of 128 pages and a player for it. */
export class Motion {
    private readonly api: MotionExports;

    /** Takes the exports of a new instance, which must not be used elsewhere. */
    constructor(api: MotionExports) {
        this.api = api;
        api._initialize();
    }

    /** The 65,536 bytes of all pages, as in flash. This is a view, valid until the next call. */
    get pages(): Uint8Array {
        return new Uint8Array(this.api.memory.buffer, this.api.motion_api_pages(), PAGE_BYTES * PAGE_COUNT);
    }

    setPage(page: number, bytes: Uint8Array): void {
        if (bytes.length !== PAGE_BYTES) throw new RangeError(`a page has ${PAGE_BYTES} bytes, not ${bytes.length}`);
        this.pages.set(bytes, this.place(page));
    }

    page(page: number): Uint8Array {
        return this.pages.slice(this.place(page), this.place(page) + PAGE_BYTES);
    }

    /** The first fault of a page, or null. */
    check(page: number): PageFault | null {
        const status = this.api.motion_api_check(this.number(page));
        return FAULT_OF[status] ?? null;
    }

    seal(page: number): void {
        this.api.motion_api_seal(this.number(page));
    }

    clear(page: number): void {
        this.api.motion_api_clear(this.number(page));
    }

    isPlayable(page: number): boolean {
        return this.api.motion_api_is_playable(this.number(page)) !== 0;
    }

    crc(page: number): number {
        return this.api.motion_api_crc16(this.number(page));
    }

    /** A position (servo units) mirrored to the joint on the other side. */
    mirrored(position: number): number {
        return this.api.motion_api_mirrored(position);
    }

    /** The position half-way from a to b. */
    positionBetween(a: number, b: number): number {
        return this.api.motion_api_pos_between(a, b);
    }

    /** Splits a step's time (0..255) for a new step half-way before it: the new step's share, and the rest. */
    timeSplit(time: number): { readonly share: number; readonly rest: number } {
        const both = this.api.motion_api_time_between(time);
        return { share: both & 0xff, rest: both >> 8 };
    }

    /** The code of remote buttons pressed together (bits); 0: none. */
    remoteCode(buttons: number): number {
        return this.api.motion_api_remote_code(buttons);
    }

    /** Where a page leads, as the firmware decides it. Leads that it never follows are left out. */
    leads(page: number): Lead[] {
        const count = this.api.motion_api_leads(this.number(page));
        const rows = new Uint8Array(this.api.memory.buffer, this.api.motion_api_leads_table(), count * facts.MOTION_API_LEAD_BYTES);
        return Array.from({ length: count }, (_, i) => {
            const [kind = 0, to = 0, code = 0] = rows.subarray(i * facts.MOTION_API_LEAD_BYTES);
            return { kind: LEAD_OF[kind] ?? 'next', to, code };
        });
    }

    /** Pages that a play of `first` can reach, including itself, in order. first 0: the same for all pages that a code calls. */
    reach(first: number): number[] {
        const reached = new Uint8Array(this.api.memory.buffer, this.api.motion_api_reach(first), PAGE_COUNT);
        return Array.from(reached, (is, page) => (is ? page : 0)).filter(page => page !== 0);
    }

    /** The exit links from this page on form a circle. */
    exitsRound(page: number): boolean {
        return this.api.motion_api_exits_round(this.number(page)) !== 0;
    }

    /** Updates the links and partners of a page after pages have moved: from -> to, 0 if nothing is left there. */
    relink(page: number, moved: ReadonlyMap<number, number>): void {
        const table = new Uint8Array(this.api.memory.buffer, this.api.motion_api_moved(), PAGE_COUNT);
        table.set(Array.from(table, (_, from) => moved.get(from) ?? from));
        this.api.motion_api_relink(this.number(page));
    }

    /** The pose of a page's step 1. Joints that it does not use stay as in `from` (servo units). */
    firstPose(page: number, from: ArrayLike<number>): Uint16Array {
        this.pose.set(from);
        this.api.motion_api_first_pose(this.number(page));
        return this.pose.slice();
    }

    /** The pose after a step of a page. Joints that the page does not use stay as in `from` (servo units). */
    poseAfter(page: number, step: number, from: ArrayLike<number>): Uint16Array {
        this.pose.set(from);
        this.api.motion_api_pose_after(this.number(page), step);
        return this.pose.slice();
    }

    /** Ticks of a step (0..6) of a valid page and of the pause after it. `from`: the pose before the page. */
    stepTicks(page: number, step: number, from: ArrayLike<number>, law: Law = 'exact'): { move: number; pause: number } {
        this.pose.set(from);
        const number = this.number(page);
        const lawNumber = LAW_OF[law];
        const move = this.api.motion_api_step_ticks(number, step, lawNumber);
        const pause = this.api.motion_api_pause_ticks(number, step, lawNumber);
        if (move < 0 || pause < 0) throw new RangeError(`no step ${step} in page ${page}`);
        return { move, pause };
    }

    /** Shapes all plays that start from now on. Throws RangeError if a number is out of range. */
    setShape({ rate, amplitude, blend }: Shape): void {
        if (!this.api.motion_api_shape(rate, amplitude, blend)) throw new RangeError(`no shape: ${rate} ${amplitude} ${blend}`);
    }

    /** The highest speed that the firmware asks of an AX-12 when it shapes a motion: 90 % of the servo's limit at this voltage. Servo units
     *  per tick. */
    topSpeed(volts: number): number {
        return this.api.motion_api_top_speed_q4_4(Math.round(volts * 10)) / 16;
    }

    /** Starts a play from a pose (31 servo units). false: the page is damaged or has no action. */
    start(page: number, pose: ArrayLike<number>, options: { law?: Law; code?: number; joints?: number } = {}): boolean {
        this.pose.set(pose);
        const law = LAW_OF[options.law ?? 'exact'];
        const joints = options.joints ?? 0x7fffffff;
        return this.api.motion_api_start(this.number(page), law, 0, options.code ?? 0, joints) === 0;
    }

    /** Passes a code (0 released, LINK_CODE_STOP). It takes effect at the next decision of a link, as in the robot. */
    code(code: number): void {
        this.api.motion_api_code(code);
    }

    /** Continues the play for at most this many ticks (CURVE_TICKS_MOST per call). */
    curve(ticks: number): Curve {
        const played = this.api.motion_api_curve(ticks);
        const memory = this.api.memory.buffer;
        return {
            ticks: played,
            goals: new Uint16Array(memory, this.api.motion_api_curve_goals(), played * JOINTS).slice(),
            marks: new Uint8Array(memory, this.api.motion_api_curve_marks(), played * MARK_BYTES).slice(),
            ended: played < ticks,
        };
    }

    private get pose(): Uint16Array {
        return new Uint16Array(this.api.memory.buffer, this.api.motion_api_pose(), JOINTS);
    }

    private place(page: number): number {
        return this.number(page) * PAGE_BYTES;
    }

    private number(page: number): number {
        if (!Number.isInteger(page) || page < 0 || page >= PAGE_COUNT) throw new RangeError(`no page ${page}`);
        return page;
    }
}
