// SPDX-License-Identifier: MIT
// The pages that were sent into Edit's RAM and perhaps not saved. If the cable is pulled meanwhile, Edit has such a page as unsaved edits,
// which nobody has made. It must not be saved, and UNDO does not undo it. Edit drops it when it gets the bytes of flash back.
//
// If the board restarts meanwhile, Edit has another page open. So a piece without an answer is not sent again before the CRC of RAM has shown
// that it is still that page. Pieces that came whole after the restart lie over the other page, and are put back as well.

import type { PageFormat } from '../model/page-format.ts';
import { DATA_BYTES, ERR_UNSAVED, askRamCrc, openPage, sendData } from './page-requests.ts';
import type { Ask } from './page-requests.ts';
import { askPage } from './protocol.ts';
import { RobotError } from './robot-error.ts';

export interface SentPage {
    readonly page: number;
    /** The robot's page in flash. */
    readonly before: Uint8Array;
    /** Sealed. */
    readonly after: Uint8Array;
}

/** Where they are kept: a reload in mid-write must not forget them. */
export interface KeptPages {
    load(): readonly SentPage[];
    store(pages: readonly SentPage[]): void;
}

/** Each robot has one. More of them are only more chances that somebody's edits have the same CRC. */
const MOST = 4;
/** The page that Edit opens when it starts. */
const FIRST_OPEN = 1;
const TRIES = 3;

/** What Edit's RAM has of a page, and what it is to have again. */
interface Found {
    readonly one: SentPage;
    readonly ram: Uint8Array;
    readonly loaded: Uint8Array;
}

export class HalfSent {
    private readonly format: PageFormat;
    private readonly kept: KeptPages;

    constructor(format: PageFormat, kept: KeptPages = inMemory()) {
        this.format = format;
        this.kept = kept;
    }

    /** The page that was begun last and is not known to be saved or put back; null: none. */
    get last(): SentPage | null {
        return this.kept.load()[0] ?? null;
    }

    /** Before its first byte is sent. */
    begin(one: SentPage): void {
        this.kept.store([one, ...this.others(one)].slice(0, MOST));
    }

    /** It is in flash, or not in RAM any more. */
    end(one: SentPage): void {
        const others = this.others(one);
        if (others.length < this.kept.load().length) this.kept.store(others);
    }

    /** The page of which Edit's RAM has pieces, and nobody's edits; null: none. */
    async find(requests: Ask): Promise<SentPage | null> {
        return ((await this.overItself(requests)) ?? (await this.overFirst(requests)))?.one ?? null;
    }

    /** Gives Edit's RAM the bytes of flash back if what it has is ours. Returns the page, which is open then; null: it has something else. */
    async putBack(requests: Ask): Promise<SentPage | null> {
        // Both may look the same. Only for the page that is open Edit has no edits then.
        const found = [await this.overItself(requests), await this.overFirst(requests)].filter(one => one !== null);
        let ram = found[0]?.ram;
        for (const { one, loaded } of found) {
            // From the last piece to the first, so that a cable that is pulled meanwhile leaves a page that find() knows.
            if (!ram || !(await this.fill(requests, ram, loaded, everyPiece(ram).reverse()))) return null;
            ram = loaded;
            if (!(await isOpened(requests, one.page))) continue;
            this.end(one);
            return one;
        }
        return null;
    }

    /** Turns the page in Edit's RAM from `ram` into `wanted`. false: it is another page, because the board has restarted. */
    async fill(requests: Ask, ram: Uint8Array, wanted: Uint8Array, offsets: readonly number[] = everyPiece(wanted)): Promise<boolean> {
        let [before, isSure] = [ram, false];
        for (const offset of offsets) {
            const after = withPiece(before, wanted, offset);
            if (differences(before, after).length === 0) continue;
            for (let tries = 1; ; tries++) {
                const crc = isSure ? null : await askRamCrc(requests);
                if (crc === this.format.crc(after)) break;
                if (crc !== null && crc !== this.format.crc(before)) return false;
                isSure = await isTaken(sendData(requests, offset, piece(wanted, offset)), tries === TRIES);
                if (isSure) break;
            }
            before = after;
        }
        return true;
    }

