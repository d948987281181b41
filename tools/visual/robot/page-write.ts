// SPDX-License-Identifier: MIT
// Writes pages into a robot that runs Edit and tracks each of them. The cable may be pulled at any time: the board saves a page completely
// or not at all, and another run() finishes the work.
//
//            +--- another image of the page, or a lost line before @save ---+
//            v                                                              |
//   waiting (old) --@open, @data, @crc--> sending (old) --@save--> saving (old or new) --OK--> written --@crcs--> verified
//                                                                       |
//                |                 the line was lost: checked at the next run()
//                +--ERR 11--> refused (old)         a written page that is the old one when all are verified is lost (old)
//                +--ERR 11, tried again at the next start--> lost (half new; from now on that is the old one)
//
// The pages behind one that is refused or lost are written all the same. The next run() tries it once more. Behind one that is half saved
// the board takes no other until it is restarted: run() ends there, and the next one writes the others first.

import type { PageFormat } from '../model/page-format.ts';
import { HalfSent, isOpened, isSame } from './half-sent.ts';
import type { SentPage } from './half-sent.ts';
import { ERR_CRC, askPageCrcs, askRamCrc, openPage, savePage } from './page-requests.ts';
import type { Ask } from './page-requests.ts';
import { askPage } from './protocol.ts';
import { RobotError } from './robot-error.ts';

export type PageAccount = 'waiting' | 'sending' | 'saving' | 'written' | 'verified' | 'refused' | 'lost';

/** before: the robot's current page. */
export type PageToWrite = SentPage;

export interface WriteOptions {
    readonly signal?: AbortSignal;
    /** Called after each change of the account. */
    readonly changed?: () => void;
    /** Edit's RAM had this page of an earlier write, half sent. It has the page of flash again. */
    readonly putBack?: (page: number) => void;
}

const TRIES = 3;

export class PageWrite {
    readonly account: Map<number, PageAccount>;
    private pages: readonly PageToWrite[];
    private readonly format: PageFormat;
    private readonly sent: HalfSent;
    /** Pages that the board has half saved. */
    private readonly half = new Set<number>();

    /** sent: of this write and those before it. */
    constructor(pages: readonly PageToWrite[], format: PageFormat, sent: HalfSent = new HalfSent(format)) {
        this.pages = [...pages].sort((a, b) => a.page - b.page);
        this.account = new Map(this.pages.map(({ page }) => [page, 'waiting']));
        this.format = format;
        this.sent = sent;
    }

    get isDone(): boolean {
        return [...this.account.values()].every(state => state === 'verified');
    }

    /** The robot's pages, by number, of those that are certainly in it and those that it has half saved. */
    get known(): Map<number, Uint8Array> {
        const isWritten = (page: number): boolean => ['written', 'verified'].includes(this.account.get(page) ?? '');
        const known = this.pages.filter(({ page }) => isWritten(page) || this.half.has(page));
        return new Map(known.map(({ page, before, after }) => [page, isWritten(page) ? after : before]));
    }

    /** Writes the remaining pages, then verifies all of them. Rejects with RobotError: page-changed, page-unsaved or page-mixed before
     *  that page is touched, cancelled between two pages, or an error of the line; save-failed, pages-refused or page-not-saved when all
     *  others are written, save-pending when they wait for a restart of the board. Call it again to continue. */
    async run(line: Ask, options: WriteOptions = {}): Promise<void> {
        if (this.pages.length === 0) return;
        const requests = patient(line);
        const set = (page: number, state: PageAccount): void => {
            this.account.set(page, state);
            options.changed?.();
        };
        await this.look(requests, set);
        let last: number | null = null;
        for (const one of [...this.pages].sort((a, b) => Number(this.half.has(a.page)) - Number(this.half.has(b.page)))) {
            if (this.account.get(one.page) !== 'waiting') continue;
            if (options.signal?.aborted) throw new RobotError('cancelled');
            if (await this.write(requests, one, set, options)) continue;
            last = one.page;
            break;
        }
        await this.verify(requests, set);
        if (last !== null) throw new RobotError('save-pending', this.numbers('lost').join(', ') || String(last));
        this.mustBeDone();
    }

    /** Throws the reason why pages are not written, with their numbers. */
    private mustBeDone(): void {
        const [refused, lost] = [this.numbers('refused'), this.numbers('lost')];
        if (refused.length === this.pages.length) throw new RobotError('save-failed');
        if (refused.length > 0) throw new RobotError('pages-refused', [...refused, ...lost].sort((a, b) => a - b).join(', '));
        if (lost.length > 0) throw new RobotError('page-not-saved', lost.join(', '));
    }

    private numbers(state: PageAccount): number[] {
        return this.pages.filter(({ page }) => this.account.get(page) === state).map(({ page }) => page);
    }

