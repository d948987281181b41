// SPDX-License-Identifier: MIT
// What is said in the strip: by the page, by the board, and what went wrong.

import { RobotError } from '../robot/robot-error.ts';
import type { DeskState, Notice } from '../view/desk.ts';
import type { Store } from '../view/store.ts';
import { errorText } from '../view/texts.ts';
import { LastSaid } from './said.ts';

/** What went wrong is to be read before the board's next line takes its place. */
const TROUBLE_STAYS_MS = 6000;

export class Strip {
    private readonly state: Store<DeskState>;
    private readonly lastSaid = new LastSaid();
    private troubleUntilMs = 0;

    constructor(state: Store<DeskState>) {
        this.state = state;
    }

    /** null: nothing stands there. */
    say(said: Notice | null): void {
        this.state.set({ said });
    }

    /** Says why a robot did not do what it was asked. Any other error is our own mistake, and is thrown. */
    readonly fail = (error: unknown): void => {
        if (!(error instanceof RobotError)) throw error;
        this.troubleUntilMs = performance.now() + TROUBLE_STAYS_MS;
        this.say({ text: errorText(error), tone: 'bad' });
    };

    /** Says what the board says by itself, but not over a trouble that has just come. */
    hear(bytes: Uint8Array): void {
        const said = this.lastSaid.take(bytes);
        if (said && (said.isTrouble || performance.now() > this.troubleUntilMs))
            this.say({ text: said.text, tone: said.isTrouble ? 'bad' : 'calm' });
    }
}
