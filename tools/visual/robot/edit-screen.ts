// SPDX-License-Identifier: MIT
// Edit's screen in a terminal, beside a program's questions. A question puts it away (PROTOCOL.md), and what a person types next to it is
// then done but not shown. So whoever has asked brings the screen back while somebody looks at it:
//
//   SHOWN --question--> AWAY --nothing asked for 0.3 s--> COMING --text, or a person's key--> SHOWN
//     |                                                   ^    |
//     +--another size--> RESIZED --0.3 s--> SHOWN         +----+ 1 s without text: the robot moves; once more
//
// The key that does it is the terminal's report of its size: it changes no cell and opens no line.

import type { Clock } from './clock.ts';

/** Questions in a row put it away once. */
const QUIET_MS = 300;
/** Edit draws only while the robot stands. */
const AGAIN_MS = 1000;
/** They leave the screen away. */
const NO_KEYS = /^[\r\n]*$/;

/** In letters. */
export interface TerminalSize {
    readonly rows: number;
    readonly columns: number;
}

export class EditScreen {
    private readonly clock: Clock;
    private readonly isFree: () => boolean;
    private readonly send: (keys: string) => void;
    private report = ''; // '': nobody looks
    private state: 'shown' | 'resized' | 'away' | 'coming' = 'shown';
    private cancelTimer: () => void = () => undefined;

    /** isFree: nothing is asked, and no line is half typed: the report would land in its middle. */
    constructor(clock: Clock, isFree: () => boolean, send: (keys: string) => void) {
        this.clock = clock;
        this.isFree = isFree;
        this.send = send;
    }

    /** Somebody looks at it, in a terminal of this size; null: nobody does. Edit is told a new size. */
    look(size: TerminalSize | null): void {
        const report = size ? `\x1b[${size.rows};${size.columns}R` : '';
        if (report === this.report) return;
        if (this.report !== '' && this.state === 'shown') this.state = 'resized';
        this.report = report;
        this.later(QUIET_MS);
    }

    /** A question has been sent. */
    asked(): void {
        this.state = 'away';
        this.later(QUIET_MS);
    }

    /** A person's keys have gone down the line: Edit draws its screen before it takes them. */
    typed(keys: string): void {
        if (this.state !== 'resized' && !NO_KEYS.test(keys)) this.shown();
    }

    /** The board has said something to the terminal. */
    heard(): void {
        if (this.state === 'coming') this.shown();
    }

    end(): void {
        this.report = '';
        this.cancelTimer();
    }

    private shown(): void {
        this.state = 'shown';
        this.cancelTimer();
    }

    private later(delayMs: number): void {
        this.cancelTimer();
        if (this.state !== 'shown' && this.report !== '') this.cancelTimer = this.clock.after(delayMs, () => this.bringBack());
    }

    private bringBack(): void {
        if (!this.isFree()) return this.later(QUIET_MS);
        this.state = this.state === 'resized' ? 'shown' : 'coming';
        this.send(this.report);
        this.later(AGAIN_MS);
    }
}
