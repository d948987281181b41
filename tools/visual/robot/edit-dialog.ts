// SPDX-License-Identifier: MIT
// What a line typed into Edit may have opened: "Are you sure?", a name, a list, a play. There every byte means something else, those of a
// program's question too: they would become the name, answer "no", stop the play. Edit does not say that such a thing is open, so whoever
// asks watches for Enter, and for where Edit lets the cursor rest (edit-cursor.ts):
//
//   CLOSED --Enter--> OPEN --a second in which the cursor was only where nothing is open--> CLOSED
//                      | two seconds
//                      v
//                     LONG, a person is told: it waits for an answer, or plays --as above--> CLOSED
//
// The second is Edit's time, not a person's: a play comes back to its row after every joint that it draws, every tick; a question is
// written before anything else is drawn. When Edit has said nothing since the last key, it is five seconds: the key did nothing.

import type { Clock } from './clock.ts';
import { EditCursor } from './edit-cursor.ts';
import type { EditPlace } from './edit-cursor.ts';

const RESTS_MS = 1000;
const SILENT_MS = 5000;
const LONG_MS = 2000;
const NOTHING_OPEN: ReadonlySet<EditPlace> = new Set(['table', 'new-line', 'away']);
const nothing = (): void => undefined;

export class EditDialog {
    private readonly clock: Clock;
    private readonly changed: () => void;
    private readonly cursor = new EditCursor();
    private state: 'closed' | 'open' | 'long' = 'closed';
    private mayBeEdit = true;
    private hasHeard = false; // since the last key
    private isResting = false;
    private cancelRest = nothing;
    private cancelLong = nothing;

    /** changed: it is LONG, or CLOSED again. */
    constructor(clock: Clock, changed: () => void) {
        this.clock = clock;
        this.changed = changed;
    }

    /** Something may be open that takes a question for an answer. */
    get isOpen(): boolean {
        return this.state !== 'closed';
    }

    get isLong(): boolean {
        return this.state === 'long';
    }

    /** A line is open, perhaps without a letter: it has to be emptied and ended before a question. */
    get hasLine(): boolean {
        return this.mayBeEdit && (this.cursor.place === 'line' || this.cursor.place === 'new-line');
    }

    /** This image answers. Only Edit has dialogs; until something answers it may be Edit. */
    runs(image: string): void {
        this.mayBeEdit = image === 'edit';
        if (!this.mayBeEdit) this.close();
    }

    /** A person's keys have gone down the line. */
    typed(keys: string): void {
        if (!this.mayBeEdit) return;
        this.hasHeard = false;
        if (/[\r\n]/.test(keys)) this.open();
        this.rest();
    }

    /** The board has said this to the terminal. */
    heard(bytes: Uint8Array): void {
        const places = this.cursor.take(bytes);
        const isNews = !this.hasHeard || [...places].some(place => !NOTHING_OPEN.has(place));
        this.hasHeard = true;
        if (isNews || !this.isResting) this.rest();
    }

    /** No timer is left. */
    stop(): void {
        this.cancelRest();
        this.cancelLong();
        this.isResting = false;
    }

    private open(): void {
        this.cancelLong();
        if (this.state === 'long') return;
        this.state = 'open';
        this.cancelLong = this.clock.after(LONG_MS, () => {
            this.state = 'long';
            this.changed();
        });
    }

    private rest(): void {
        this.cancelRest();
        this.isResting = this.isOpen && NOTHING_OPEN.has(this.cursor.place);
        if (this.isResting) this.cancelRest = this.clock.after(this.hasHeard ? RESTS_MS : SILENT_MS, () => this.close());
    }

    private close(): void {
        this.stop();
        if (!this.isOpen) return;
        this.state = 'closed';
        this.changed();
    }
}
