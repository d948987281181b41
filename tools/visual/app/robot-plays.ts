// SPDX-License-Identifier: MIT
// Asks a robot to play: a page in its flash, the edited page, and overlays on a play. A request that is not carried out rejects with
// RobotError.

import { pageOf } from '../model/document.ts';
import type { MotionDocument } from '../model/document.ts';
import type { Shape } from '../model/motion.ts';
import type { Connection } from '../robot/connection.ts';
import { askPageCrcs } from '../robot/page-requests.ts';
import { aim, free, play, setAmplitude, setBlend, setLayer, setRate, swing } from '../robot/protocol.ts';
import type { Requests } from '../robot/requests.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { Overlay, SessionState } from '../view/session/session.ts';
import type { Store } from '../view/store.ts';
import { orAborted } from './aborted.ts';
import type { DocumentEditor } from './editor.ts';
import type { RobotTransfer } from './transfer.ts';
import { Turns } from './turns.ts';

export interface PlayParts {
    readonly state: Store<SessionState>;
    readonly editor: DocumentEditor;
    readonly transfer: RobotTransfer;
    /** Throws RobotError not-connected if there is none. */
    connection(): Connection;
    /** Waits while servos are being looked for. Rejects if another robot is used meanwhile. */
    untilFound(): Promise<void>;
    /** Before a motion: gets the robot in the page to its feet. */
    prepare(): Promise<void>;
}

export class RobotPlays {
    private readonly parts: PlayParts;
    /** Counts requests and cancels, so that an outdated request can be recognised. */
    private asked = 0;
    private cancels = 0;
    /** Pages are brought into the robot for one play at a time. */
    private turns = new Turns();
    /** Aborted when what waits is dropped. */
    private dropping = new AbortController();

    constructor(parts: PlayParts) {
        this.parts = parts;
    }

    /** Plays a page as it is in the robot. false: another play was requested meanwhile and takes its place. */
    play(page: number): Promise<boolean> {
        return this.orDropped(this.begin(page, this.next()));
    }

    /** Plays a page as it is in the document. Otherwise like play(). */
    playEdited(page: number): Promise<boolean> {
        const { document } = this.parts.editor.state.get(); // another one may be opened while this play waits
        const isLast = this.next();
        const done = this.turns.run(async () => {
            await this.parts.untilFound();
            if (!isLast()) return false;
            await this.bringPages(page, document);
            return this.begin(page, isLast);
        });
        return this.orDropped(done);
    }

    /** As cancel(), but they reject at once, with this reason: a robot that is off may never answer. */
    drop(why: RobotError): void {
        this.cancel();
        this.dropping.abort(why);
        this.dropping = new AbortController();
    }

    private orDropped(play: Promise<boolean>): Promise<boolean> {
        return orAborted(play, this.dropping.signal);
    }

    /** Cancels requested plays that still wait. */
    cancel(): void {
        this.asked++;
        this.cancels++;
        this.turns = new Turns(); // what is under way may wait for a robot that is paused
    }

    /** A play is requested. The returned function returns false if another one has been requested since. It throws if this one was
     *  cancelled. */
    private next(): () => boolean {
        const { cancels } = this;
        const mine = ++this.asked;
        return () => {
            if (cancels !== this.cancels) throw new RobotError('cancelled');
            return mine === this.asked;
        };
    }

    private async begin(page: number, isLast: () => boolean): Promise<boolean> {
        await this.parts.untilFound();
        await this.parts.prepare();
        const { requests, version } = this.parts.connection();
        if (version?.image === 'edit') await this.parts.transfer.dropHalfSent(requests, page);
        if (!isLast()) return false;
        await play(requests, page);
        return true;
    }

    async shape({ rate, amplitude, blend }: Partial<Shape>): Promise<void> {
        const { requests } = this;
        if (rate !== undefined) await setRate(requests, rate);
        if (amplitude !== undefined) await setAmplitude(requests, amplitude);
        if (blend !== undefined) await setBlend(requests, blend);
    }

    async overlay(what: Overlay): Promise<void> {
        const { requests } = this;
        switch (what.kind) {
            case 'layer':
                await this.layer(what.page, what.joints);
                break;
            case 'aim':
                await aim(requests, what.joint, what.position, what.degreesPerSecond);
                break;
            case 'swing':
                await swing(requests, what.joint, what.centre, what.amplitude, what.periodMs);
                break;
            case 'free':
                await free(requests, what.joints);
                break;
            default:
                what satisfies never;
        }
    }

    /** Makes sure that all that a page reaches is the same in robot and document. The robot in the page is written. Yours is not: its owner
     *  must see the changes first. */
    private async bringPages(page: number, document: MotionDocument): Promise<void> {
        const { editor, transfer } = this.parts;
        const pages = editor.format.reach(document, page);
        const differing = await this.differing(pages, document);
        if (differing.length === 0) return;
        if (!this.isSimulated) throw new RobotError('pages-differ');
        const damaged = differing.find(page => editor.format.fault(pageOf(document, page)) !== null);
        if (damaged !== undefined) throw new RobotError('damaged-here', String(damaged)); // transfer.write() would skip it
        const end = await transfer.write(pages, [], document);
        if (!end.isDone) throw end.error;
    }

    /** A layer plays from the robot's flash, so a page that differs is refused. */
    private async layer(page: number | null, joints: readonly number[]): Promise<void> {
        const { format, state } = this.parts.editor;
        if (page !== null) {
            const mine = this.asked;
            const { document } = state.get();
            if ((await this.differing(format.reach(document, page), document)).length > 0) throw new RobotError('layer-differs');
            if (mine !== this.asked) throw new RobotError('cancelled');
        }
        await setLayer(this.requests, page, joints);
    }

    /** Pages that differ between robot and document. Asks the robot, because what was read of it may be outdated or missing. */
    private async differing(pages: readonly number[], document: MotionDocument): Promise<number[]> {
        if (pages.length === 0) return [];
        const { format } = this.parts.editor;
        const first = Math.min(...pages);
        const differingFrom = (crcs: readonly number[]): number[] =>
            pages.filter(page => {
                const bytes = pageOf(document, page);
                const same = format.isEmpty(bytes) ? [format.empty, format.erased] : [bytes];
                return !same.some(one => format.crc(one) === crcs[page - first]);
            });
        const isExpected = (crcs: readonly number[]): boolean => differingFrom(crcs).length === 0;
        return differingFrom(await askPageCrcs(this.requests, first, Math.max(...pages), { isExpected }));
    }

    private get isSimulated(): boolean {
        return this.parts.state.get().source === 'simulated';
    }

    private get requests(): Requests {
        return this.parts.connection().requests;
    }
}
