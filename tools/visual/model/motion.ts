// SPDX-License-Identifier: MIT
// The firmware's page checks and player (motion.wasm), with names and types. What each function means stands in
// board/motion_api.h. Pure: the module's instance comes from outside.

/** The firmware's sizes, for what has no motion.wasm at hand. They stand only here, and page-format.ts takes no motion.wasm that has
 *  others. */
export const PAGE_BYTES = 512;
export const PAGE_COUNT = 128;
export const JOINTS = 31;
export const TICKS_PER_SECOND = 128;
/** Of a servo: units 0..POSITION_MAX. */
export const POSITION_MAX = 1023;
/** Where a servo stands in the middle of its way. */
export const POSITION_MIDDLE = (POSITION_MAX + 1) / 2;
const MARK_BYTES = 3;

export type Law = 'exact' | 'classic';

/** What is wrong with a page, in the order of page_status_t. */
export const PAGE_FAULTS = ['checksum', 'steps', 'schedule', 'speed', 'link', 'position'] as const;
export type PageFault = (typeof PAGE_FAULTS)[number];

/** How a play is shaped, in percent: rate 10..400, amplitude 0..150, blend -100 (left) .. 100 (right). */
export interface Shape {
  readonly rate: number;
  readonly amplitude: number;
  readonly blend: number;
}

export const AS_STORED: Shape = { rate: 100, amplitude: 100, blend: 0 };

/** What happened in a tick: bits of player.h. */
export const PLAYER_EVENT = { output: 1, step: 2, page: 4, link: 8, busy: 16, ended: 32, standing: 64 } as const;

/** A piece of a play: 31 goals a tick (servo units), and page, step, events of each tick. */
export interface Curve {
  readonly ticks: number;
  readonly goals: Uint16Array;
  readonly marks: Uint8Array;
  readonly ended: boolean;
}

/** What an instance of motion.wasm exports; it imports nothing. */
export interface MotionExports {
  readonly memory: { readonly buffer: ArrayBuffer };
  _initialize(): void;
  motion_api_layout(): number;
  motion_api_layout_count(): number;
  motion_api_pages(): number;
  motion_api_check(page: number): number;
  motion_api_seal(page: number): void;
  motion_api_clear(page: number): void;
  motion_api_is_playable(page: number): number;
  motion_api_pose(): number;
  motion_api_first_pose(page: number): number;
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

/** One motion area of 128 pages with a player on it. */
export class Motion {
  private readonly api: MotionExports;

  /** Takes the exports of a new instance; nobody else may use it. */
  constructor(api: MotionExports) {
    this.api = api;
    api._initialize();
  }

  /** Where things stand in a page: the numbers that page-format.ts gives their names. */
  get layout(): readonly number[] {
    return [...new Uint16Array(this.api.memory.buffer, this.api.motion_api_layout(), this.api.motion_api_layout_count())];
  }

  /** The 65,536 bytes of all pages, as they lie in flash; a view, good until the next call. */
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

  /** The first thing that is wrong with a page, or null. */
  check(page: number): PageFault | null {
    const status = this.api.motion_api_check(this.number(page));
    return PAGE_FAULTS[status - 1] ?? null;
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

  /** Where step 1 of a page wants its joints; the others as in `from` (servo units). */
  firstPose(page: number, from: ArrayLike<number>): Uint16Array {
    this.pose.set(from);
    this.api.motion_api_first_pose(this.number(page));
    return this.pose.slice();
  }

  /** Ticks of a step (0..6) of a good page and of the pause behind it; the joints stand as in `from` before the page. */
  stepTicks(page: number, step: number, from: ArrayLike<number>, law: Law = 'exact'): { move: number; pause: number } {
    this.pose.set(from);
    const number = this.number(page);
    const lawNumber = law === 'classic' ? 1 : 0;
    const move = this.api.motion_api_step_ticks(number, step, lawNumber);
    const pause = this.api.motion_api_pause_ticks(number, step, lawNumber);
    if (move < 0 || pause < 0) throw new RangeError(`no step ${step} in page ${page}`);
    return { move, pause };
  }

  /** How the plays that begin from now on are shaped. Throws RangeError when a number is out of its range. */
  setShape({ rate, amplitude, blend }: Shape): void {
    if (!this.api.motion_api_shape(rate, amplitude, blend)) throw new RangeError(`no shape: ${rate} ${amplitude} ${blend}`);
  }

  /** The fastest that the firmware asks of an AX-12 when it shapes a motion: 90 % of what it can do at this voltage. Servo
   *  units a tick. */
  topSpeed(volts: number): number {
    return this.api.motion_api_top_speed_q4_4(Math.round(volts * 10)) / 16;
  }

  /** Begins a play from a pose (31 servo units). false: the page is damaged or has no action. */
  start(page: number, pose: ArrayLike<number>, options: { law?: Law; code?: number; joints?: number } = {}): boolean {
    this.pose.set(pose);
    const law = options.law === 'classic' ? 1 : 0;
    const joints = options.joints ?? 0x7fffffff;
    return this.api.motion_api_start(this.number(page), law, 0, options.code ?? 0, joints) === 0;
  }

  /** A code arrives (0 released, 255 stop); it counts at the next decision of a link, as in the robot. */
  code(code: number): void {
    this.api.motion_api_code(code);
  }

  /** Plays on for at most so many ticks (16,384 at once). */
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
