// SPDX-License-Identifier: MIT
// Separates what a board sends into text for people, answers for the program, and flow control. Pure: state and bytes
// in, state and events out; every split of the bytes gives the same events.
//
// Play echoes a request after its prompt and prints a new prompt after the answer; Edit echoes nothing:
//
//     Play   "@where\r\n" "@where state=idle ... OK\r\n" "] "        Edit   "\r\n" "@where state=idle ... OK\r\n"
//            echo         answer                         prompt                     answer
//
// With no request under way everything is text. Otherwise:
//
//            '@' where a line or a word after "] " begins; behind other text (Edit draws its screen without line ends)
//            only as long as it may become an answer
//   TEXT  ------------------------------------------------>  HELD
//     ^                                                       |
//     |   CR or LF: echo of the request, its answer, or text  |
//     +-------------------------------------------------------+
//   An echo is dropped, and so is the prompt behind an answer whose echo was dropped: the prompt before it still stands.

const XON = 0x11;
const XOFF = 0x13;
const CR = 0x0d;
const LF = 0x0a;
const AT = 0x40;
const PROMPT = '] ';
const LINE_MAX = 8192; // @list of 128 pages is the longest answer, about 4 KB

export type LineEvent =
    | { readonly kind: 'text'; readonly bytes: Uint8Array }
    | { readonly kind: 'answer'; readonly line: string }
    | { readonly kind: 'flow'; readonly go: boolean };

export interface LineState {
    /** Requests that were sent and not answered, oldest first. */
    readonly pending: readonly string[];
    /** The bytes of the present line that came before what is held: "" at its beginning, PROMPT behind a prompt. */
    readonly before: string;
    /** A line that may be ours: bytes from its '@' on. */
    readonly held: string;
    /** Line ends behind a dropped line are dropped, and then this text, if it comes. */
    readonly drop: 'nothing' | 'line-end' | 'line-end-and-prompt';
    readonly echoSeen: boolean;
}

export const LINE_START: LineState = { pending: [], before: '', held: '', drop: 'nothing', echoSeen: false };

/** A request was sent (without its CR): from now on its echo and its answer are not text. */
export function expectAnswer(state: LineState, request: string): LineState {
    return { ...state, pending: [...state.pending, request] };
}

/** The oldest request will not be answered. */
export function forgetAnswer(state: LineState): LineState {
    return { ...state, pending: state.pending.slice(1) };
}

/** True when a line is the whole answer to a request: the same word first, OK or ERR n text at the end. */
export function isAnswer(request: string, line: string): boolean {
    const word = request.split(' ', 1)[0] ?? '';
    if (line !== word && !line.startsWith(`${word} `)) return false;
    return line.endsWith(' OK') || / ERR \d+ /.test(line);
}

function mayBecomeAnswer(request: string, held: string): boolean {
    const word = `${request.split(' ', 1)[0] ?? ''} `;
    return word.startsWith(held) || held.startsWith(word);
}

/** Takes bytes as they came; returns the new state and what they were. */
export function parseLine(state: LineState, bytes: Uint8Array): readonly [LineState, readonly LineEvent[]] {
    const run = new Run(state);
    for (const byte of bytes) run.take(byte);
    return run.end();
}

class Run {
    private state: LineState;
    private readonly events: LineEvent[] = [];
    private text: number[] = [];

    constructor(state: LineState) {
        this.state = state;
    }

    take(byte: number): void {
        if (byte === XON || byte === XOFF) this.emit({ kind: 'flow', go: byte === XON });
        else if (this.state.held !== '') this.hold(byte);
        else if (!this.isDropped(byte)) this.pass(byte);
    }

    end(): readonly [LineState, readonly LineEvent[]] {
        this.flush();
        return [this.state, this.events];
    }

    private set(change: Partial<LineState>): void {
        this.state = { ...this.state, ...change };
    }

    private isDropped(byte: number): boolean {
        const { drop, before } = this.state;
        if (drop === 'nothing') return false;
        if (byte === CR || byte === LF) {
            if (before === '') return true; // CR LF behind the dropped line
            this.set({ drop: 'nothing' });
            return false;
        }
        const next = before + String.fromCharCode(byte);
        if (drop === 'line-end-and-prompt' && PROMPT.startsWith(next)) {
            this.set(next === PROMPT ? { drop: 'nothing', before: next } : { before: next });
            return true;
        }
        // Something else came: what was taken for a prompt is given back.
        for (const character of before) this.text.push(character.charCodeAt(0));
        this.set({ drop: 'nothing' });
        return false;
    }

    private pass(byte: number): void {
        const { before, pending } = this.state;
        if (byte === AT && pending.length > 0) {
            this.set({ held: '@' });
            return;
        }
        this.text.push(byte);
        if (byte === CR || byte === LF) this.set({ before: '' });
        else if (before.length < PROMPT.length + 1) this.set({ before: before + String.fromCharCode(byte) });
    }

    private hold(byte: number): void {
        if (byte === CR || byte === LF) {
            this.lineEnd(byte);
            return;
        }
        const held = this.state.held + String.fromCharCode(byte);
        const isBehindText = this.state.before !== '' && this.state.before !== PROMPT;
        const mayAnswer = !isBehindText || this.state.pending.some(request => mayBecomeAnswer(request, held));
        if (held.length > LINE_MAX || !mayAnswer) this.release(held);
        else this.set({ held });
    }

    private lineEnd(byte: number): void {
        const { held, pending } = this.state;
        const answered = pending.findIndex(request => isAnswer(request, held));
        if (answered >= 0) {
            this.emit({ kind: 'answer', line: held });
            const drop = this.state.echoSeen ? 'line-end-and-prompt' : 'line-end';
            this.set({ held: '', before: '', pending: pending.slice(answered + 1), drop, echoSeen: false });
        } else if (pending.some(request => request.startsWith(held))) {
            this.set({ held: '', before: '', drop: 'line-end', echoSeen: true });
        } else {
            this.release(held);
            this.take(byte);
        }
    }

    private release(held: string): void {
        for (const character of held) this.text.push(character.charCodeAt(0));
        this.set({ held: '', before: held.slice(0, PROMPT.length + 1) });
    }

    private emit(event: LineEvent): void {
        this.flush();
        this.events.push(event);
    }

    private flush(): void {
        if (this.text.length > 0) this.events.push({ kind: 'text', bytes: Uint8Array.from(this.text) });
        this.text = [];
    }
}
