// SPDX-License-Identifier: MIT
// Writes pages into a robot that runs Edit and tracks each of them. The cable may be pulled at any time: the board saves a page completely
// or not at all, and another run() finishes the work.
//
//            +--- another image of the page, or a lost line before @save ---+
//            v                                                              |
//   waiting (old) --@open, @data, @crc--> sending (old) --@save--> saving (old or new) --OK--> written --@crcs--> verified
//                                                                       |
//                                  the line was lost: checked at the next run()

import type { PageFormat } from '../model/page-format.ts';
import { DATA_BYTES, ERR_UNSAVED, askPageCrcs, askRamCrc, openPage, savePage, sendData } from './page-requests.ts';
import type { Ask } from './page-requests.ts';
import { RobotError } from './robot-error.ts';

export type PageAccount = 'waiting' | 'sending' | 'saving' | 'written' | 'verified';

export interface PageToWrite {
    readonly page: number;
    /** The robot's current page. */
    readonly before: Uint8Array;
    /** Sealed. */
    readonly after: Uint8Array;
}

export interface WriteOptions {
    readonly signal?: AbortSignal;
    /** Called after each change of the account. */
    readonly changed?: () => void;
}

/** A request without an answer is sent again. All of them can safely be repeated. */
const TRIES = 3;

export class PageWrite {
    readonly account: Map<number, PageAccount>;
    private readonly pages: readonly PageToWrite[];
    private readonly format: PageFormat;

    constructor(pages: readonly PageToWrite[], format: PageFormat) {
        this.pages = [...pages].sort((a, b) => a.page - b.page);
        this.account = new Map(this.pages.map(({ page }) => [page, 'waiting']));
        this.format = format;
    }

    get isDone(): boolean {
        return [...this.account.values()].every(state => state === 'verified');
    }

    /** Pages that are certainly in the robot. */
    get written(): PageToWrite[] {
        return this.pages.filter(({ page }) => ['written', 'verified'].includes(this.account.get(page) ?? ''));
    }

    /** Writes the remaining pages, then verifies all of them. Rejects with RobotError: page-changed or page-unsaved before that page is
     *  touched, cancelled between two pages, or an error of the line. Call it again to continue. */
    async run(line: Ask, options: WriteOptions = {}): Promise<void> {
        if (this.pages.length === 0) return;
        const requests = patient(line);
        const set = (page: number, state: PageAccount): void => {
            this.account.set(page, state);
            options.changed?.();
        };
        await this.look(requests, set);
        for (const one of this.pages) {
            if (this.account.get(one.page) !== 'waiting') continue;
            if (options.signal?.aborted) throw new RobotError('cancelled');
            await this.write(requests, one, set);
        }
        await this.verify(requests, set);
    }

    /** Asks which pages are written already. */
    private async look(requests: Ask, set: (page: number, state: PageAccount) => void): Promise<void> {
        const crcs = await this.crcs(requests);
        for (const { page, before, after } of this.pages) {
            const crc = crcs.get(page);
            if (crc === this.format.crc(after)) set(page, 'written');
            else if (crc === this.format.crc(before)) set(page, 'waiting');
            else throw new RobotError('page-changed', String(page));
        }
    }

    private async verify(requests: Ask, set: (page: number, state: PageAccount) => void): Promise<void> {
        const crcs = await this.crcs(requests);
        for (const { page, after } of this.pages) {
            if (crcs.get(page) !== this.format.crc(after)) {
                set(page, 'waiting');
                throw new RobotError('page-not-saved', String(page));
            }
            set(page, 'verified');
        }
    }

    private async crcs(requests: Ask): Promise<Map<number, number>> {
        const first = this.pages[0]?.page ?? 0;
        const last = this.pages.at(-1)?.page ?? first;
        return new Map((await askPageCrcs(requests, first, last)).map((crc, i) => [first + i, crc]));
    }

    private async write(requests: Ask, one: PageToWrite, set: (page: number, state: PageAccount) => void): Promise<void> {
        const { page, after } = one;
        set(page, 'sending');
        await this.open(requests, page);
        const crc = this.format.crc(after);
        const inRam = this.loaded(one);
        for (const offset of differences(inRam, after)) await sendData(requests, offset, piece(after, offset));
        if ((await askRamCrc(requests)) !== crc) {
            for (const offset of everyPiece(after)) await sendData(requests, offset, piece(after, offset));
        }
        set(page, 'saving');
        await savePage(requests, page, crc);
        set(page, 'written');
    }

    private async open(requests: Ask, page: number): Promise<void> {
        try {
            await openPage(requests, page);
        } catch (error) {
            if (!(error instanceof RobotError) || error.number !== ERR_UNSAVED) throw error;
            await this.clean(requests);
            await openPage(requests, page);
        }
    }

    /** Handles unsaved edits in the board's RAM. If they are our own interrupted transfer of one of these pages (a pulled cable), the old
     *  bytes are restored. Anything else is somebody's work. */
    private async clean(requests: Ask): Promise<void> {
        const crc = await askRamCrc(requests);
        for (const one of this.pages) {
            const inRam = this.loaded(one).slice();
            const offsets = differences(inRam, one.after);
            for (const [sent, offset] of offsets.entries()) {
                inRam.set(piece(one.after, offset), offset);
                if (this.format.crc(inRam) !== crc) continue;
                for (const back of offsets.slice(0, sent + 1)) await sendData(requests, back, piece(this.loaded(one), back));
                return;
            }
        }
        throw new RobotError('page-unsaved');
    }

    /** The content of RAM after `@open`: Edit treats erased flash as the empty page. */
    private loaded({ before }: PageToWrite): Uint8Array {
        return this.format.isErased(before) ? this.format.empty : before;
    }
}

function piece(bytes: Uint8Array, offset: number): Uint8Array {
    return bytes.subarray(offset, offset + DATA_BYTES);
}

function everyPiece(bytes: Uint8Array): number[] {
    return Array.from({ length: bytes.length / DATA_BYTES }, (_, i) => i * DATA_BYTES);
}

/** Offsets of the pieces that differ. */
function differences(a: Uint8Array, b: Uint8Array): number[] {
    return everyPiece(b).filter(offset => piece(a, offset).some((byte, i) => byte !== b[offset + i]));
}

function patient(line: Ask): Ask {
    return {
        ask: async (text, options) => {
            for (let tries = 1; ; tries++) {
                try {
                    return await line.ask(text, options);
                } catch (error) {
                    if (tries === TRIES || !(error instanceof RobotError) || error.code !== 'no-answer') throw error;
                }
            }
        },
    };
}
