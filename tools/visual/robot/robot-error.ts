// SPDX-License-Identifier: MIT
// What can go wrong between the page and a board. The sentence for each code stands in view/texts/.

export type RobotErrorCode =
    | 'no-answer' // the board said nothing within the time
    | 'refused' // the board answered ERR: its number and words are in `words`
    | 'not-connected' // there is no open port
    | 'port-lost' // the cable was pulled, or the port died
    | 'no-serial' // this browser has no Web Serial
    | 'old-browser' // it cannot let a program in C wait (JavaScript Promise Integration), which My servos needs
    | 'port-busy' // the port cannot be opened: another program has it, or no permission
    | 'foreign' // something else answers there
    | 'other-board' // a boot loader has said the name of another board: it is in `words`
    | 'in-loader' // the boot loader waits at its prompt
    | 'no-image' // the firmware for the robot in the page could not be loaded
    | 'was-hidden' // the page that drives servos was hidden: what played was ended
    | 'cancelled' // somebody stopped it
    | 'page-changed' // a page of the robot is no longer what it was when it was read: its number is in `words`
    | 'page-unsaved' // the page in Edit's memory has edits of somebody else
    | 'page-not-saved' // after a save the robot still has another page: its number is in `words`
    | 'no-backup' // the robot's pages could not be kept here, so nothing was written
    | 'needs-edit' // Play runs there, and only Edit saves pages
    | 'transfer-busy' // pages are being read or written: one transfer at a time
    | 'pages-differ' // the robot has these pages otherwise than the document, and they are not written without being asked
    | 'damaged-here' // a page of the document is damaged and cannot be written: its number is in `words`
    | 'layer-differs'; // the same, for a page that is to be laid over a play

/** Every rejection of this folder. `words`: what the board said, if it said anything. */
export class RobotError extends Error {
    readonly code: RobotErrorCode;
    readonly words: string;
    /** The ERR number of a refusal, else 0. */
    readonly number: number;

    constructor(code: RobotErrorCode, words = '', options: { cause?: unknown; number?: number } = {}) {
        super(words === '' ? code : `${code}: ${words}`, { cause: options.cause });
        this.name = 'RobotError';
        this.code = code;
        this.words = words;
        this.number = options.number ?? 0;
    }
}
