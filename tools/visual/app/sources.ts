// SPDX-License-Identifier: MIT
// Which robot stands on the desk: the one in the page, or yours. The other one waits.

import type { Body } from '../model/body.ts';
import { documentFrom } from '../model/document.ts';
import type { Connection } from '../robot/connection.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { DeskState } from '../view/desk.ts';
import type { Store } from '../view/store.ts';
import type { DocumentEditor } from './editor.ts';
import { SimulatedSource } from './simulated-source.ts';
import type { SourceEvents } from './simulated-source.ts';
import { YourSource } from './your-source.ts';

export interface SourcesParts {
    readonly state: Store<DeskState>;
    readonly editor: DocumentEditor;
    readonly events: Omit<SourceEvents, 'motions'>;
    /** Whether the page may ask a robot something by itself. */
    mayAsk(): boolean;
    fail(error: unknown): void;
}

export class RobotSources {
    readonly simulated: SimulatedSource;
    private readonly parts: SourcesParts;
    private readonly yours: YourSource;
    /** What the robot in the page has in its flash. */
    private inPage: readonly Uint8Array[] = [];

    constructor(body: Body, parts: SourcesParts) {
        this.parts = parts;
        const events = { ...parts.events, motions: (image: Uint8Array) => this.simulatedMotions(image) };
        this.simulated = new SimulatedSource(body, events);
        this.yours = new YourSource(body, events, parts.mayAsk);
    }

    get isSimulated(): boolean {
        return this.parts.state.get().source === 'simulated';
    }

    /** To the robot on the desk. Throws RobotError not-connected when there is none. */
    get connection(): Connection {
        const connection = this.isSimulated ? this.simulated.connection : this.yours.connection;
        if (!connection) throw new RobotError('not-connected');
        return connection;
    }

    useSimulated(): void {
        if (this.isSimulated) return;
        this.parts.state.set({ source: 'simulated' });
        void this.yours.close();
        this.simulated.resume();
        this.parts.editor.setRobot(this.inPage);
    }

    async connectYours(): Promise<void> {
        try {
            if (!(await this.yours.choose())) return; // the chooser was closed: no error
        } catch (error) {
            return this.parts.fail(error);
        }
        this.simulated.pause();
        this.parts.state.set({ source: 'yours', version: null, where: null, pages: [] });
        this.parts.editor.setRobot([]);
        this.yours.connect();
    }

    private simulatedMotions(image: Uint8Array): void {
        this.inPage = documentFrom(image, '').pages;
        if (this.isSimulated) this.parts.editor.setRobot(this.inPage);
    }
}
