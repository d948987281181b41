// SPDX-License-Identifier: MIT
// What is said in the strip: by the page, by the board, and what went wrong. That goes when its cause has gone.

import { RobotError } from '../robot/robot-error.ts';
import type { DeskState, Notice } from '../view/desk.ts';
import type { Store } from '../view/store.ts';
import { errorText } from '../view/texts/robot.ts';
import { LastSaid } from './said.ts';

/** What went wrong is to be read before the board's next line takes its place. */
const TROUBLE_STAYS_MS = 6000;

/** What a trouble comes from: an edit that was refused, the robot, or a browser that keeps nothing. */
export type Cause = 'edit' | 'robot' | 'storage';

export class Strip {
    private readonly state: Store<DeskState>;
    private readonly lastSaid = new LastSaid();
    private trouble: { readonly said: Notice; readonly cause: Cause; readonly untilMs: number } | null = null;

    constructor(state: Store<DeskState>) {
        this.state = state;
    }

    /** null: nothing stands there. */
    say(said: Notice | null): void {
        this.state.set({ said });
    }

    /** Says what went wrong, until over() with that cause. */
    complain(text: string, cause: Cause): void {
        const said: Notice = { text, tone: 'bad' };
        this.trouble = { said, cause, untilMs: performance.now() + TROUBLE_STAYS_MS };
        this.say(said);
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
        if (restMs > 0) setTimeout(() => this.takeAway(trouble.said), restMs);
        else this.takeAway(trouble.said);
    }

    /** Says what the board says by itself, but not over a trouble that has just come. */
    hear(bytes: Uint8Array): void {
        const said = this.lastSaid.take(bytes);
        if (said && (said.isTrouble || performance.now() > (this.trouble?.untilMs ?? 0)))
            this.say({ text: said.text, tone: said.isTrouble ? 'bad' : 'calm' });
    }

    /** Unless something else was said since. */
    private takeAway(said: Notice): void {
        if (this.state.get().said === said) this.say(null);
    }
}
