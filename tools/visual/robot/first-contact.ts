// SPDX-License-Identifier: MIT
// The first thing said to a board. What was typed before nobody knows: with a name open in Edit, "@ver" would become the name. So first only
// its '@' is sent, and what comes back tells who has it (firmware/edit/editor_keys.c):
//
//   "\r\n", or nothing at all   a program's line has begun               it is emptied; ask
//   '@'                         a line has it: a name, Play's prompt     it is emptied and left, a name stays as it was; ask
//   only drawing                a play has the keys, and wants no '@'    do not ask now: the Enter behind a question would stop it
//
// The NUL before it means nothing anywhere; but a question of Edit lets pass what comes close behind another byte.

import type { Clock } from './clock.ts';
import { EMPTY_LINE } from './requests.ts';
import { RobotError } from './robot-error.ts';

const KNOCK = '\0@';
const TAKE_BACK = '\b';
/** Edit answers within a few milliseconds; it draws for 50 ms at most without being back. */
const LISTEN_MS = 300;

export class FirstContact {
    private readonly clock: Clock;
    private readonly write: (keys: string) => Promise<void>;
    private text = '';
    private done: (() => void) | null = null;

    constructor(clock: Clock, write: (keys: string) => Promise<void>) {
        this.clock = clock;
        this.write = write;
    }

    /** The board has said this. */
    heard(bytes: Uint8Array): void {
        if (!this.done) return;
        this.text += String.fromCharCode(...bytes);
        if (/[@\n]/.test(this.text)) this.done();
    }

    /** Afterwards a question may be asked. Rejects with RobotError: edit-waits, and as the port does. */
    async make(): Promise<void> {
        this.text = '';
        const listened = this.listen();
        await this.write(KNOCK);
        await listened;
        if (this.text.includes('@')) return this.write(EMPTY_LINE);
        if (this.text.includes('\x1b') && !this.text.includes('\n')) throw new RobotError('edit-waits');
        return this.write(TAKE_BACK);
    }

    private async listen(): Promise<void> {
        let cancel = (): void => undefined;
        await new Promise<void>(resolve => {
            this.done = resolve;
            cancel = this.clock.after(LISTEN_MS, resolve);
        });
        cancel();
        this.done = null;
    }
}
