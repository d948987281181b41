// SPDX-License-Identifier: MIT
// What the page asks of a robot by itself, again and again, and the sentence in the status bar that says what it does. It also has Edit draw its
// screen for a terminal that has just been opened, or has another size.

import type { Connection } from '../robot/connection.ts';
import { TICKS_PER_SECOND } from '../model/motion.ts';
import { askWhere } from '../robot/protocol.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { SessionState, TerminalSize } from '../view/session/session.ts';
import type { Store } from '../view/store.ts';
import { doingText } from '../view/texts/robot.ts';

const WHERE_MS = 300;
/** Of a screen that Edit draws. */
const ROWS_LEAST = 24;
/** Of the robot's own time, so that a slow computer is no silent robot: one in the page that starts answers long before. */
const START_TICKS = 10 * TICKS_PER_SECOND;

export interface StatusParts {
    readonly state: Store<SessionState>;
    /** Throws RobotError not-connected when there is none. */
    connection(): Connection;
    /** Pages are being written: a question in between would only cost time. */
    isWriting(): boolean;
}

export class Status {
    private readonly parts: StatusParts;
    private timer: ReturnType<typeof setTimeout> | undefined;
    /** When the robot in the page began to start, in its own time; null: it answers, or is off. */
    private startedTicks: number | null = null;
    private terminal: TerminalSize | null = null;
    private isDrawingDue = false;

    constructor(parts: StatusParts) {
        this.parts = parts;
    }

    mayAsk(): boolean {
        return this.state.connection === 'ready' && !this.parts.isWriting();
    }

    /** Asks now, and then again and again. */
    async ask(): Promise<void> {
        clearTimeout(this.timer);
        this.timer = setTimeout(() => void this.ask(), WHERE_MS);
        if (!this.mayAsk() || this.state.speed === 0) return;
        const connection = this.parts.connection();
        try {
            const where = await askWhere(connection.requests, { timeoutMs: 3000 });
            this.parts.state.set({ where });
            this.tell();
            if (where.state === 'idle') this.draw(connection);
        } catch (error) {
            if (error instanceof RobotError && error.code === 'no-answer') connection.askAgain();
        }
    }

    /** The status bar says what the robot does now. */
    tell(): void {
        const { stopped, connection, where } = this.state;
        const tone =
            stopped !== null || connection === 'foreign' || connection === 'other-board' || connection === 'waiting' ? 'bad' : 'calm';
        this.parts.state.set({ doing: { text: doingText(this.state, where), tone } });
    }

    /** The robot in the page has come to this time. While it starts, or starts anew, it is silent, and nothing is wrong. */
    reach(ticks: number): void {
        const isStarting = this.state.connection !== 'ready' && this.state.isPowered;
        this.startedTicks = isStarting ? Math.min(ticks, this.startedTicks ?? ticks) : null; // one that is made anew begins at 0
        const isLate = this.startedTicks !== null && ticks - this.startedTicks > START_TICKS;
        if (isLate === this.state.isLate) return;
        this.parts.state.set({ isLate });
        this.tell();
    }

    /** The terminal shows so many letters. */
    terminalSize(size: TerminalSize): void {
        this.terminal = size;
        this.look();
    }

    /** Somebody looks at Edit's screen now, or does no more. */
    look(): void {
        this.isDrawingDue = true;
    }

    /** Edit draws when the size that a terminal reports is another, and not while the robot moves. */
    private draw(connection: Connection): void {
        if (!this.isDrawingDue || !this.isEditOnScreen || !this.terminal) return;
        this.isDrawingDue = false;
        const { rows, columns } = this.terminal;
        const other = rows === ROWS_LEAST ? rows + 1 : ROWS_LEAST;
        const reports = `\x1b[${other};${columns}R\x1b[${rows};${columns}R`;
        void connection.write(new TextEncoder().encode(reports)).catch(() => undefined); // a lost line has no screen
    }

    private get state(): SessionState {
        return this.parts.state.get();
    }

    private get isEditOnScreen(): boolean {
        return this.state.version?.image === 'edit' && this.state.tab === 'terminal';
    }
}
