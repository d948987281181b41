// SPDX-License-Identifier: MIT
// Where things stand in a page of 512 bytes, its empty form, its checksum and its checks: all of it from motion/page.h,
// through an instance of motion.wasm. No number of the format is written here.

import { JOINTS, PAGE_BYTES, PAGE_COUNT, POSITION_MAX, TICKS_PER_SECOND } from './motion.ts';
import type { Law, Motion, PageFault } from './motion.ts';

/** The order is that of layout[] in board/motion_api.c. `at...` are byte offsets, in a step from its beginning. */
const PAGE_LAYOUT = [
  'pageBytes', 'pageCount', 'joints', 'stepsMax', 'stepBytes', 'nameBytes',
  'atName', 'atPlayCount', 'atSchedule', 'atBlendRight', 'atBlendLeft', 'atSteps',
  'atPlayCode', 'atSpeed', 'atAccelTime', 'atNext', 'atExit', 'atLinked1',
  'atLinked1Code', 'atLinked2', 'atLinked2Code', 'atChecksum', 'atCompliance', 'atStep0',
  'atStepPause', 'atStepTime', 'scheduleSpeed', 'scheduleTime', 'speedNominal',
  'posMax', 'posUnused', 'posTorqueOff', 'ticksPerSecond',
] as const;

export type PageLayout = Readonly<Record<(typeof PAGE_LAYOUT)[number], number>>;

/** The page that the C functions work on. Any but 0 does. */
const SCRATCH = 1;
const ERASED = 0xff;
/** What motion.ts says without asking. */
const KNOWN: Partial<PageLayout> = { pageBytes: PAGE_BYTES, pageCount: PAGE_COUNT, joints: JOINTS, posMax: POSITION_MAX, ticksPerSecond: TICKS_PER_SECOND };

export class PageFormat {
  readonly layout: PageLayout;
  /** The empty page, sealed. Not to be written. */
  readonly empty: Uint8Array;
  /** Flash that was never written. Not to be written. */
  readonly erased: Uint8Array;
  private readonly motion: Motion;

  /** Takes an instance of motion.wasm for itself. Throws when it is of another version than this file. */
  constructor(motion: Motion) {
    const numbers = motion.layout;
    this.layout = Object.fromEntries(PAGE_LAYOUT.map((name, i) => [name, numbers[i]])) as PageLayout;
    const differs = Object.entries(KNOWN).some(([name, number]) => this.layout[name as keyof PageLayout] !== number);
    if (numbers.length !== PAGE_LAYOUT.length || differs) throw new Error('motion.wasm is of another version than the page: build again');
    this.motion = motion;
    motion.clear(SCRATCH);
    this.empty = motion.page(SCRATCH);
    this.erased = new Uint8Array(this.layout.pageBytes).fill(ERASED);
  }

  /** A copy whose checksum is right. */
  sealed(bytes: Uint8Array): Uint8Array {
    this.motion.setPage(SCRATCH, bytes);
    this.motion.seal(SCRATCH);
    return this.motion.page(SCRATCH);
  }

  /** The first thing that is wrong with a page, or null. Erased flash is a page without contents, not a damaged one. */
  fault(bytes: Uint8Array): PageFault | null {
    if (this.isErased(bytes)) return null;
    this.motion.setPage(SCRATCH, bytes);
    return this.motion.check(SCRATCH);
  }

  /** Flash that was never written. */
  isErased(bytes: Uint8Array): boolean {
    return bytes.every((byte) => byte === ERASED);
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
    this.motion.setPage(SCRATCH, bytes);
    return this.motion.isPlayable(SCRATCH);
  }

  /** Ticks of 1/128 s of a step (0..6) and of the pause behind it. `from`: where the joints stand before the page (servo units). */
  stepTicks(bytes: Uint8Array, step: number, from: ArrayLike<number>, law: Law = 'exact'): { move: number; pause: number } {
    this.motion.setPage(SCRATCH, bytes);
    return this.motion.stepTicks(SCRATCH, step, from, law);
  }
}
