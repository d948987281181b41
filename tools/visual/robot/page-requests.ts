// SPDX-License-Identifier: MIT
// Requests of PROTOCOL.md that list, write and save pages. `@crcs` is in both images, the others are only in Edit.

import { PAGE_COUNT } from '../model/motion.ts';
import type { PageFormat } from '../model/page-format.ts';
import { hexOf } from './hex.ts';
import { askTwice } from './protocol.ts';
import { RobotError } from './robot-error.ts';
import type { Requests } from './requests.ts';

export type Ask = Pick<Requests, 'ask'>;

/** Most bytes in one `@data`. */
export const DATA_BYTES = 32;
const CRCS_MS = 4000;
const SAVE_MS = 2000;
/** ERR of `@open`: the page in the board's RAM has unsaved edits. */
export const ERR_UNSAVED = 12;
/** ERR of `@save`: the page in RAM has another CRC. */
export const ERR_CRC = 9;
/** ERR of `@save`: no boot loader there can write, or flash did not take the page. */
const ERR_SAVE = 11;

function crcOf(words: string): number {
    if (!/^[0-9A-F]{4}$/i.test(words)) throw new RobotError('foreign', `a CRC: ${words.slice(0, 20)}`);
    return Number.parseInt(words, 16);
}

export interface CrcsOptions {
    readonly signal?: AbortSignal;
    /** The answer has no checksum. One that is not expected is believed only if the robot gives the same twice more. */
    readonly isExpected?: (crcs: readonly number[]) => boolean;
}

/** The CRC-16 of each of these pages in flash. */
export async function askPageCrcs(
    requests: Ask,
    first = 0,
    last = PAGE_COUNT - 1,
    { isExpected = () => true, ...options }: CrcsOptions = {},
): Promise<number[]> {
    const request = [`@crcs ${first} ${last}`, { timeoutMs: CRCS_MS, ...options }] as const;
    const crcs = crcsOf(await requests.ask(...request), last - first + 1);
    return isExpected(crcs) ? crcs : crcsOf(await askTwice(requests, ...request), crcs.length);
}

function crcsOf(answer: string, count: number): number[] {
    const words = answer.match(/.{1,4}/g) ?? [];
    if (words.length !== count) throw new RobotError('foreign', `@crcs: ${words.length} pages`);
    return words.map(crcOf);
}

/** Loads a page into the board's RAM. Refused with ERR 12 if the page there has unsaved edits. */
export async function openPage(requests: Ask, page: number): Promise<void> {
    await requests.ask(`@open ${page}`);
}

/** Writes at most 32 bytes into the page in RAM, which after a restart is another page. */
export async function sendData(requests: Ask, offset: number, bytes: Uint8Array): Promise<void> {
    await requests.ask(`@data ${offset} ${hexOf(bytes)}`, { once: true });
}

/** CRC-16 of the page in RAM. */
export async function askRamCrc(requests: Ask): Promise<number> {
    return crcOf(await requests.ask('@crc'));
}

/** Saves the page in RAM under this number if its CRC matches. Rejects with RobotError save-failed if the board cannot save; save-pending
 *  if until its next start, which tries again, a page is half saved: this one, which is in `words`, or one before it. */
export async function savePage(requests: Ask, page: number, crc: number): Promise<void> {
    try {
        await requests.ask(`@save ${page} ${crc.toString(16).padStart(4, '0')}`, { timeoutMs: SAVE_MS });
    } catch (error) {
        if (!(error instanceof RobotError) || error.number !== ERR_SAVE) throw error;
        const isPending = error.words.includes('the next start tries again');
        const code = isPending || error.words.includes('an earlier save is pending') ? 'save-pending' : 'save-failed';
        throw new RobotError(code, isPending ? String(page) : '', { cause: error });
    }
}

/** Whether Edit's RAM has edits that are not in flash and would be lost by a restart. */
export async function hasUnsavedEdits(requests: Ask, format: Pick<PageFormat, 'crc' | 'empty'>): Promise<boolean> {
    const crc = await askRamCrc(requests);
    return crc !== format.crc(format.empty) && !(await askPageCrcs(requests)).includes(crc);
}
