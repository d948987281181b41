// SPDX-License-Identifier: MIT
// Converts one page to names and numbers and back. Reading never fails: of a damaged page it returns what can be read. Writing makes new,
// sealed bytes and keeps all other flags, unused words and reserved bytes.

import { POSITION_MIDDLE, TICKS_PER_SECOND } from './motion.ts';
import type { Law } from './motion.ts';
import type { PageFormat } from './page-format.ts';
import { ok, refuse } from './result.ts';
import type { Result } from './result.ts';

export interface Step {
    /** Servo units 0..1023 by servo ID, 0..30; null: the step does not use the joint. */
    readonly positions: readonly (number | null)[];
    /** 0..255: ticks of 1/128 s at nominal speed (schedule 'time'), or speed, 256 = 720 degrees/s (schedule 'speed'). */
    readonly time: number;
    /** 0..255, in ticks at nominal speed. */
    readonly pause: number;
}

export type Schedule = 'time' | 'speed';

/** Links: 0..127, 0 = none. Codes: 0..255, 0 = none. */
export interface PageView {
    readonly name: string;
    readonly steps: readonly Step[];
    /** How often the page plays before its link is followed; 0: it has no action. */
    readonly repetitions: number;
    readonly schedule: Schedule;
    /** 1..255, 32 is nominal. */
    readonly speed: number;
    /** Ramp in ticks. */
    readonly accelTime: number;
    readonly code: number;
    readonly next: number;
    readonly exit: number;
    readonly linked1: number;
    readonly linked1Code: number;
    readonly linked2: number;
    readonly linked2Code: number;
    readonly blendRight: number;
    readonly blendLeft: number;
    /** By ID: high nibble clockwise, low counter-clockwise; n = 1..7 is slope register 2^n. */
    readonly compliance: readonly number[];
}

/** One-byte fields. */
const BYTE_FIELDS = {
    repetitions: 'atPlayCount',
    speed: 'atSpeed',
    accelTime: 'atAccelTime',
    code: 'atPlayCode',
    next: 'atNext',
    exit: 'atExit',
    linked1: 'atLinked1',
    linked1Code: 'atLinked1Code',
    linked2: 'atLinked2',
    linked2Code: 'atLinked2Code',
    blendRight: 'atBlendRight',
    blendLeft: 'atBlendLeft',
} as const;
export type ByteField = keyof typeof BYTE_FIELDS;
export const LINK_FIELDS = ['next', 'exit', 'linked1', 'linked2'] as const;
export const PARTNER_FIELDS = ['blendRight', 'blendLeft'] as const;
export type LinkField = (typeof LINK_FIELDS)[number] | (typeof PARTNER_FIELDS)[number];
/** Largest value of a one-byte field. */
export const BYTE_MAX = 0xff;
const LINKS: readonly string[] = [...LINK_FIELDS, ...PARTNER_FIELDS];

function word(bytes: Uint8Array, at: number): number {
    return (bytes[at] ?? 0) | ((bytes[at + 1] ?? 0) << 8);
}

function readName(format: PageFormat, bytes: Uint8Array): string {
    const { atName, nameBytes } = format.layout;
    const raw = bytes.subarray(atName, atName + nameBytes - 1);
    const end = raw.indexOf(0);
    return String.fromCharCode(...(end < 0 ? raw : raw.subarray(0, end)));
}

function stepAt(format: PageFormat, step: number): number {
    return format.layout.atStep0 + step * format.layout.stepBytes;
}

function readPosition(format: PageFormat, found: number): number | null {
    const { posUnused, posTorqueOff } = format.layout;
    return found & (posUnused | posTorqueOff) ? null : found;
}

/** Step 0..6, even beyond the page's step count. */
export function readStep(format: PageFormat, bytes: Uint8Array, step: number): Step {
    const at = stepAt(format, step);
    const { joints, atStepPause, atStepTime } = format.layout;
    return {
        positions: Array.from({ length: joints }, (_, id) => readPosition(format, word(bytes, at + 2 * id))),
        time: bytes[at + atStepTime] ?? 0,
        pause: bytes[at + atStepPause] ?? 0,
    };
}

/** Erased flash reads as the empty page. */
export function readPage(format: PageFormat, found: Uint8Array): PageView {
    const bytes = format.isErased(found) ? format.empty : found;
    const { layout } = format;
    const count = Math.min(bytes[layout.atSteps] ?? 0, layout.stepsMax);
    const fields = Object.fromEntries(Object.entries(BYTE_FIELDS).map(([field, at]) => [field, bytes[layout[at]] ?? 0])) as Record<
        ByteField,
        number
    >;
    return {
        name: readName(format, bytes),
        steps: Array.from({ length: count }, (_, step) => readStep(format, bytes, step)),
        schedule: bytes[layout.atSchedule] === layout.scheduleSpeed ? 'speed' : 'time',
        compliance: [...bytes.subarray(layout.atCompliance, layout.atCompliance + layout.joints)],
        ...fields,
    };
}

