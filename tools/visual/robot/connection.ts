// SPDX-License-Identifier: MIT
// Keeps one port connected: opens it, identifies what runs on the board, notices a loss and tries again. connection-table.ts has the states
// and their transitions.

import type { Clock } from './clock.ts';
import { nextState } from './connection-table.ts';
import type { ConnectionEvent, ConnectionState } from './connection-table.ts';
import { Line } from './line.ts';
import { LoaderBanner } from './loader-banner.ts';
import { BAUD_RATE } from './port.ts';
import type { Port } from './port.ts';
import { PROTOCOL, askVersion } from './protocol.ts';
import type { Version } from './protocol.ts';
import { Requests } from './requests.ts';
import { RobotError } from './robot-error.ts';
import { TypedText } from './typed-text.ts';

const CR = 13;
const RETRY_FIRST_MS = 250;
const RETRY_MOST_MS = 4000;
const GIVE_UP_MS = 120_000;
const ASK_MS = 700;
const ASK_AGAIN_MS = 400;
/** Another board may be put on the cable. */
const ASK_FOREIGN_MS = 3000;
/** A question ends a line that a person is typing, so it waits for this long after the last key. */
const TYPING_MS = 5000;

export interface ConnectionEvents {
    /** Return values are ignored. */
    state(state: ConnectionState): unknown;
    text(bytes: Uint8Array): unknown;
}

export class Connection {
    private readonly port: Port;
    private readonly clock: Clock;
    private readonly events: ConnectionEvents;
    private current: ConnectionState = 'closed';
    private line: Line | null = null;
    private typed: TypedText | null = null;
    private asked: Requests | null = null;
    private cancelTimer: () => void = () => undefined;
    private retryMs = RETRY_FIRST_MS;
    private lostAtMs = 0;
    /** When the last character of a line that has not ended was typed. */
    private typedAtMs = -Infinity;
    /** The firmware on the board; null until known. */
    version: Version | null = null;
    /** Why the state is silent, foreign, other-board or waiting. */
    error: RobotError | null = null;

    constructor(port: Port, clock: Clock, events: ConnectionEvents) {
        this.port = port;
        this.clock = clock;
        this.events = events;
    }

    get state(): ConnectionState {
        return this.current;
    }

    get name(): string {
        return this.port.name;
    }

    /** Requests of the open line. Throws RobotError if there is none: port-lost while the cable is waited for, else not-connected. */
    get requests(): Requests {
        if (!this.asked) throw this.noLine();
        return this.asked;
    }

    connect(): void {
        this.lostAtMs = this.clock.now();
        this.retryMs = RETRY_FIRST_MS;
        this.on('connect');
    }

    /** Identifies the board again, after a deliberate restart or a change of image. */
    askAgain(): void {
        this.on('ask-again');
    }

    /** The system reports the port again, so the next try is due now. */
    retryNow(): void {
        if (this.current === 'waiting') this.on('retry');
    }

    async close(): Promise<void> {
        this.on('stop');
        await this.shut();
    }

    /** Sends typed characters. Rejects if there is no line. */
    async write(bytes: Uint8Array): Promise<void> {
        if (!this.typed || this.current === 'waiting') throw this.noLine();
        this.typedAtMs = bytes.at(-1) === CR ? -Infinity : this.clock.now();
        await this.typed.write(bytes);
    }

    /** Drops what is left of a pasted text. */
    dropText(): void {
        this.typed?.drop();
    }

    private noLine(): RobotError {
        const isLost = this.error?.code === 'port-lost' && (this.current === 'waiting' || this.current === 'opening');
        return new RobotError(isLost ? 'port-lost' : 'not-connected');
    }

    private on(event: ConnectionEvent): void {
        const next = nextState(this.current, event);
        if (!next) return;
        this.cancelTimer();
        this.cancelTimer = () => undefined;
        this.current = next;
        if (next === 'waiting') this.version = null; // it may be another board when the port is back
        if (next === 'asking') this.typedAtMs = -Infinity;
        this.events.state(next);
        this.enter(next);
    }

