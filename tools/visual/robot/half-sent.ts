// SPDX-License-Identifier: MIT
// The pages that were sent into Edit's RAM and perhaps not saved. If the cable is pulled meanwhile, Edit has such a page as unsaved edits,
// which nobody has made. It must not be saved, and UNDO does not undo it. Edit drops it when it gets the bytes of flash back.

import type { PageFormat } from '../model/page-format.ts';
import { DATA_BYTES, askRamCrc, sendData } from './page-requests.ts';
import type { Ask } from './page-requests.ts';

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

    /** The page of which Edit's RAM has the first pieces, and nobody's edits; null: none. */
    async find(requests: Ask): Promise<SentPage | null> {
        const pages = this.kept.load();
        if (pages.length === 0) return null;
        const crc = await askRamCrc(requests);
        return pages.find(one => this.stages(one).includes(crc)) ?? null;
    }

    /** Gives Edit's RAM the bytes of flash back if what it has is ours. Returns the page; null: it has something else. */
    async putBack(requests: Ask): Promise<SentPage | null> {
        const one = await this.find(requests);
        if (one) await this.takeBack(requests, one);
        return one;
    }

    /** From the last piece to the first, so that a cable that is pulled meanwhile leaves a page that find() knows. */
    async takeBack(requests: Ask, one: SentPage): Promise<void> {
        const loaded = this.loaded(one);
        for (const offset of differences(loaded, one.after).reverse()) await sendData(requests, offset, piece(loaded, offset));
        this.end(one);
    }

    /** The content of RAM after `@open`: Edit reads erased flash as its new page. */
    loaded({ before }: SentPage): Uint8Array {
        return this.format.isErased(before) ? newPage(this.format.empty) : before;
    }

    /** The CRCs of the page after each piece. */
    private stages(one: SentPage): number[] {
        const inRam = this.loaded(one).slice();
        return differences(inRam, one.after).map(offset => {
            inRam.set(piece(one.after, offset), offset);
            return this.format.crc(inRam);
        });
    }

    private others(one: SentPage): SentPage[] {
        return this.kept.load().filter(other => !isSame(other, one));
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
