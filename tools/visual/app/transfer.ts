// SPDX-License-Identifier: MIT
// Transfers pages between the document and the robot in use. It reads as little as possible, makes a backup before it writes, keeps an
// account of what was written (robot/page-write.ts), and can continue after a pulled cable.
//
//   idle --read--> reading --> idle             idle --write--> writing --> written
//                     |                                            |  ^
//                     +--trouble--> stopped <------trouble---------+  |
//                                      +-------------tryAgain---------+

import { firstDifferent, pageOf } from '../model/document.ts';
import type { MotionDocument } from '../model/document.ts';
import { PAGE_COUNT } from '../model/motion.ts';
import type { PageFormat } from '../model/page-format.ts';
import { HalfSent } from '../robot/half-sent.ts';
import type { KeptPages } from '../robot/half-sent.ts';
import { readPages } from '../robot/page-read.ts';
import { askPageCrcs, hasUnsavedEdits } from '../robot/page-requests.ts';
import type { Ask } from '../robot/page-requests.ts';
import { PageWrite } from '../robot/page-write.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { Requests } from '../robot/requests.ts';
import { errorText } from '../view/texts/robot.ts';
import type { Transfer, TransferEnd, TransferState } from '../view/session/transfer.ts';
import { Store } from '../view/store.ts';
import { orAborted } from './aborted.ts';

export interface TransferParts {
    readonly format: PageFormat;
    document(): MotionDocument;
    /** The known content of the robot's pages; null: not read. */
    robot(): readonly (Uint8Array | null)[];
    setRobot(pages: readonly Uint8Array[]): void;
    /** Of the open line. Throws RobotError. */
    requests(): Requests;
    /** Makes sure that Edit runs, the only image that saves pages. Rejects with RobotError. */
    becomeEdit(): Promise<void>;
    backUp(pages: readonly Uint8Array[]): Promise<void>;
    /** Pages that were sent and perhaps not saved, also before a reload. */
    readonly sent?: KeptPages;
}

interface Begun {
    readonly write: PageWrite;
    /** Of each page the CRCs that it may have: as in the backup, and as written. */
    readonly crcs: readonly (readonly number[])[];
}

const BUSY: TransferEnd = { isDone: false, error: new RobotError('transfer-busy') };
const IDLE: TransferState = { phase: 'idle', done: 0, total: 0, account: new Map(), trouble: null, putBack: null };

export class RobotTransfer implements Transfer {
    readonly state = new Store<TransferState>(IDLE);
    private readonly parts: TransferParts;
    private readonly sent: HalfSent;
    private stop = new AbortController();
    /** Aborted when another robot is used. Each transfer holds the signal of the robot that it began with. */
    private robot = new AbortController();
    private under: Begun | null = null;
    private reading = Promise.resolve(BUSY);
    private goesOn: () => Promise<TransferEnd> = () => this.read();

    constructor(parts: TransferParts) {
        this.parts = parts;
        this.sent = new HalfSent(parts.format, parts.sent);
    }

    /** Whether what Edit has in RAM is a page that was half sent, and nobody's edits. */
    async isHalfSent(requests: Ask): Promise<boolean> {
        return (await this.sent.find(requests)) !== null;
    }

    /** Before Edit plays a page: it plays the open one from RAM. A page that was half sent there is put back, or a motion would play that
     *  nobody has made. Rejects with RobotError: transfer-busy, page-mixed if it is this page and somebody has perhaps edited it, or as a
     *  request does. */
    async dropHalfSent(requests: Ask, page: number): Promise<void> {
        if (this.isWriting) throw new RobotError('transfer-busy');
        const { last } = this.sent;
        if (last === null || !(await hasUnsavedEdits(requests, this.parts.format)) || (await this.sent.putBack(requests))) return;
        if (last.page === page) throw new RobotError('page-mixed', String(page));
    }

    get isWriting(): boolean {
        return this.state.get().phase === 'writing';
    }

    /** Stores pages as a backup of the robot in use. Rejects with RobotError. */
    keep(pages: readonly Uint8Array[]): Promise<void> {
        return this.parts.backUp(pages);
    }

    private get isBusy(): boolean {
        const { phase } = this.state.get();
        return phase === 'reading' || phase === 'writing';
    }

    /** Who asks while the pages are being read gets the same ones. */
    read(): Promise<TransferEnd> {
        if (this.state.get().phase === 'reading') return this.reading;
        if (this.isBusy) return Promise.resolve(BUSY);
        this.goesOn = () => this.read();
        this.reading = this.during('reading', async left => {
            await this.readRobot(left, (done, total) => this.tell(left, { done, total }));
            this.tell(left, { phase: 'idle' });
        });
        return this.reading;
    }

    write(pages: readonly number[], seen: readonly (Uint8Array | null)[] = [], shown = this.parts.document()): Promise<TransferEnd> {
        if (this.isBusy) return Promise.resolve(BUSY);
        this.under = null;
        const go = (): Promise<TransferEnd> =>
            this.during('writing', async left => {
                await this.orStopped(this.parts.becomeEdit());
                const under = (await this.stopped(left)) ?? (await this.begin(shown, pages, seen, left));
                left.throwIfAborted();
                this.under = under;
                await this.run(under.write, left);
                this.tell(left, { phase: 'written' });
            });
        // Of a document that has changed meanwhile, the list of what is to be written is another one.
        const { parts } = this;
        this.goesOn = () => (firstDifferent(parts.format, pages, shown, parts.document()) === undefined ? go() : this.read());
        return go();
    }

