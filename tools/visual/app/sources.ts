// SPDX-License-Identifier: MIT
// Selects the robot in use: the one in the page, yours, or your servos with a program in the page. The one in the page pauses while another
// is used.

import type { Body } from '../model/body.ts';
import { documentFrom } from '../model/document.ts';
import type { Connection } from '../robot/connection.ts';
import { askWhere, command, isMoving } from '../robot/protocol.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { SessionState } from '../view/session/session.ts';
import type { Store } from '../view/store.ts';
import type { DocumentEditor } from './editor.ts';
import type { MemoryEvents } from './robot-memory.ts';
import { ServosSource } from './servos-source.ts';
import { SimulatedSource } from './simulated-source.ts';
import type { SourceEvents } from './simulated-source.ts';
import { YourSource } from './your-source.ts';

export interface SourcesParts {
    readonly state: Store<SessionState>;
    readonly editor: DocumentEditor;
    readonly events: Omit<SourceEvents, 'motions'> & MemoryEvents;
    /** Whether the page may ask a robot something by itself. */
    mayAsk(): boolean;
    /** Another robot is used from now on. */
    left(): void;
    /** Drops what waits for the servos, because the page is hidden. true: something did. */
    dropHidden(): boolean;
    fail(error: unknown): void;
}

export class RobotSources {
    readonly simulated: SimulatedSource;
    private readonly parts: SourcesParts;
    private readonly yours: YourSource;
    private readonly servos: ServosSource;
    /** The motion pages in the flash of the robot in the page. */
    private inPage: readonly Uint8Array[] = [];
    private wasHidden = false;
    /** Counts choices of a robot. The last one counts, even if an earlier one takes longer. */
    private chosen = 0;

    constructor(body: Body, parts: SourcesParts) {
        this.parts = parts;
        const events = { ...parts.events, motions: (image: Uint8Array) => this.simulatedMotions(image) };
        this.simulated = new SimulatedSource(body, events);
        this.yours = new YourSource(body, events, parts.mayAsk);
        this.servos = new ServosSource(body, events, parts.mayAsk);
        parts.state.watch(({ adapter, where }) => {
            if (adapter === 'back' && isMoving(where)) queueMicrotask(() => parts.state.set({ adapter: null }));
        });
        document.addEventListener('visibilitychange', () => void this.lookHidden().catch(() => undefined)); // a lost robot plays nothing
    }

    get isSimulated(): boolean {
        return this.parts.state.get().source === 'simulated';
    }

    /** The connection to the robot in use. Throws RobotError not-connected if there is none. */
    get connection(): Connection {
        const { connection } = this.current;
        if (!connection) throw new RobotError('not-connected');
        return connection;
    }

    dropText(): void {
        this.current.connection?.dropText();
    }

    useSimulated(): void {
        this.chosen++;
        if (this.isSimulated) return;
        const { source, where } = this.parts.state.get();
        const goesOn = source === 'yours' && isMoving(where);
        this.parts.left();
        this.parts.state.set({ source: 'simulated', adapter: null, image: this.simulated.image });
        void this.yours.close();
        void this.servos.close();
        this.simulated.resume();
        this.parts.editor.setRobot(this.inPage);
        if (goesOn) this.parts.fail(new RobotError('goes-on'));
    }

    async connectYours(): Promise<void> {
        try {
            if (!(await this.yours.choose())) return; // the chooser was closed: no error
        } catch (error) {
            return this.parts.fail(error);
        }
        const mine = ++this.chosen;
        await this.closeLines();
        if (mine !== this.chosen) return;
        this.leave('yours');
        this.yours.connect();
    }

    /** Never rejects. Errors are reported, and then the robot in the page is used. */
    async connectServos(): Promise<void> {
        let mine = 0;
        try {
            if (!(await this.servos.choose())) return; // the chooser was closed: no error
            mine = ++this.chosen;
            await this.closeLines();
            if (mine !== this.chosen) return;
            await this.servos.start('play');
        } catch (error) {
            if (mine === this.chosen) this.useSimulated();
            return this.parts.fail(error);
        }
        if (mine !== this.chosen) return this.servos.close();
        this.leave('servos');
        this.parts.state.set({ image: 'play' });
        this.servos.connect();
    }

    /** The robot whose image this page can change. It cannot change that of yours. */
    get withImages(): SimulatedSource | ServosSource {
        return this.parts.state.get().source === 'servos' ? this.servos : this.simulated;
    }

    private get current(): SimulatedSource | YourSource | ServosSource {
        return this.parts.state.get().source === 'yours' ? this.yours : this.withImages;
    }

    /** A port can only be opened again when it is closed. */
    private async closeLines(): Promise<void> {
        if (!this.isSimulated) this.parts.state.set({ connection: 'closed', version: null, where: null });
        await this.servos.close();
        await this.yours.close();
    }

    private leave(source: 'yours' | 'servos'): void {
        this.parts.left();
        this.simulated.pause();
        this.parts.state.set({ source, version: null, where: null, pages: [], stopped: null, adapter: null });
        this.parts.editor.setRobot([]);
    }

    /** A hidden page gets too little time to drive servos. What plays or moves by code is ended before it stutters, and the person is told
     *  on return, which may be before the program has answered. */
    private async lookHidden(): Promise<void> {
        this.tellHidden();
        if (!document.hidden || this.parts.state.get().source !== 'servos') return;
        if (this.parts.dropHidden()) this.wasHidden = true;
        const { requests } = this.connection;
        const where = await askWhere(requests);
        if (!isMoving(where)) return;
        await command(requests, 'break');
        this.wasHidden = true;
        this.tellHidden();
    }

    private tellHidden(): void {
        if (document.hidden || !this.wasHidden) return;
        this.wasHidden = false;
        this.parts.fail(new RobotError('was-hidden'));
    }

    private simulatedMotions(image: Uint8Array): void {
        this.inPage = documentFrom(image, '').pages;
        if (this.isSimulated) this.parts.editor.setRobot(this.inPage);
    }
}
