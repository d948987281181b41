// SPDX-License-Identifier: MIT
// Requests and answers of PROTOCOL.md over a line: one at a time, in order, each with a time limit.
//
//   waiting in the queue --sent--> under way --answer--> resolved, or rejected with the board's ERR
//                                     |
//                                     +--time over--> rejected; late answers to it are dropped until the line is settled

import type { Clock } from './clock.ts';
import { EditDialog } from './edit-dialog.ts';
import { EditScreen } from './edit-screen.ts';
import type { Line } from './line.ts';
import { isAnswer } from './line-parser.ts';
import { RobotError } from './robot-error.ts';
import { typedLine } from './typed-line.ts';

const ANSWER_MS = 1000;
/** After a time-out nothing is sent for so long, or until the late answer has come: it must not answer the next one. */
const SETTLE_MS = 500;
/** A line that was left half typed holds questions back for so long after its last key. */
const TYPING_MS = 5000;
/** Ctrl-U empties the line, in every image; Enter leaves the empty line, which Edit wants before a question. */
export const EMPTY_LINE = '\x15\r';

export interface RequestOptions {
    readonly timeoutMs?: number;
    readonly signal?: AbortSignal;
    /** Goes first, and waits for no half-typed line: that is emptied. */
    readonly isUrgent?: boolean;
}

interface Request {
    readonly text: string;
    readonly timeoutMs: number;
    readonly resolve: (answer: string) => void;
    readonly reject: (error: RobotError) => void;
}

export class Requests {
    private readonly line: Pick<Line, 'write' | 'expect' | 'forget'>;
    private readonly clock: Clock;
    private readonly queue: Request[] = [];
    private current: Request | null = null;
    private abandoned: string | null = null;
    private cancelTimer: () => void = () => undefined;
    private typing = '';
    private isHeld = false;
    private cancelHold: () => void = () => undefined;
    private isEnded = false;
    private readonly dialog: EditDialog;
    /** What these questions put away. */
    readonly screen: EditScreen;

    /** dialog: whoever has the line tells it what is typed and heard; when it changes, call dialogChanged(). */
    constructor(line: Pick<Line, 'write' | 'expect' | 'forget'>, clock: Clock, dialog = new EditDialog(clock, () => undefined)) {
        this.line = line;
        this.clock = clock;
        this.dialog = dialog;
        this.screen = new EditScreen(
            clock,
            () => !this.current && this.abandoned === null && this.queue.length === 0 && this.typing === '' && !dialog.isOpen,
            keys => void line.write(new TextEncoder().encode(keys)).catch(() => undefined),
        ); // a lost line has no screen
    }

    /** Sends a request, `@where` for example; resolves to the words between its own first word and OK.
     *  Rejects with RobotError: refused, no-answer, not-connected, port-lost, cancelled, edit-waits. */
    ask(text: string, options: RequestOptions = {}): Promise<string> {
        return new Promise((resolve, reject) => {
            if (this.isEnded) return reject(new RobotError('not-connected'));
            const request = { text, timeoutMs: options.timeoutMs ?? ANSWER_MS, resolve, reject };
            options.signal?.addEventListener('abort', () => this.cancel(request), { once: true });
            if (options.signal?.aborted) return reject(new RobotError('cancelled'));
            if (options.isUrgent) this.queue.unshift(request);
            else this.queue.push(request);
            this.isHeld &&= !options.isUrgent;
            this.next();
        });
    }

    /** A person's keys have gone down the line. While a line is half typed nothing is asked: until it ends, or five seconds after its last
     *  key. What is under way goes on. */
    typed(keys: string): void {
        this.screen.typed(keys);
        this.holdFor(typedLine(this.typing, keys));
        this.next();
    }

    /** What was typed meanwhile was for the dialog: when it ends no line is half typed. */
    dialogChanged(): void {
        if (!this.dialog.isOpen) this.holdFor('');
        this.next();
    }

    /** Somebody is typing, or Edit waits for an answer: a question would only wait. */
    get isHeldOff(): boolean {
        return this.isHeld || this.dialog.isOpen;
    }

    /** An answer line has come. */
    take(line: string): void {
        if (this.abandoned !== null && isAnswer(this.abandoned, line)) {
            this.settle();
            return;
        }
        const request = this.current;
        if (!request || !isAnswer(request.text, line)) return; // nobody asked
        this.finish();
        const word = request.text.split(' ', 1)[0] ?? '';
        const refusal = / ERR (\d+) (.*)$/.exec(line);
        if (refusal) request.reject(new RobotError('refused', refusal[2] ?? '', { number: Number(refusal[1]) }));
        else request.resolve(line.slice(word.length, -' OK'.length).trim());
        this.next();
    }

    /** The line is gone: everything that waits is rejected, and so is what comes later. */
    end(code: 'port-lost' | 'not-connected'): void {
        this.isEnded = true;
        this.cancelTimer();
        this.cancelHold();
        this.screen.end();
        const all = this.current ? [this.current, ...this.queue] : [...this.queue];
        this.current = null;
        this.queue.length = 0;
        for (const request of all) request.reject(new RobotError(code));
    }

    private holdFor(typing: string): void {
        this.cancelHold();
        this.typing = typing;
        this.isHeld = typing !== '';
        if (!this.isHeld) return;
        this.cancelHold = this.clock.after(TYPING_MS, () => {
            this.isHeld = false;
            this.next();
        });
    }

    private refuseAll(): void {
        for (const request of this.queue.splice(0)) request.reject(new RobotError('edit-waits'));
    }

    private next(): void {
        if (this.dialog.isLong) this.refuseAll(); // done later, it would surprise
        if (this.current || this.abandoned !== null || this.isHeldOff) return;
        const request = this.queue.shift();
        if (!request) return;
        this.current = request;
        this.line.expect(request.text);
        this.screen.asked();
        this.cancelTimer = this.clock.after(request.timeoutMs, () => this.timeOut(request));
        const isLeft = this.typing !== '' || this.dialog.hasLine;
        const bytes = new TextEncoder().encode(`${isLeft ? EMPTY_LINE : ''}${request.text}\r`); // what was left is no part of it
        this.typing = '';
        this.line.write(bytes).catch((cause: unknown) => {
            if (this.current !== request) return;
            this.line.forget();
            this.finish();
            request.reject(cause instanceof RobotError ? cause : new RobotError('port-lost', '', { cause }));
            this.next();
        });
    }

    private finish(): void {
        this.cancelTimer();
        this.current = null;
    }

    private timeOut(request: Request): void {
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
        this.abandoned = request.text;
        this.cancelTimer = this.clock.after(SETTLE_MS, () => {
            this.line.forget();
            this.settle();
        });
        request.reject(error);
    }

    private settle(): void {
        this.cancelTimer();
        this.abandoned = null;
        this.next();
    }
}
