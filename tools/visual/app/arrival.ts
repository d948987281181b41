// SPDX-License-Identifier: MIT
// What the page does by itself when a robot answers: it asks for its pages; the robot in the page stands up; what yours has is kept.

import type { ConnectionState } from '../robot/connection-table.ts';
import { askList } from '../robot/protocol.ts';
import type { DeskState } from '../view/desk.ts';
import type { Store } from '../view/store.ts';
import { TEXTS } from '../view/texts.ts';
import type { DocumentEditor } from './editor.ts';
import type { RobotSources } from './sources.ts';
import type { Status } from './status.ts';
import type { Strip } from './strip.ts';
import type { RobotTransfer } from './transfer.ts';

export interface ArrivalParts {
    readonly state: Store<DeskState>;
    readonly strip: Strip;
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
        const { state, strip, status, sources, editor } = this.parts;
        const { version, name, error } = sources.connection;
        state.set({ connection, version, portName: name, where: null });
        status.tell();
        status.look();
        if (connection === 'other-board') strip.fail(error);
        if (connection !== 'ready') return;
        void askList(sources.connection.requests).then(pages => state.set({ pages }), strip.fail);
        this.standUp();
        void status.ask();
        if (!sources.isSimulated && editor.state.get().robot.length === 0) void this.learnYours();
    }

    /** The robot in the page stands up by itself as soon as it answers and has a body, whichever comes last. */
    standUp(): void {
        const { state, strip, sources } = this.parts;
        const { connection, version } = state.get();
        if (sources.isSimulated && connection === 'ready' && version?.image === 'play') void sources.simulated.prepare().catch(strip.fail);
    }

    /** Reads what your robot has and keeps it, as soon as it is known; no question is asked for it. */
    private async learnYours(): Promise<void> {
        const { strip, editor, transfer } = this.parts;
        if (!(await transfer.read()).isDone) return;
        const pages = editor.state.get().robot.filter(bytes => bytes !== null);
        await transfer.keep(pages).catch(strip.fail);
        strip.say({ text: TEXTS.robotKept, tone: 'calm' });
    }
}