    tryAgain(): Promise<TransferEnd> {
        return this.isBusy ? Promise.resolve(BUSY) : this.goesOn();
    }

    cancel(): void {
        this.stop.abort(new RobotError('cancelled'));
    }

    /** Another robot is used from now on. A transfer with the one before ends and cannot be continued, or its pages would be written into
     *  the next robot. */
    leave(): void {
        this.robot.abort(new RobotError('cancelled'));
        this.robot = new AbortController();
        this.stop.abort(new RobotError('cancelled'));
        this.under = null;
        this.goesOn = () => this.read();
        this.state.set(IDLE);
    }

    /** Edit takes time to start. Cancelling does not wait for it. */
    private orStopped(action: Promise<void>): Promise<void> {
        return orAborted(action, this.stop.signal);
    }

    private tell(left: AbortSignal, change: Partial<TransferState>): void {
        if (!left.aborted) this.state.set(change);
    }

    /** The write that was stopped; null: none, or it does not continue with the robot on the cable. */
    private async stopped(left: AbortSignal): Promise<Begun | null> {
        if (!this.under) return null;
        const crcs = await askPageCrcs(this.parts.requests(), 0, PAGE_COUNT - 1, {
            signal: this.stop.signal,
            isExpected: crcs => this.continuesWith(crcs),
        });
        left.throwIfAborted();
        if (!this.continuesWith(crcs)) this.under = null;
        return this.under;
    }

    /** crcs: of the robot's pages now. false: no write was cut off, or the cable leads to another robot by now, or somebody has saved pages
     *  in this one. The backup and what was compared are then not of these pages. */
    continuesWith(crcs: readonly number[]): boolean {
        const { under } = this;
        if (under === null) return false;
        const now = new Map(Array.from(under.write.known, ([page, bytes]) => [page, this.parts.format.crc(bytes)])); // perhaps half saved
        return crcs.every((crc, page) => crc === now.get(page) || under.crcs[page]?.includes(crc));
    }

    private async begin(
        document: MotionDocument,
        pages: readonly number[],
        seen: readonly (Uint8Array | null)[],
        left: AbortSignal,
    ): Promise<Begun> {
        const { format, backUp } = this.parts;
        this.tell(left, { account: new Map() });
        const robot = await this.readRobot(left);
        await backUp(robot);
        const wanted = pages.flatMap(page => {
            const [before, after] = [robot[page], format.forRobot(pageOf(document, page))];
            return before && !format.isSame(before, after) && format.fault(after) === null ? [{ page, before, after }] : [];
        });
        const changed = wanted.find(({ page, before }) => !format.isSame(seen[page] ?? before, before));
        if (changed) throw new RobotError('page-changed', String(changed.page));
        const crcs = robot.map((bytes, page) => {
            const written = wanted.find(one => one.page === page)?.after ?? bytes;
            return [format.crc(bytes), format.crc(written)];
        });
        return { write: new PageWrite(wanted, format, this.sent), crcs };
    }

    /** Records the written pages and the half saved ones as the robot's, even if the rest failed. */
    private async run(write: PageWrite, left: AbortSignal): Promise<void> {
        const changed = (): void => {
            const done = [...write.account.values()].filter(account => account === 'written' || account === 'verified').length;
            this.tell(left, { account: new Map(write.account), done, total: write.account.size });
        };
        const putBack = (page: number): void => this.tell(left, { putBack: page });
        try {
            changed();
            await write.run(this.parts.requests(), { signal: this.stop.signal, changed, putBack });
        } finally {
            const { known } = write;
            if (!left.aborted) this.parts.setRobot(this.parts.robot().map((bytes, page) => known.get(page) ?? bytes) as Uint8Array[]);
        }
    }

    /** progress: not before a write, whose `done` are pages written. */
    private async readRobot(left: AbortSignal, progress?: (done: number, total: number) => void): Promise<Uint8Array[]> {
        left.throwIfAborted();
        const { format } = this.parts;
        const document = this.parts.document();
        const known = this.parts.robot();
        const candidates = (page: number): Uint8Array[] => [
            known[page] ?? format.empty,
            pageOf(document, page),
            format.empty,
            format.erased,
        ];
        const pages = await readPages(this.parts.requests(), bytes => format.crc(bytes), {
            known: candidates,
            signal: this.stop.signal,
            ...(progress && { progress }),
        });
        left.throwIfAborted();
        this.parts.setRobot(pages);
        return pages;
    }

    private async during(phase: 'reading' | 'writing', action: (left: AbortSignal) => Promise<void>): Promise<TransferEnd> {
        const left = this.robot.signal;
        this.stop = new AbortController();
        const account = phase === 'reading' ? IDLE.account : this.state.get().account;
        this.state.set({ phase, trouble: null, putBack: null, done: 0, total: 0, account });
        try {
            await orAborted(action(left), left); // a robot in the page that is paused does not answer
            return { isDone: true };
        } catch (error) {
            if (!(error instanceof RobotError)) this.tell(left, { phase: 'stopped', trouble: String(error) });
            if (!(error instanceof RobotError)) throw error;
            this.tell(left, { phase: 'stopped', trouble: errorText(error) });
            return { isDone: false, error };
        }
    }
}