/** A sealed copy of `found` with these fields changed. Erased flash counts as the empty page. Refuses what the format cannot hold. */
export function writePage(format: PageFormat, found: Uint8Array, change: Partial<PageView>): Result<Uint8Array> {
    const bytes = (format.isErased(found) ? format.empty : found).slice();
    const { layout } = format;
    for (const [field, at] of Object.entries(BYTE_FIELDS) as [ByteField, (typeof BYTE_FIELDS)[ByteField]][]) {
        const value = change[field];
        if (value === undefined) continue;
        const most = LINKS.includes(field) ? layout.pageCount - 1 : BYTE_MAX;
        const least = field === 'speed' ? 1 : 0;
        if (!isWhole(value, least, most)) return refuse('bad-number', `${field} ${value}, not ${least}..${most}`);
        bytes[layout[at]] = value;
    }
    if (change.schedule !== undefined) bytes[layout.atSchedule] = change.schedule === 'speed' ? layout.scheduleSpeed : layout.scheduleTime;
    if (change.compliance) bytes.set(change.compliance, layout.atCompliance);
    if (change.name !== undefined && !writeName(format, bytes, change.name)) return refuse('bad-name', change.name);
    const wrong = change.steps ? writeSteps(format, bytes, change.steps) : null;
    return wrong ?? ok(format.sealed(bytes));
}

function isWhole(value: number, least: number, most: number): boolean {
    return Number.isInteger(value) && value >= least && value <= most;
}

function writeName(format: PageFormat, bytes: Uint8Array, name: string): boolean {
    const { atName, nameBytes } = format.layout;
    if (name.length >= nameBytes || !/^[\x20-\x7e]*$/.test(name)) return false;
    bytes.fill(0, atName, atName + nameBytes);
    bytes.set(
        Array.from(name, letter => letter.charCodeAt(0)),
        atName,
    );
    return true;
}

/** Null: done. Removed steps are set to unused. Bytes after the old steps stay unchanged. */
function writeSteps(format: PageFormat, bytes: Uint8Array, steps: readonly Step[]): Result<never> | null {
    const { layout } = format;
    if (steps.length > layout.stepsMax) return refuse('steps-full');
    const before = Math.min(bytes[layout.atSteps] ?? 0, layout.stepsMax);
    for (const [index, step] of steps.entries()) {
        const wrong = writeStep(format, bytes, index, step);
        if (wrong) return wrong;
    }
    for (let index = steps.length; index < before; index++) {
        const at = stepAt(format, index);
        bytes.set(format.empty.subarray(at, at + layout.stepBytes), at);
    }
    bytes[layout.atSteps] = steps.length;
    return null;
}

function writeStep(format: PageFormat, bytes: Uint8Array, index: number, step: Step): Result<never> | null {
    const { layout } = format;
    const at = stepAt(format, index);
    if (!isWhole(step.time, 0, BYTE_MAX)) return refuse('bad-number', `time ${step.time}, not 0..${BYTE_MAX}`);
    if (!isWhole(step.pause, 0, BYTE_MAX)) return refuse('bad-number', `pause ${step.pause}, not 0..${BYTE_MAX}`);
    if (step.positions.length !== layout.joints) return refuse('no-such-joint', `${step.positions.length} joints`);
    for (const [id, position] of step.positions.entries()) {
        if (position === readPosition(format, word(bytes, at + 2 * id))) continue; // keeps a value hidden by a flag
        if (position !== null && !isWhole(position, 0, layout.posMax))
            return refuse('bad-number', `position ${position}, not 0..${layout.posMax}`);
        const value = position ?? layout.posUnused;
        bytes[at + 2 * id] = value & 0xff;
        bytes[at + 2 * id + 1] = value >> 8;
    }
    bytes[at + layout.atStepTime] = step.time;
    bytes[at + layout.atStepPause] = step.pause;
    return null;
}

/** Seconds of a step (0..) and of the pause after it, as the firmware plays it. `from`: the joints before the page. */
export function stepSeconds(
    format: PageFormat,
    bytes: Uint8Array,
    step: number,
    from: ArrayLike<number>,
    law: Law = 'exact',
): { move: number; pause: number } {
    const { move, pause } = format.stepTicks(bytes, step, from, law);
    return { move: move / TICKS_PER_SECOND, pause: pause / TICKS_PER_SECOND };
}

/** Seconds of a page with all repetitions, without the pages after it, as the firmware plays it. It starts from the first pose, with unused
 *  joints in the middle. 0: the page has no action or is damaged. */
export function pageSeconds(format: PageFormat, bytes: Uint8Array, law: Law = 'exact'): number {
    if (!format.isPlayable(bytes)) return 0;
    const { joints } = format.layout;
    const page = readPage(format, bytes);
    const from = Array.from({ length: joints }, (_, id) => page.steps[0]?.positions[id] ?? POSITION_MIDDLE);
    const once = page.steps.reduce((sum, _, step) => {
        const { move, pause } = stepSeconds(format, bytes, step, from, law);
        return sum + move + pause;
    }, 0);
    return once * page.repetitions;
}
