// SPDX-License-Identifier: MIT
// The line that somebody is typing in the terminal: while it is half typed, a program's question would land in its middle.

/** What a terminal sends by itself, and the keys of Edit's screen: no part of a line. */
const ESCAPE_SEQUENCE = /\x1b\[[0-9;?]*[A-Za-z~]/g;
const ENDS = new Set(['\r', '\n', '\x03' /* Ctrl-C */, '\x15' /* Ctrl-U */]);
const TAKES_BACK = new Set(['\b', '\x7f']);

/** The line after these keys; '' when none is half typed. */
export function typedLine(before: string, keys: string): string {
    let line = before;
    for (const key of keys.replaceAll(ESCAPE_SEQUENCE, '')) {
        if (ENDS.has(key)) line = '';
        else if (TAKES_BACK.has(key)) line = line.slice(0, -1);
        else if (key >= ' ') line += key;
    }
    return line;
}
