// SPDX-License-Identifier: MIT
// The messages in the status bar: from the page, from the board, and troubles. A trouble is removed when its cause is gone.

import { RobotError } from '../robot/robot-error.ts';
import type { SessionState, Notice } from '../view/session/session.ts';
import type { Store } from '../view/store.ts';
import { errorText } from '../view/texts/robot.ts';
import { TEXTS } from '../view/texts/texts.ts';
import { BoardMessages } from './board-messages.ts';

/** Time to read a trouble before the board's next line may replace it. */
const TROUBLE_STAYS_MS = 6000;

/** The cause of a trouble: a refused edit, the robot, or a browser that stores nothing. */
export type Cause = 'edit' | 'robot' | 'storage';

export class StatusMessages {
    private readonly state: Store<SessionState>;
    private boardMessages = new BoardMessages();
    /** Of the robot in use. */
    private told: Notice | null = null;
    private kept: Notice | null = null;
    private trouble: { readonly message: Notice; readonly cause: Cause; readonly untilMs: number } | null = null;

    constructor(state: Store<SessionState>) {
        this.state = state;
    }

    /** A trouble that can hardly have been read yet; null: none. It stays when the robot restarts. */
    get unread(): Notice | null {
        const { trouble } = this;
        const isUnread = trouble !== null && this.state.get().message === trouble.message && performance.now() < trouble.untilMs;
        return isUnread ? trouble.message : null;
    }

    /** null clears the message. */
    say(message: Notice | null): void {
        this.state.set({ message });
    }

    /** Like say(), but a board message replaces it only if it reports trouble. */
    keep(message: Notice): void {
        this.kept = message;
        this.say(message);
    }

    /** Shows a trouble until over() is called with its cause. */
    complain(text: string, cause: Cause): void {
        const message: Notice = { text, tone: 'bad' };
        this.trouble = { message, cause, untilMs: performance.now() + TROUBLE_STAYS_MS };
        this.say(message);
    }

    /** Reports why a robot did not do what it was asked. Any other error is a bug and is thrown. Says nothing of a robot that was left for the
     *  one that is ready now, or of one that has crashed or is off, which the page says anyway. */
    readonly fail = (error: unknown): void => {
        if (!(error instanceof RobotError)) throw error;
        const { connection, stopped, source, isPowered } = this.state.get();
        if (error.code === 'no-answer' && source === 'simulated' && !isPowered) return;
        if (error.code === 'not-connected' && (connection === 'ready' || stopped)) return;
        if (error.code === 'no-answer' && source === 'servos' && connection !== 'ready')
            return this.complain(TEXTS.robot.stillSearches, 'robot');
        if (error.code === 'new-version') this.state.set({ hasNewVersion: true });
        this.complain(errorText(error), 'robot');
    };

    /** That cause is gone. A robot's trouble still stays long enough to be read. */
    over(cause: Cause): void {
        const { trouble } = this;
        if (trouble?.cause !== cause) return;
        const restMs = cause === 'robot' ? trouble.untilMs - performance.now() : 0;
        if (restMs > 0) setTimeout(() => this.takeAway(trouble.message), restMs);
        else this.takeAway(trouble.message);
    }

    /** Shows what the board says unasked. A recent trouble is replaced only by another one. */
    hear(bytes: Uint8Array): void {
        const message = this.boardMessages.take(bytes);
        const isKept = this.kept !== null && this.state.get().message === this.kept;
        if (message && (message.isTrouble || (!isKept && performance.now() > (this.trouble?.untilMs ?? 0)))) {
            this.tell({ text: message.text, tone: message.isTrouble ? 'bad' : 'calm' });
        }
    }

    /** Says what is so of the robot in use, and of no other one. */
    tell(message: Notice): void {
        this.told = message;
        this.say(message);
    }

    /** Another robot is used: what was told of the one before is not so of it. */
    leaveRobot(): void {
        this.boardMessages = new BoardMessages();
        if (this.told) this.takeAway(this.told);
    }

    /** Removes the message unless another one has replaced it. */
    private takeAway(message: Notice): void {
        if (this.state.get().message === message) this.say(null);
    }
}
