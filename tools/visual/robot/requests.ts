// SPDX-License-Identifier: MIT
// Requests and answers of PROTOCOL.md on a line: one at a time, in order, each with a time limit.
//
//   waiting in the queue --sent--> under way --answer--> resolved, or rejected with the board's ERR
//                                     |
//                                     +--time over--> rejected; late answers to it are dropped until the line is settled
//
// A request that moves the robot and is given up may still arrive, because a line that stalls keeps its bytes. So `@stop` goes right behind
// it, and once more, if that is not answered either, as soon as anything is. A packet of a remote is not answered at all: the request behind
// it tells whether the line stalls.

import type { Clock } from './clock.ts';
import type { Line } from './line.ts';
import { framed, isAnswer } from './line-parser.ts';
import { RobotError } from './robot-error.ts';

const ANSWER_MS = 1000;
/** ERR: bytes of the request were lost. */
const ERR_LINE = '15';
/** After a time-out nothing is sent for this long or until the late answer arrives, so that it is not taken for the next one. */
const SETTLE_MS = 500;
/** A stop waits this long for the answer to something else: it comes within 0.1 s, unless it is long or lost. */
const STOP_WAITS_MS = 200;
/** A stop without an answer is sent this often, unless something that moves has been asked since. It does no harm twice. */
const STOP_TRIES = 3;
/** A press that the line has not taken within this time is dropped. */
const PRESS_MS = 500;

export interface RequestOptions {
    readonly timeoutMs?: number;
    readonly signal?: AbortSignal;
    /** Stops the robot. Goes to the head of the queue and cancels the requests there that would move it afterwards. */
    readonly stops?: boolean;
    /** Moves the robot. */
    readonly moves?: boolean;
    /** Must not be sent again blindly if there is no answer: what it does depends on the board's state, which a restart changes. */
    readonly once?: boolean;
}

interface Request {
    readonly text: string;
    readonly timeoutMs: number;
    readonly moves: boolean;
    readonly stops: boolean;
    readonly resolve: (answer: string) => void;
    readonly reject: (error: RobotError) => void;
    /** How often it was sent. */
    tries: number;
}

export class Requests {
    private readonly line: Pick<Line, 'write'>;
    private readonly clock: Clock;
    private readonly queue: Request[] = [];
    private current: Request | null = null;
    private abandoned: Request | null = null;
    private cancelTimer: () => void = () => undefined;
    private cancelSettle: () => void = () => undefined;
    /** Why nothing can be asked any more. */
    private ended: 'port-lost' | 'not-connected' | null = null;
    /** A request that moves was given up. now: `@stop` is sent next; later: it was sent, and is due again when another
     *  request is answered first. A newer request that moves takes the place of the old one and is not stopped. */
    private stopDue: 'no' | 'now' | 'later' = 'no';
    /** A press was sent that may not have arrived yet. asked: so was a request behind it, whose answer settles it. */
    private pressed: 'no' | 'sent' | 'asked' = 'no';
    /** Nothing that was asked has been answered for ANSWER_MS. */
    private isSilent = false;
    /** Set while nothing that was asked is answered. */
    private cancelSilence: (() => void) | null = null;

    constructor(line: Pick<Line, 'write'>, clock: Clock) {
        this.line = line;
        this.clock = clock;
    }

    /** Sends a request, for example `@where`. Resolves to the words between its first word and OK. Rejects with RobotError: refused,
     *  no-answer, not-connected, port-lost, cancelled. */
    ask(text: string, options: RequestOptions = {}): Promise<string> {
        return new Promise((resolve, reject) => {
            if (this.ended) return reject(new RobotError(this.ended));
            const { timeoutMs = ANSWER_MS, moves = false, stops = false } = options;
            const request = { text, timeoutMs, moves, stops, resolve, reject, tries: 0 };
            options.signal?.addEventListener('abort', () => this.cancel(request), { once: true });
            if (options.signal?.aborted) return reject(new RobotError('cancelled'));
            if (stops) {
                this.dropQueued();
                this.queue.unshift(request);
                this.overtake();
            } else this.queue.push(request);
            this.next();
        });
    }

    /** Sends a packet of a remote. A press must not move the robot late: it is dropped, with no-answer, if the robot is silent or the line does
     *  not take it soon. What was sent just before a silence may arrive after it, so the robot is stopped then. */
    async packet(bytes: Uint8Array, { moves }: { readonly moves: boolean }): Promise<void> {
        if (!moves) return this.line.write(bytes);
        if (this.isSilent) throw new RobotError('no-answer');
        this.pressed = 'sent';
        await this.line.write(bytes, PRESS_MS);
    }

    /** Cancels what would move the robot and is not answered yet: the robot is switched off or reset. */
    dropMoves(): void {
        this.dropQueued();
        if (this.current?.moves) this.cancel(this.current);
    }