    /** Asks which pages are written already. */
    private async look(requests: Ask, set: (page: number, state: PageAccount) => void): Promise<void> {
        const crcs = await this.crcs(requests, ({ before, after }) => [before, after]);
        for (const { page, before, after } of this.pages) {
            const crc = crcs.get(page);
            if (crc === this.format.crc(after)) {
                this.sent.end({ page, before, after }); // it was in flash before its cable was pulled
                set(page, 'written');
            } else if (crc === this.format.crc(before)) set(page, 'waiting');
            else throw new RobotError('page-changed', String(page));
        }
    }

    private async verify(requests: Ask, set: (page: number, state: PageAccount) => void): Promise<void> {
        const crcs = await this.crcs(requests, ({ after }) => [after]);
        for (const { page, after } of this.pages) {
            if (crcs.get(page) === this.format.crc(after)) set(page, 'verified');
            else if (this.account.get(page) === 'written' || this.half.has(page)) set(page, 'lost');
        }
    }

    /** By page. expected: what each of ours may be. */
    private async crcs(requests: Ask, expected: (one: PageToWrite) => readonly Uint8Array[]): Promise<Map<number, number>> {
        const first = this.pages[0]?.page ?? 0;
        const last = this.pages.at(-1)?.page ?? first;
        const isExpected = (crcs: readonly number[]): boolean =>
            this.pages.every(one => expected(one).some(bytes => this.format.crc(bytes) === crcs[one.page - first]));
        return new Map((await askPageCrcs(requests, first, last, { isExpected })).map((crc, i) => [first + i, crc]));
    }

    /** false: the board takes no other page until it is restarted. */
    private async write(
        requests: Ask,
        one: PageToWrite,
        set: (page: number, state: PageAccount) => void,
        { putBack }: WriteOptions,
    ): Promise<boolean> {
        const { page, after } = one;
        const crc = this.format.crc(after);
        for (let tries = 1; tries <= TRIES; tries++) {
            set(page, 'sending');
            await this.open(requests, page, putBack);
            this.sent.begin(one);
            // Another page in RAM: the board has restarted. So the page is opened and sent once more.
            if (!(await this.sent.fill(requests, this.sent.loaded(one), after)) || (await askRamCrc(requests)) !== crc) continue;
            set(page, 'saving');
            const end = await saved(requests, page, crc);
            if (end === 'restarted' && (await askPageCrcs(requests, page, page))[0] !== crc) continue;
            if (end instanceof RobotError) {
                if (end.words !== '') this.half.add(page);
                await this.empty(requests, one);
                set(page, 'waiting');
                return false;
            }
            // Edit has no edits now, unless it refuses the page, or had a page open that looked the same, since a restart.
            await this.open(requests, page);
            this.sent.end(one);
            set(page, end === 'refused' ? 'refused' : 'written');
            return true;
        }
        throw new RobotError('dropped');
    }

    /** Gives Edit's RAM what flash has of the page now, perhaps half of each, so that no edits are left there. */
    private async empty(requests: Ask, one: PageToWrite): Promise<void> {
        const { page } = one;
        const now = { ...one, before: await askPage(requests, page, bytes => this.format.crc(bytes)) };
        this.pages = this.pages.map(other => (other === one ? now : other));
        this.sent.end(one);
        this.sent.begin(now);
        await this.open(requests, page);
        this.sent.end(now);
    }

    /** Unsaved edits in Edit's RAM are dropped if they are ours: of a transfer that a pulled cable, a restart or a reload has interrupted.
     *  Anything else is somebody's work, perhaps on a page of ours. */
    private async open(requests: Ask, page: number, putBack?: (page: number) => void): Promise<void> {
        if (await isOpened(requests, page)) return;
        const { last } = this.sent;
        const ours = await this.sent.putBack(requests);
        if (!ours) throw last ? new RobotError('page-mixed', String(last.page)) : new RobotError('page-unsaved');
        await openPage(requests, page);
        if (!this.hasSame(ours)) putBack?.(ours.page);
    }

    private hasSame(sent: SentPage): boolean {
        return this.pages.some(one => isSame(one, sent));
    }
}

/** refused: for good. restarted: RAM has another page than a moment ago. RobotError: save-pending. */
async function saved(requests: Ask, page: number, crc: number): Promise<'saved' | 'refused' | 'restarted' | RobotError> {
    try {
        await savePage(requests, page, crc);
        return 'saved';
    } catch (error) {
        if (error instanceof RobotError && error.code === 'save-failed') return 'refused';
        if (error instanceof RobotError && error.code === 'save-pending') return error;
        if (error instanceof RobotError && error.number === ERR_CRC) return 'restarted';
        throw error;
    }
}

/** Sends a request without an answer again. */
function patient(line: Ask): Ask {
    return {
        ask: async (text, options) => {
            for (let tries = 1; ; tries++) {
                try {
                    return await line.ask(text, options);
                } catch (error) {
                    if (tries === TRIES || options?.once || !(error instanceof RobotError) || error.code !== 'no-answer') throw error;
                }
            }
        },
    };
}
