// SPDX-License-Identifier: MIT
// What is said in the status bar: by the page, by the board, and what went wrong. That goes when its cause has gone.

import { RobotError } from '../robot/robot-error.ts';
import type { SessionState, Notice } from '../view/session/session.ts';
import type { Store } from '../view/store.ts';
import { errorText } from '../view/texts/robot.ts';
import { BoardMessages } from './board-messages.ts';

/** What went wrong is to be read before the board's next line takes its place. */
const TROUBLE_STAYS_MS = 6000;

/** What a trouble comes from: an edit that was refused, the robot, or a browser that keeps nothing. */
export type Cause = 'edit' | 'robot' | 'storage';

export class StatusMessages {
    private readonly state: Store<SessionState>;
    private readonly boardMessages = new BoardMessages();
    private kept: Notice | null = null;
    private trouble: { readonly message: Notice; readonly cause: Cause; readonly untilMs: number } | null = null;

    constructor(state: Store<SessionState>) {
        this.state = state;
    }

    /** null: nothing stands there. */
    say(message: Notice | null): void {
        this.state.set({ message });
    }

    /** As say(), but what the board says by itself does not take its place, unless that is a trouble. */
    keep(message: Notice): void {
        this.kept = message;
        this.say(message);
    }

    /** Says what went wrong, until over() with that cause. */
    complain(text: string, cause: Cause): void {
        const message: Notice = { text, tone: 'bad' };
        this.trouble = { message, cause, untilMs: performance.now() + TROUBLE_STAYS_MS };
        this.say(message);
    }

    /** Says why a robot did not do what it was asked. Any other error is our own mistake, and is thrown. */
    readonly fail = (error: unknown): void => {
        if (!(error instanceof RobotError)) throw error;
        this.complain(errorText(error), 'robot');
    };

    /** What went wrong for that cause does not hold any more. A robot's trouble can be read all the same. */
    over(cause: Cause): void {
        const { trouble } = this;
        if (trouble?.cause !== cause) return;
        const restMs = cause === 'robot' ? trouble.untilMs - performance.now() : 0;
        if (restMs > 0) setTimeout(() => this.takeAway(trouble.message), restMs);
        else this.takeAway(trouble.message);
    }

    /** Says what the board says by itself, but not over a trouble that has just come. */
    hear(bytes: Uint8Array): void {
        const message = this.boardMessages.take(bytes);
        const isKept = this.kept !== null && this.state.get().message === this.kept;
        if (message && (message.isTrouble || (!isKept && performance.now() > (this.trouble?.untilMs ?? 0))))
            this.say({ text: message.text, tone: message.isTrouble ? 'bad' : 'calm' });
    }

    /** Unless something else was said since. */
    private takeAway(message: Notice): void {
        if (this.state.get().message === message) this.say(null);
    }
}
