// SPDX-License-Identifier: MIT
// What the page asks of a robot periodically, and the sentence in the status bar that says what the robot does. Also makes Edit draw its
// screen for a terminal that was just opened or resized.

import type { Connection } from '../robot/connection.ts';
import { TICKS_PER_SECOND } from '../model/motion.ts';
import { askWhere } from '../robot/protocol.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { SessionState, TerminalSize } from '../view/session/session.ts';
import type { Store } from '../view/store.ts';
import { doingText } from '../view/texts/robot.ts';

const WHERE_MS = 300;
/** Fewest rows of a screen that Edit draws. */
const ROWS_LEAST = 24;
/** Edit's screen is not drawn again so soon after a key: a question that the key has opened would be drawn over. */
const TYPING_MS = 1000;
/** Clears the screen. Edit begins a whole screen with it. */
const CLEAR = '\x1b[2J';
/** In robot time, so that a slow computer does not count as silence. The robot in the page normally answers long before. */
const START_TICKS = 10 * TICKS_PER_SECOND;

export interface StatusParts {
    readonly state: Store<SessionState>;
    /** Throws RobotError not-connected if there is none. */
    connection(): Connection;
    /** Pages are being written. A question in between would only cost time. */
    isWriting(): boolean;
}

export class Status {
    private readonly parts: StatusParts;
    private timer: ReturnType<typeof setTimeout> | undefined;
    /** The connection on which a question is under way. */
    private asked: Connection | null = null;
    /** When the robot in the page began to start, in its own time. null: it answers or is off. */
    private startedTicks: number | null = null;
    private terminal: TerminalSize | null = null;
    private isDrawingDue = false;
    /** Edit has drawn its screen since it was last asked to. It does not while a line or a question is open. */
    private isDrawn = true;
    private heardLast = '';
    private typedAtMs = -Infinity;

    constructor(parts: StatusParts) {
        this.parts = parts;
    }

    mayAsk(): boolean {
        return this.state.connection === 'ready' && !this.parts.isWriting();
    }

    /** Asks now and then periodically. Of the periodic questions only one is under way, or they would queue up at a robot that is off. */
    async ask(isPeriodic = false): Promise<void> {
        clearTimeout(this.timer);
        this.timer = setTimeout(() => void this.ask(true), WHERE_MS);
        const { source, speed } = this.state;
        if (!this.mayAsk() || (source === 'simulated' && speed === 0)) return; // while its time stands still it does not answer
        const connection = this.parts.connection();
        if (isPeriodic && this.asked === connection) return;
        this.asked = connection;
        try {
            const where = await askWhere(connection.requests, { timeoutMs: 3000 });
            this.parts.state.set({ where });
            this.tell();
            if (where.state === 'idle') this.draw(connection);
        } catch (error) {
            if (error instanceof RobotError && error.code === 'no-answer') connection.askAgain();
        } finally {
            if (this.asked === connection) this.asked = null;
        }
    }

    /** Updates the sentence in the status bar. change: sets this as well, at the same time, so that the two fit. */
    tell(change: Partial<SessionState> = {}): void {
        const state = { ...this.state, ...change };
        const { stopped, connection, where } = state;
        const tone =
            stopped !== null || connection === 'foreign' || connection === 'other-board' || connection === 'waiting' ? 'bad' : 'calm';
        this.parts.state.set({ ...change, doing: { text: doingText(state, where), tone } });
    }

    /** The robot in the page has reached this time. Silence while it starts or restarts is normal. */
    reach(ticks: number): void {
        const isStarting = this.state.connection !== 'ready' && this.state.isPowered;
        this.startedTicks = isStarting ? Math.min(ticks, this.startedTicks ?? ticks) : null; // a new robot begins at 0
        const isLate = this.startedTicks !== null && ticks - this.startedTicks > START_TICKS;
        if (isLate === this.state.isLate) return;
        this.parts.state.set({ isLate });
        this.tell();
    }

    terminalSize(size: TerminalSize): void {
        this.terminal = size;
        this.look();
    }

    /** Edit's screen may have been opened or closed. */
    look(): void {
        this.isDrawingDue = true;
    }

    hear(bytes: Uint8Array): void {
        const text = this.heardLast + new TextDecoder('latin1').decode(bytes);
        this.isDrawn ||= text.includes(CLEAR);
        this.heardLast = text.slice(1 - CLEAR.length);
    }

    /** A person has typed: what kept Edit from drawing its screen may have ended. */
    typed(): void {
        this.typedAtMs = Date.now();
        if (!this.isDrawn) this.look();
    }

    /** Edit draws only when the reported terminal size changes, so a different size is reported first. Not while the robot moves. */
    private draw(connection: Connection): void {
        if (!this.isDrawingDue || !this.isEditOnScreen || !this.terminal) return;
        if (Date.now() - this.typedAtMs < TYPING_MS) return;
        this.isDrawingDue = this.isDrawn = false;
        const { rows, columns } = this.terminal;
        const other = rows === ROWS_LEAST ? rows + 1 : ROWS_LEAST;
        const reports = `\x1b[${other};${columns}R\x1b[${rows};${columns}R`;
        void connection.write(new TextEncoder().encode(reports)).catch(() => undefined); // a lost line needs no screen
    }

    private get state(): SessionState {
        return this.parts.state.get();
    }

    private get isEditOnScreen(): boolean {
        return this.state.version?.image === 'edit' && this.state.tab === 'terminal';
    }
}
