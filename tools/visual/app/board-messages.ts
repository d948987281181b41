// SPDX-License-Identifier: MIT
// The last complete line that the board sent unasked, for the status bar. Prompts, echoes, bare OKs, late answers and the escape sequences
// of a full screen are not messages. Reports of the playing step are not either: the status bar shows the step separately, and Edit counts
// steps from 0.

const LINE_MAX = 200;
const TELLS_TROUBLE = /damaged|does not answer|no servo|overload|hot|voltage|is low|fault|lost|cannot|bad|not | late: | is gone/i;

/** Play prints these after a trouble. The line alone does not tell which. */
const ENDED = /^(Ended for the fault of a servo|Broken off)/;

const TELLS_STEP = /^(Page|Playing page) \d+( \(.*\))? step \d+ repetition \d+$/;

export interface BoardMessage {
    readonly text: string;
    readonly isTrouble: boolean;
}

export class BoardMessages {
    private line = '';
    private isScreen = false;
    private trouble = '';

    /** The newest message among these bytes, or null. */
    take(bytes: Uint8Array): BoardMessage | null {
        let newest: BoardMessage | null = null;
        for (const byte of bytes) {
            if (byte === 0x1b) this.isScreen = true; // a screen is being drawn until the next line begins
            if (byte === 0x0a || byte === 0x0d) {
                newest = this.end() ?? newest;
            } else if (this.line.length < LINE_MAX) {
                this.line += String.fromCharCode(byte);
            }
        }
        return newest;
    }

    private end(): BoardMessage | null {
        const text = this.line.trim();
        const isMessage =
            !this.isScreen &&
            text.length > 3 &&
            !text.startsWith('] ') &&
            !text.startsWith('@') &&
            !TELLS_STEP.test(text) &&
            /^[\x20-\x7e]+$/.test(text);
        this.line = '';
        this.isScreen = false;
        return isMessage ? this.messageOf(text) : null;
    }

    private messageOf(text: string): BoardMessage {
        const whole = ENDED.test(text) && this.trouble !== '' ? `${this.trouble}. ${text}` : text;
        const isTrouble = TELLS_TROUBLE.test(whole);
        this.trouble = isTrouble && !ENDED.test(text) ? text : '';
        return { text: whole, isTrouble };
    }
}
