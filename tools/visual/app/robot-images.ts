// SPDX-License-Identifier: MIT
// The image that the robot in the page runs or that drives your servos. Changing it restarts the robot: flash is kept, RAM is lost.

import type { PageFormat } from '../model/page-format.ts';
import { hasUnsavedEdits } from '../robot/page-requests.ts';
import type { Ask } from '../robot/page-requests.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { SessionState, ImageName, Notice } from '../view/session/session.ts';
import { TEXTS } from '../view/texts/texts.ts';
import type { Store } from '../view/store.ts';
import { imageError } from './image-error.ts';
import type { SimulatedSource } from './simulated-source.ts';
import { until } from './until.ts';

const READY_MS = 180_000;
/** A person who types is not held up by what Edit is asked after each key. */
const TYPING_MS = 1000;

export interface ImageParts {
    readonly state: Store<SessionState>;
    readonly format: PageFormat;
    /** The robot whose image is changed. */
    robot(): Pick<SimulatedSource, 'restart' | 'prepare' | 'connection'>;
    /** Pages are being written, which needs Edit. */
    isWriting(): boolean;
    /** What Edit has in RAM is a page that this page has half sent, and nobody's edits. */
    isHalfSent(requests: Ask): Promise<boolean>;
    say(message: Notice): void;
    fail(error: unknown): void;
}

export class RobotImages {
    private readonly parts: ImageParts;
    /** The robot that leaves Edit. Its answer may not come while another one is used. */
    private leaving: { readonly robot: unknown; readonly done: Promise<void> } | null = null;
    /** Counts changes of the image. The last one counts. */
    private asked = 0;
    private looking: ReturnType<typeof setTimeout> | undefined;

    constructor(parts: ImageParts) {
        this.parts = parts;
    }

    /** For a button press: errors are reported, not thrown. Refused while Edit has unsaved edits. */
    run(image: ImageName): void {
        const { source } = this.state;
        const run = async (): Promise<void> => {
            if (this.edit !== null) await this.mustHaveNoEdits(); // else it restarts at once
            await this.restart(image);
        };
        void run().catch((error: unknown) => source === this.state.source && this.parts.fail(error));
    }

    /** Before a restart of this robot. Rejects with RobotError: page-unsaved, or time-stands if it cannot say so now. A robot that hangs is to
     *  restart. */
    async mustHaveNoEdits(): Promise<void> {
        const { edit } = this;
        const { source, speed } = this.state;
        if (edit === null) return;
        if (source === 'simulated' && speed === 0) throw new RobotError('time-stands');
        if (await this.hasEdits(edit).catch(() => false)) throw new RobotError('page-unsaved');
    }

    /** A key may have edited. */
    typed(): void {
        if (this.edit === null) return;
        this.parts.state.set({ hasEdits: true });
        this.look();
    }

    /** Whether Edit has edits, of which it may have had some. It cannot be asked any more when the page is left. */
    look(): void {
        clearTimeout(this.looking);
        if (this.state.hasEdits) this.looking = setTimeout(() => void this.learnEdits().catch(() => undefined), TYPING_MS);
    }

    private async learnEdits(): Promise<void> {
        const { edit } = this;
        const { source, speed } = this.state;
        if (edit === null || (source === 'simulated' && speed === 0)) return;
        const hasEdits = await this.hasEdits(edit);
        if (edit === this.edit) this.parts.state.set({ hasEdits });
    }

    /** Edit, if it runs and answers. Yours is no robot of this page. */
    private get edit(): Ask | null {
        const { source, connection, version, stopped } = this.state;
        const answers = source !== 'yours' && connection === 'ready' && version?.image === 'edit' && stopped === null;
        return answers ? (this.parts.robot().connection?.requests ?? null) : null;
    }

    /** Only Edit saves pages. The robot restarts with Edit, stands up, and keeps Edit until somebody drives it. */
    async becomeEdit(): Promise<void> {
        const { source } = this.state;
        if (this.state.image !== 'edit') {
            this.tell(TEXTS.robot.startsEdit);
            await this.restart('edit');
        }
        await this.untilReady(source);
        await this.parts.robot().prepare();
    }

    /** Only Play receives a remote control. Resolves when Play runs and the robot is on its feet. Rejects with RobotError. */
    async becomeDriven(): Promise<void> {
        const { source } = this.state;
        if (this.state.image !== 'play') {
            const robot = this.parts.robot();
            if (this.leaving?.robot !== robot) this.leaving = { robot, done: this.leaveEdit() };
            const { leaving } = this;
            await leaving.done.finally(() => {
                if (this.leaving === leaving) this.leaving = null;
            });
        }
        await this.untilReady(source);
        await this.parts.robot().prepare();
    }

    /** Texts on the robot in the page. My servos are said to be looked for. */
    private tell(text: string): void {
        if (this.state.source === 'simulated') this.parts.say({ text, tone: 'calm' });
    }

    private get state(): SessionState {
        return this.parts.state.get();
    }

    /** A remote key must not discard edits: if there are unsaved ones, Edit keeps running, and while the page writes. Rejects with RobotError:
     *  page-unsaved, transfer-busy, or as a request does. */
    private async leaveEdit(): Promise<void> {
        const { source } = this.state;
        if (this.parts.isWriting()) throw new RobotError('transfer-busy');
        if (this.state.stopped === null) {
            // a stopped robot has no edits in RAM to lose
            await this.untilReady(source);
            if (this.state.image === 'play') return; // changed meanwhile
            const { connection } = this.parts.robot();
            if (!connection) throw new RobotError('not-connected');
            if (await this.hasEdits(connection.requests)) throw new RobotError('page-unsaved');
            if (source !== this.state.source) throw new RobotError('cancelled');
        }
        this.tell(TEXTS.robot.startsPlay);
        await this.restart('play');
    }

    /** Unsaved edits that somebody has made. */
    private async hasEdits(requests: Ask): Promise<boolean> {
        return (await hasUnsavedEdits(requests, this.parts.format)) && !(await this.parts.isHalfSent(requests));
    }

    /** Rejects with RobotError if the image cannot be had. The robot then keeps running as before. By then another one may be used. */
    private async restart(image: ImageName): Promise<void> {
        const { state, robot } = this.parts;
        const { source, image: before } = state.get();
        const mine = ++this.asked;
        state.set({ image });
        try {
            await robot().restart(image);
            if (source === state.get().source) state.set({ hasEdits: false });
        } catch (cause) {
            const { version } = state.get();
            const runs = version?.image === 'play' || version?.image === 'edit' ? version.image : before;
            if (mine === this.asked && source === state.get().source) state.set({ image: runs });
            throw imageError(cause);
        }
    }

    /** used: the robot that is waited for. Rejects if another one is chosen. */
    private untilReady(used: SessionState['source']): Promise<void> {
        const look = ({ source, connection, version, image, physics, stopped }: SessionState): boolean => {
            if (source !== used) throw new RobotError('cancelled');
            if (stopped !== null) throw new RobotError('no-answer');
            return connection === 'ready' && version?.image === image && (source !== 'simulated' || physics !== 'loading');
        };
        return until(this.parts.state, look, READY_MS);
    }
}
