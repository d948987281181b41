// SPDX-License-Identifier: MIT
// Transfers pages between the document and the robot in use. It reads as little as possible, makes a backup before it writes, keeps an
// account of what was written (robot/page-write.ts), and can continue after a pulled cable.
//
//   idle --read--> reading --> idle             idle --write--> writing --> written
//                     |                                            |  ^
//                     +--trouble--> stopped <------trouble---------+  |
//                                      +-------------tryAgain---------+

import { pageOf } from '../model/document.ts';
import type { MotionDocument } from '../model/document.ts';
import type { PageFormat } from '../model/page-format.ts';
import { readPages } from '../robot/page-read.ts';
import { PageWrite } from '../robot/page-write.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { Requests } from '../robot/requests.ts';
import { errorText } from '../view/texts/robot.ts';
import type { Transfer, TransferEnd, TransferState } from '../view/session/transfer.ts';
import { Store } from '../view/store.ts';

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
}

const BUSY: TransferEnd = { isDone: false, error: new RobotError('transfer-busy') };
const IDLE: TransferState = { phase: 'idle', done: 0, total: 0, account: new Map(), trouble: null };

export class RobotTransfer implements Transfer {
    readonly state = new Store<TransferState>(IDLE);
    private readonly parts: TransferParts;
    private stop = new AbortController();
    private under: PageWrite | null = null;
    private goesOn: () => Promise<TransferEnd> = () => this.read();

    constructor(parts: TransferParts) {
        this.parts = parts;
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

    read(): Promise<TransferEnd> {
        if (this.isBusy) return Promise.resolve(BUSY);
        this.goesOn = () => this.read();
        return this.during('reading', async () => {
            await this.readRobot();
            this.state.set({ phase: 'idle' });
        });
    }

    write(pages: readonly number[]): Promise<TransferEnd> {
        if (this.isBusy) return Promise.resolve(BUSY);
        const document = this.parts.document();
        this.under = null;
        this.goesOn = () =>
            this.during('writing', async () => {
                await this.orStopped(this.parts.becomeEdit());
                this.under ??= await this.begin(document, pages);
                await this.run(this.under);
                this.state.set({ phase: 'written' });
            });
        return this.goesOn();
    }

    tryAgain(): Promise<TransferEnd> {
        return this.isBusy ? Promise.resolve(BUSY) : this.goesOn();
    }

    cancel(): void {
        this.stop.abort();
    }

    /** Edit takes time to start. Cancelling does not wait for it. */
    private orStopped(action: Promise<void>): Promise<void> {
        const { signal } = this.stop;
        const stopped = new Promise<never>((_, reject) =>
            signal.addEventListener('abort', () => reject(new RobotError('cancelled')), { once: true }),
        );
        return Promise.race([action, stopped]);
    }

    private async begin(document: MotionDocument, pages: readonly number[]): Promise<PageWrite> {
        const robot = await this.readRobot();
        await this.parts.backUp(robot);
        const wanted = pages.flatMap(page => {
            const [before, after] = [robot[page], pageOf(document, page)];
            return before && !this.parts.format.isSame(before, after) && this.parts.format.fault(after) === null
                ? [{ page, before, after }]
                : [];
        });
        return new PageWrite(wanted, this.parts.format);
    }

    /** Records the written pages as the robot's, even if the rest failed. */
    private async run(write: PageWrite): Promise<void> {
        const changed = (): void => {
            const done = [...write.account.values()].filter(account => account === 'written' || account === 'verified').length;
            this.state.set({ account: new Map(write.account), done, total: write.account.size });
        };
        try {
            changed();
            await write.run(this.parts.requests(), { signal: this.stop.signal, changed });
        } finally {
            const written = new Map(write.written.map(({ page, after }) => [page, after]));
            this.parts.setRobot(this.parts.robot().map((bytes, page) => written.get(page) ?? bytes) as Uint8Array[]);
        }
    }

    private async readRobot(): Promise<Uint8Array[]> {
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
            progress: (done, total) => this.state.set({ done, total }),
        });
        this.parts.setRobot(pages);
        return pages;
    }

    private async during(phase: 'reading' | 'writing', action: () => Promise<void>): Promise<TransferEnd> {
        this.stop = new AbortController();
        this.state.set({ phase, trouble: null, done: 0, total: 0, account: phase === 'reading' ? new Map() : this.state.get().account });
        try {
            await action();
            return { isDone: true };
        } catch (error) {
            if (!(error instanceof RobotError)) this.state.set({ phase: 'stopped', trouble: String(error) });
            if (!(error instanceof RobotError)) throw error;
            this.state.set({ phase: 'stopped', trouble: errorText(error) });
            return { isDone: false, error };
        }
    }
}
