// SPDX-License-Identifier: MIT
// The programs' channel of firmware/common/PROTOCOL.md. Frames requests, and separates the board's bytes into text for people, answers for
// the program, and flow control. Pure: state and bytes in, state and events out. The events do not depend on how the bytes are split.
//
//   request   BEGIN "@where " CRC-16 CR        answer   BEGIN "@where state=idle ... OK" CR LF

const XON = 0x11;
const XOFF = 0x13;
const BEGIN = 0x1e;
const LF = 0x0a;
const LINE_MAX = 8192; // the longest answer is @list of 128 pages, about 4 KB

export type LineEvent =
    | { readonly kind: 'text'; readonly bytes: Uint8Array }
    | { readonly kind: 'answer'; readonly line: string }
    | { readonly kind: 'flow'; readonly go: boolean };

/** The received part of an answer; null: outside an answer. */
export type LineState = string | null;

/** CRC-16/IBM-3740: "123456789" gives 0x29B1. */
function crc16(text: string): number {
    let crc = 0xffff;
    for (const letter of text) {
        crc ^= letter.charCodeAt(0) << 8;
        for (let bit = 0; bit < 8; bit++) crc = ((crc << 1) ^ (crc & 0x8000 ? 0x1021 : 0)) & 0xffff;
    }
    return crc;
}

/** The bytes of a request, "@where" for example. */
export function framed(request: string): Uint8Array {
    const text = `${request} `;
    const crc = crc16(text).toString(16).toUpperCase().padStart(4, '0');
    return new TextEncoder().encode(`${String.fromCharCode(BEGIN)}${text}${crc}\r`);
}

/** Whether a line is the complete answer to a request: it starts with the same word and ends with OK or ERR n text. A request that lost
 *  bytes is refused with ERR 15, and then the word itself may be damaged. */
export function isAnswer(request: string, line: string): boolean {
    const word = request.split(' ', 1)[0] ?? '';
    if (line.includes(' ERR 15 ')) return true;
    if (line !== word && !line.startsWith(`${word} `)) return false;
    return line.endsWith(' OK') || / ERR \d+ /.test(line);
}

/** Takes received bytes. Returns the new state and the events in them. */
export function parseLine(state: LineState, bytes: Uint8Array): readonly [LineState, readonly LineEvent[]] {
    const events: LineEvent[] = [];
    let text: number[] = [];
    let held = state;
    const emit = (event: LineEvent | null): void => {
        if (text.length > 0) events.push({ kind: 'text', bytes: Uint8Array.from(text) });
        text = [];
        if (event) events.push(event);
    };
    for (const byte of bytes) {
        if (byte === XON || byte === XOFF) emit({ kind: 'flow', go: byte === XON });
        else if (byte === BEGIN) held = '';
        else if (held === null) text.push(byte);
        else if (byte === LF || held.length === LINE_MAX) {
            emit({ kind: 'answer', line: held.replace(/\r$/, '') });
            held = null;
        } else held += String.fromCharCode(byte);
    }
    emit(null);
    return [held, events];
}