    /** The content of RAM after `@open`: Edit reads erased flash as its new page. */
    loaded({ before }: Pick<SentPage, 'before'>): Uint8Array {
        return this.format.isErased(before) ? newPage(this.format.empty) : before;
    }

    private async overItself(requests: Ask): Promise<Found | null> {
        return this.match(requests, one => {
            const loaded = this.loaded(one);
            return { one, loaded, rams: stages(loaded, one.after, differences(loaded, one.after)) };
        });
    }

    private async overFirst(requests: Ask): Promise<Found | null> {
        if (this.last === null) return null;
        const loaded = this.loaded({ before: await askPage(requests, FIRST_OPEN, bytes => this.format.crc(bytes)) });
        return this.match(requests, one => {
            // One piece that was on its way; or it and all behind it, which were answered.
            const sent = differences(this.loaded(one), one.after).reverse();
            const single = sent.map(offset => withPiece(loaded, one.after, offset));
            return { one, loaded, rams: [...single, ...stages(loaded, one.after, sent)] };
        });
    }

    private async match(
        requests: Ask,
        look: (one: SentPage) => { one: SentPage; loaded: Uint8Array; rams: readonly Uint8Array[] },
    ): Promise<Found | null> {
        if (this.last === null) return null;
        const crc = await askRamCrc(requests);
        for (const { one, loaded, rams } of this.kept.load().map(look)) {
            const ram = rams.find(bytes => this.format.crc(bytes) === crc);
            if (ram) return { one, loaded, ram };
        }
        return null;
    }

    private others(one: SentPage): SentPage[] {
        return this.kept.load().filter(other => !isSame(other, one));
    }
}

/** The page after each of these pieces. */
function stages(page: Uint8Array, wanted: Uint8Array, offsets: readonly number[]): Uint8Array[] {
    let ram = page;
    return offsets.map(offset => {
        ram = withPiece(ram, wanted, offset);
        return ram;
    });
}

function withPiece(page: Uint8Array, wanted: Uint8Array, offset: number): Uint8Array {
    const out = page.slice();
    out.set(piece(wanted, offset), offset);
    return out;
}

/** false: it has no answer. */
async function isTaken(sent: Promise<void>, isLast: boolean): Promise<boolean> {
    try {
        await sent;
        return true;
    } catch (error) {
        if (isLast || !(error instanceof RobotError) || error.code !== 'no-answer') throw error;
        return false;
    }
}

/** false: the page in RAM has edits. */
export async function isOpened(requests: Ask, page: number): Promise<boolean> {
    try {
        await openPage(requests, page);
        return true;
    } catch (error) {
        if (!(error instanceof RobotError) || error.number !== ERR_UNSAVED) throw error;
        return false;
    }
}

/** Edit's new page, which is not the empty page of the specification: session_new_byte() in firmware/edit/session.c. Its times are speeds. */
function newPage(empty: Uint8Array): Uint8Array {
    const page = empty.slice();
    page[16] = 0; // schedule
    page[31] = 0; // checksum
    page[63] = 0x55; // compliance, of a joint 31
    for (let speed = 127; speed < page.length; speed += 64) page[speed] = 64; // of each step
    return page;
}

export function isSame(a: SentPage, b: SentPage): boolean {
    return a.page === b.page && differences(a.before, b.before).length === 0 && differences(a.after, b.after).length === 0;
}

function inMemory(): KeptPages {
    let pages: readonly SentPage[] = [];
    return {
        load: () => pages,
        store: now => {
            pages = now;
        },
    };
}

export function piece(bytes: Uint8Array, offset: number): Uint8Array {
    return bytes.subarray(offset, offset + DATA_BYTES);
}

export function everyPiece(bytes: Uint8Array): number[] {
    return Array.from({ length: bytes.length / DATA_BYTES }, (_, i) => i * DATA_BYTES);
}

/** Offsets of the pieces that differ. */
export function differences(a: Uint8Array, b: Uint8Array): number[] {
    return everyPiece(b).filter(offset => piece(a, offset).some((byte, i) => byte !== b[offset + i]));
}