    /** Cancels everything: the time of the robot in the page stands still while another one is used, so nothing would be answered. */
    dropAll(): void {
        for (const one of [...this.queue]) this.cancel(one);
        if (this.current) this.cancel(this.current);
    }

    private dropQueued(): void {
        for (const one of this.queue.filter(({ moves }) => moves)) this.cancel(one);
    }

    /** Handles a received answer line. */
    take(line: string): void {
        if (this.abandoned !== null && isAnswer(this.abandoned.text, line)) {
            if (this.abandoned.stops) this.stopDue = 'no';
            this.endSilence();
            this.settle();
            return;
        }
        const request = this.current;
        if (!request || !isAnswer(request.text, line)) return; // not requested
        this.finish();
        this.endSilence();
        if (this.pressed === 'asked') this.pressed = 'no';
        const word = request.text.split(' ', 1)[0] ?? '';
        const refusal = / ERR (\d+) (.*)$/.exec(line);
        if (this.stopDue === 'later' && refusal?.[1] !== ERR_LINE) this.stopDue = request.moves || request.stops ? 'no' : 'now';
        if (refusal?.[1] === ERR_LINE) {
            if (this.isRepeated(request)) return this.next();
            request.reject(new RobotError('no-answer', request.text, { number: Number(ERR_LINE) })); // it was not executed
        } else if (refusal) request.reject(new RobotError('refused', refusal[2] ?? '', { number: Number(refusal[1]) }));
        else request.resolve(line.slice(word.length, -' OK'.length).trim());
        this.next();
    }

    /** The line is lost. Rejects all waiting and all later requests. */
    end(code: 'port-lost' | 'not-connected'): void {
        this.ended = code;
        this.cancelTimer();
        this.cancelSettle();
        this.endSilence();
        const all = this.current ? [this.current, ...this.queue] : [...this.queue];
        this.current = null;
        this.queue.length = 0;
        for (const request of all) request.reject(new RobotError(code));
    }

    /** What is under way before a stop is given up soon. */
    private overtake(): void {
        const { current } = this;
        if (current === null || current.stops) return;
        this.clock.after(STOP_WAITS_MS, () => this.current === current && this.timeOut(current));
    }

    private isRepeated(request: Request): boolean {
        if (!request.stops || request.tries >= STOP_TRIES || this.queue.some(({ moves }) => moves)) return false;
        this.queue.unshift(request);
        return true;
    }

    private next(): void {
        if (this.current) return;
        // A late answer begins with another word than that to a stop.
        if (this.abandoned !== null && !this.queue[0]?.stops) return;
        const request = this.stopDue === 'now' ? this.ownStop() : this.queue.shift();
        if (!request) return;
        this.current = request;
        request.tries++;
        if (this.pressed === 'sent') this.pressed = 'asked';
        this.cancelSilence ??= this.clock.after(ANSWER_MS, () => this.beSilent());
        this.cancelTimer = this.clock.after(request.timeoutMs, () => this.timeOut(request));
        this.line.write(framed(request.text)).catch((cause: unknown) => {
            if (this.current !== request) return;
            this.finish();
            request.reject(cause instanceof RobotError ? cause : new RobotError('port-lost', '', { cause }));
            this.next();
        });
    }

    private ownStop(): Request {
        this.stopDue = 'later';
        const ignore = (): void => undefined;
        return { text: '@stop', timeoutMs: ANSWER_MS, moves: false, stops: true, resolve: ignore, reject: ignore, tries: STOP_TRIES };
    }

    private beSilent(): void {
        this.isSilent = true;
        if (this.pressed === 'no') return;
        this.pressed = 'no';
        this.stopDue = 'now';
        this.next();
    }

    private endSilence(): void {
        this.cancelSilence?.();
        this.cancelSilence = null;
        this.isSilent = false;
    }

    private finish(): void {
        this.cancelTimer();
        this.current = null;
    }

    private timeOut(request: Request): void {
        if (this.isRepeated(request)) {
            this.finish();
            return this.next();
        }
        this.abandon(request, new RobotError('no-answer', request.text));
    }

    private cancel(request: Request): void {
        const at = this.queue.indexOf(request);
        if (at >= 0) {
            this.queue.splice(at, 1);
            request.reject(new RobotError('cancelled'));
        } else if (this.current === request) {
            this.abandon(request, new RobotError('cancelled'));
        }
    }

    private abandon(request: Request, error: RobotError): void {
        this.finish();
        this.abandoned = request;
        if (request.moves) this.stopDue = 'now';
        this.cancelSettle();
        this.cancelSettle = this.clock.after(SETTLE_MS, () => this.settle());
        request.reject(error);
        this.next(); // a stop does not wait for that
    }

    private settle(): void {
        this.cancelSettle();
        this.abandoned = null;
        this.next();
    }
}
