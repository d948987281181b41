// SPDX-License-Identifier: MIT
// What a robot is asked to play: a page as it has it, the page that is edited, and what goes on beside a play. What is not done
// rejects with RobotError.

import { pageOf } from '../model/document.ts';
import type { Shape } from '../model/motion.ts';
import type { Connection } from '../robot/connection.ts';
import { askPageCrcs } from '../robot/page-requests.ts';
import { aim, askList, free, play, setAmplitude, setBlend, setLayer, setRate, swing } from '../robot/protocol.ts';
import type { Requests } from '../robot/requests.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { Overlay, SessionState } from '../view/session/session.ts';
import type { Store } from '../view/store.ts';
import type { DocumentEditor } from './editor.ts';
import type { RobotTransfer } from './transfer.ts';

export interface PlayParts {
    readonly state: Store<SessionState>;
    readonly editor: DocumentEditor;
    readonly transfer: RobotTransfer;
    /** Throws RobotError not-connected when there is none. */
    connection(): Connection;
    /** Before a motion: the robot in the page gets to its feet. */
    prepare(): Promise<void>;
}

export class RobotPlays {
    private readonly parts: PlayParts;
    /** Counts what was asked for and taken back. */
    private asked = 0;

    constructor(parts: PlayParts) {
        this.parts = parts;
    }

    /** A page as the robot has it. */
    async play(page: number): Promise<void> {
        const mine = this.asked;
        await this.parts.prepare();
        if (mine !== this.asked) throw new RobotError('cancelled');
        await play(this.requests, page);
    }

    /** A page as the document has it. */
    async playEdited(page: number): Promise<void> {
        const { format, state } = this.parts.editor;
        const mine = ++this.asked;
        await this.bringPages(format.reach(state.get().document, page));
        await this.parts.prepare();
        if (mine !== this.asked) throw new RobotError('cancelled');
        await play(this.requests, page);
    }

    /** What has been asked to play, and still waits, does not play any more. */
    cancel(): void {
        this.asked++;
    }

    async shape({ rate, amplitude, blend }: Shape): Promise<void> {
        const { requests } = this;
        await setRate(requests, rate);
        await setAmplitude(requests, amplitude);
        await setBlend(requests, blend);
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

    /** Makes sure that the robot has these pages as the document has them. The robot in the page gets them; what will change in
     *  yours is to be seen before. */
    private async bringPages(pages: readonly number[]): Promise<void> {
        const { editor, transfer, state } = this.parts;
        const differing = await this.differing(pages);
        if (differing.length === 0) return;
        if (!this.isSimulated) throw new RobotError('pages-differ');
        const { document } = editor.state.get();
        const damaged = differing.find(page => editor.format.fault(pageOf(document, page)) !== null);
        if (damaged !== undefined) throw new RobotError('damaged-here', String(damaged)); // it would not be written
        const end = await transfer.write(pages);
        if (!end.isDone) throw end.error;
        state.set({ pages: await askList(this.requests) });
    }

    /** A layer is what the robot has in its flash: one that differs is not played. */
    private async layer(page: number | null, joints: readonly number[]): Promise<void> {
        const { format, state } = this.parts.editor;
        if (page !== null && (await this.differing(format.reach(state.get().document, page))).length > 0)
            throw new RobotError('layer-differs');
        await setLayer(this.requests, page, joints);
    }

    /** Pages that the robot has otherwise than the document. The robot is asked: what was read of it may be old, or not read yet. */
    private async differing(pages: readonly number[]): Promise<number[]> {
        if (pages.length === 0) return [];
        const { format, state } = this.parts.editor;
        const first = Math.min(...pages);
        const crcs = await askPageCrcs(this.requests, first, Math.max(...pages));
        const { document } = state.get();
        return pages.filter(page => {
            const bytes = pageOf(document, page);
            const same = format.isEmpty(bytes) ? [format.empty, format.erased] : [bytes];
            return !same.some(one => format.crc(one) === crcs[page - first]);
        });
    }

    private get isSimulated(): boolean {
        return this.parts.state.get().source === 'simulated';
    }

    private get requests(): Requests {
        return this.parts.connection().requests;
    }
}