    private enter(state: ConnectionState): void {
        switch (state) {
            case 'opening':
                return void this.open();
            case 'asking':
                return void this.ask();
            case 'silent':
                return this.askLater(ASK_AGAIN_MS);
            case 'foreign':
                return this.askLater(ASK_FOREIGN_MS);
            case 'waiting':
                return this.wait();
            case 'closed':
                return this.asked?.end('not-connected');
            case 'other-board':
                return this.asked?.end('not-connected');
            case 'ready':
                return;
            default:
                state satisfies never;
        }
    }

    private later(delayMs: number, event: ConnectionEvent): void {
        this.cancelTimer = this.clock.after(delayMs, () => this.on(event));
    }

    /** Its state stays until something else is known: people read what it means. */
    private askLater(delayMs: number): void {
        const isTyping = (): boolean => this.typed?.isPasting === true || this.clock.now() - this.typedAtMs < TYPING_MS;
        this.cancelTimer = this.clock.after(delayMs, () => (isTyping() ? this.askLater(delayMs) : void this.ask()));
    }

    private async open(): Promise<void> {
        await this.shut();
        try {
            await this.port.open({ baudRate: BAUD_RATE });
        } catch (cause) {
            const isUnplugged = this.error?.code === 'port-lost'; // it cannot be opened before it is back
            if (!isUnplugged) this.error = new RobotError('port-busy', cause instanceof Error ? cause.message : '', { cause });
            this.on('open-failed');
            return;
        }
        if (this.current !== 'opening') return void this.port.close().catch(() => undefined); // stopped meanwhile; it may be lost already
        const banner = new LoaderBanner();
        const line = new Line(this.port, this.clock, {
            text: bytes => {
                this.meetOther(banner.heard(bytes));
                this.events.text(bytes);
            },
            answer: line => this.asked?.take(line),
            lost: cause => this.lose(cause),
        });
        this.line = line;
        this.typed = new TypedText(line, this.clock);
        this.asked = new Requests(line, this.clock);
        this.on('opened');
    }

    private async ask(): Promise<void> {
        const { asked, current } = this;
        if (!asked) return; // closed meanwhile
        try {
            const version = await askVersion(asked, { timeoutMs: ASK_MS });
            if (this.asked !== asked || this.current !== current) return; // the line was replaced or closed, or the board was named
            this.version = version;
            this.retryMs = RETRY_FIRST_MS;
            this.error = version.protocol === PROTOCOL ? null : new RobotError('foreign', `protocol ${version.protocol}`);
            this.on(this.error ? 'unknown' : 'known');
        } catch (cause) {
            if (this.asked !== asked || this.current !== current) return;
            this.version = null;
            this.error = cause instanceof RobotError ? cause : new RobotError('foreign', String(cause));
            this.on(this.error.code === 'no-answer' ? 'no-answer' : 'unknown');
        }
    }

    /** name: the board's name if its boot loader has just announced one that is not ours. */
    private meetOther(name: string | null): void {
        if (name === null) return;
        this.error = new RobotError('other-board', name);
        this.version = null;
        this.on('named-other');
    }

    private lose(cause: unknown): void {
        this.lostAtMs = this.clock.now();
        this.asked?.end('port-lost');
        this.error = new RobotError('port-lost', '', { cause });
        this.on('lost');
    }

    private wait(): void {
        if (this.clock.now() - this.lostAtMs > GIVE_UP_MS) return this.on('gave-up');
        this.later(this.retryMs, 'retry');
        this.retryMs = Math.min(this.retryMs * 2, RETRY_MOST_MS);
    }

    private async shut(): Promise<void> {
        const line = this.line;
        this.line = null;
        this.typed = null;
        this.asked?.end('not-connected');
        this.asked = null;
        if (!line) return;
        await line.close();
        await this.port.close().catch(() => undefined); // a lost port cannot be closed
    }
}
