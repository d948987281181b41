// SPDX-License-Identifier: MIT
// What the page does when a robot answers. It asks for the robot's pages, stands the robot in the page up, and backs up your robot.

import { PAGE_COUNT } from '../model/motion.ts';
import type { ConnectionState } from '../robot/connection-table.ts';
import { askPageCrcs } from '../robot/page-requests.ts';
import { askList, askPose } from '../robot/protocol.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { SessionState } from '../view/session/session.ts';
import type { Store } from '../view/store.ts';
import { ranges } from '../view/texts/robot.ts';
import { TEXTS } from '../view/texts/texts.ts';
import type { DocumentEditor } from './editor.ts';
import type { RobotSources } from './sources.ts';
import type { Status } from './status.ts';
import type { StatusMessages } from './status-messages.ts';
import type { RobotTransfer } from './transfer.ts';

/** Why your robot was not read: the person knows, or the connection says it. */
const UNTOLD: readonly RobotError['code'][] = ['cancelled', 'port-lost', 'not-connected', 'transfer-busy'];

export interface ArrivalParts {
    readonly state: Store<SessionState>;
    readonly messages: StatusMessages;
    readonly status: Status;
    readonly sources: RobotSources;
    readonly editor: DocumentEditor;
    readonly transfer: RobotTransfer;
}

export class Arrival {
    private readonly parts: ArrivalParts;

    constructor(parts: ArrivalParts) {
        this.parts = parts;
    }

    connectionChanged(connection: ConnectionState): void {
        const { state, messages, status, sources, editor } = this.parts;
        const { version, name, error } = sources.connection;
        const isOff = sources.isSimulated && !state.get().isPowered;
        const pages = sources.isSimulated ? state.get().pages : []; // a cable may lead to another robot now, which has others
        state.set({
            connection,
            version: isOff ? null : version,
            portName: name,
            where: null,
            pages,
            isPortBusy: error?.code === 'port-busy',
        });
        status.tell();
        status.look();
        if (connection === 'other-board') messages.fail(error);
        if (connection !== 'ready') return;
        this.askPages();
        this.standUp();
        void status.ask();
        if (sources.isSimulated) return;
        if (editor.state.get().robot.length === 0) void this.learnYours();
        else void this.lookAgain().catch((error: unknown) => this.isUntold(error) || messages.fail(error));
    }

    askPages(): void {
        const { state, sources } = this.parts;
        const isExact = state.get().source !== 'yours';
        void askList(sources.connection.requests, isExact).then(pages => state.set({ pages }), this.fail);
    }

    /** The robot in the page stands up by itself once it answers and has a body, whichever comes last. */
    standUp(): void {
        const { state, sources } = this.parts;
        const { connection, version } = state.get();
        if (sources.isSimulated && connection === 'ready' && version?.image === 'play') void sources.simulated.prepare().catch(this.fail);
    }

    /** The connection state already shows that a robot was lost or restarted. It is asked again when it answers. */
    private readonly fail = (error: unknown): void => {
        const isRestart = error instanceof RobotError && (error.code === 'not-connected' || error.code === 'cancelled');
        if (!isRestart) this.parts.messages.fail(error);
    };

    /** The cable may lead to another board now, or somebody has saved pages in this one. What was read or compared then counts no more. A
     *  write that was cut off is left to the person, who continues it, unless this board has other pages. */
    private async lookAgain(): Promise<void> {
        const { sources, editor, transfer } = this.parts;
        const isExpected = (crcs: readonly number[]): boolean =>
            editor.state.get().robot.every((bytes, page) => bytes === null || editor.format.crc(bytes) === crcs[page]) ||
            (transfer.state.get().phase === 'stopped' && transfer.continuesWith(crcs));
        const crcs = await askPageCrcs(sources.connection.requests, 0, PAGE_COUNT - 1, { isExpected });
        const { phase } = transfer.state.get();
        if (isExpected(crcs) || phase === 'reading' || phase === 'writing') return;
        transfer.leave();
        editor.setRobot([]);
        await this.learnYours();
    }

    /** Reads your robot's pages and keeps them as a backup once the robot is known, without asking the person. */
    private async learnYours(): Promise<void> {
        const { state, messages, editor, transfer } = this.parts;
        const end = await transfer.read();
        if (!end.isDone) return this.isUntold(end.error) ? undefined : messages.fail(end.error);
        const pages = editor.state.get().robot.filter(bytes => bytes !== null);
        try {
            await transfer.keep(pages);
        } catch (error) {
            return messages.fail(error);
        }
        if (state.get().source === 'servos') return this.tellServos().catch(messages.fail);
        messages.tell({ text: TEXTS.robot.isBackedUp, tone: 'calm' });
    }

    private isUntold(error: unknown): boolean {
        return error instanceof RobotError && UNTOLD.includes(error.code);
    }

    /** Reports which servos answer and which IDs up to the highest one are missing. */
    private async tellServos(): Promise<void> {
        const { messages, sources } = this.parts;
        const ids = (await askPose(sources.connection.requests)).map(({ id }) => id);
        if (ids.length === 0) return messages.tell({ text: TEXTS.robot.noServos, tone: 'bad' });
        const missing = Array.from({ length: Math.max(...ids) }, (_, i) => i + 1).filter(id => !ids.includes(id));
        messages.tell({ text: TEXTS.robot.servosFound(ids.length, ranges(missing)), tone: missing.length > 0 ? 'bad' : 'good' });
    }
}
