// SPDX-License-Identifier: MIT
// Which image the robot in the page runs, or your servos are driven by. Another one starts it anew: what its flash holds stays, what only its
// RAM holds is lost.

import type { PageFormat } from '../model/page-format.ts';
import { hasUnsavedEdits } from '../robot/page-requests.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { SessionState, ImageName, Notice } from '../view/session/session.ts';
import { TEXTS } from '../view/texts/texts.ts';
import type { Store } from '../view/store.ts';
import type { SimulatedSource } from './simulated-source.ts';

const READY_MS = 180_000;

export interface ImageParts {
    readonly state: Store<SessionState>;
    readonly format: PageFormat;
    /** The one whose image is meant. */
    robot(): Pick<SimulatedSource, 'restart' | 'forget' | 'prepare' | 'connection'>;
    say(message: Notice): void;
    fail(error: unknown): void;
}

export class RobotImages {
    private readonly parts: ImageParts;
    private leaving: Promise<void> | null = null;

    constructor(parts: ImageParts) {
        this.parts = parts;
    }

    /** As somebody wants who presses a button for it. */
    run(image: ImageName): void {
        void this.restart(image).catch((error: unknown) => this.parts.fail(error));
    }

    /** A robot as the factory gives it. */
    async forget(): Promise<void> {
        const { robot, fail } = this.parts;
        await robot()
            .forget(this.state.image)
            .catch((cause: unknown) => fail(new RobotError('no-image', '', { cause })));
    }

    /** Only Edit saves pages. The robot starts anew with it, stands up, and stays so until somebody drives it. */
    async becomeEdit(): Promise<void> {
        if (this.state.image !== 'edit') {
            this.parts.say({ text: TEXTS.robot.startsEdit, tone: 'calm' });
            await this.restart('edit');
        }
        await this.untilReady();
        await this.parts.robot().prepare();
    }

    /** Only Play hears a remote control. Resolves when it does, and the robot is on its feet. Rejects with RobotError. */
    async becomeDriven(): Promise<void> {
        if (this.state.image !== 'play') {
            this.leaving ??= this.leaveEdit().finally(() => (this.leaving = null));
            await this.leaving;
        }
        await this.untilReady();
        await this.parts.robot().prepare();
    }

    private get state(): SessionState {
        return this.parts.state.get();
    }

    /** A key of the remote is no word for throwing edits away: with any of them Edit goes on. Rejects with RobotError: page-unsaved, and as
     *  a request does. */
    private async leaveEdit(): Promise<void> {
        if (this.state.stopped === null) {
            // else nothing is left in its RAM
            await this.untilReady();
            if (this.state.image === 'play') return; // meanwhile
            const { connection } = this.parts.robot();
            if (!connection) throw new RobotError('not-connected');
            if (await hasUnsavedEdits(connection.requests, this.parts.format)) throw new RobotError('page-unsaved');
        }
        this.parts.say({ text: TEXTS.robot.startsPlay, tone: 'calm' });
        await this.restart('play');
    }

    /** Rejects with RobotError when the image cannot be had: the robot goes on as it was. */
    private async restart(image: ImageName): Promise<void> {
        const { state, robot } = this.parts;
        const before = state.get().image;
        state.set({ image });
        try {
            await robot().restart(image);
        } catch (cause) {
            if (state.get().image === image) state.set({ image: before });
            throw new RobotError('no-image', '', { cause });
        }
    }

    private untilReady(): Promise<void> {
        return new Promise((resolve, reject) => {
            let unwatch = (): void => undefined;
            const timer = setTimeout(() => end(() => reject(new RobotError('no-answer'))), READY_MS);
            const end = (action: () => void): void => {
                clearTimeout(timer);
                queueMicrotask(() => unwatch());
                action();
            };
            unwatch = this.parts.state.watch(
                ({ source, connection, version, image, physics }) =>
                    connection === 'ready' && version?.image === image && (source !== 'simulated' || physics !== 'loading') && end(resolve),
            );
        });
    }
}
