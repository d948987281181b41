// SPDX-License-Identifier: MIT
// Errors between the page and a board. The message of each code is in view/texts/.

export type RobotErrorCode =
    | 'no-answer' // the board did not answer in time
    | 'refused' // the board answered ERR; number and text are in `number` and `words`
    | 'not-connected' // no port is open
    | 'port-lost' // the cable was pulled or the port failed
    | 'no-serial' // this browser has no Web Serial
    | 'plain-http' // browsers offer Web Serial to pages of https and localhost only
    | 'old-browser' // no JavaScript Promise Integration, which lets a program in C wait; My servos needs it
    | 'port-busy' // the port cannot be opened: another program has it, or no permission
    | 'adapter-out' // the servo adapter is unplugged, so no program for My servos can start
    | 'second-tab' // another tab of this page drives My servos
    | 'foreign' // something else answers
    | 'other-board' // a boot loader named another board, which is in `words`
    | 'in-loader' // the boot loader waits at its prompt
    | 'no-image' // the firmware for the robot in the page could not be loaded
    | 'new-version' // it is not on the host any more: a newer version of the page has replaced it
    | 'was-hidden' // the page was hidden while it drove servos; the play was ended
    | 'servo-failed' // in a move of live follow; the IDs are in `words`
    | 'goes-on' // the robot that was left for the one in the page still moves
    | 'cancelled' // somebody cancelled it
    | 'dropped' // the robot was switched off, reset or restarted before it could do it
    | 'text-dropped' // the robot was to stop, or was restarted, while a pasted text was being sent
    | 'page-changed' // a page of the robot has changed since it was read; its number is in `words`
    | 'page-unsaved' // the page in Edit's memory has somebody else's edits
    | 'time-stands' // the time of the robot in the page stands still, so it cannot say whether edits would be lost
    | 'page-mixed' // likewise, perhaps on a page that this page has half sent; its number is in `words`
    | 'save-failed' // the board cannot save pages
    | 'save-pending' // the board has half saved this page, and saves no other until it is restarted; its number is in `words`
    | 'pages-refused' // the board saves pages, but not all of them; the numbers of those are in `words`
    | 'page-not-saved' // after a save the robot still has other pages; their numbers are in `words`
    | 'no-backup' // the robot's pages could not be stored here, so nothing was written
    | 'needs-edit' // Play runs, but only Edit saves pages; the board is in `words`
    | 'transfer-busy' // pages are being read or written; one transfer at a time
    | 'pages-differ' // these pages differ between robot and document, and are not written without consent
    | 'damaged-here' // a page of the document is damaged and cannot be written; its number is in `words`
    | 'layer-differs'; // as pages-differ, for a page to lay over a play

/** The error of every rejection in this folder. `words`: the board's text, if any. */
export class RobotError extends Error {
    readonly code: RobotErrorCode;
    readonly words: string;
    /** The ERR number, if the robot has answered with one, else 0. */
    readonly number: number;

    constructor(code: RobotErrorCode, words = '', options: { cause?: unknown; number?: number } = {}) {
        super(words === '' ? code : `${code}: ${words}`, { cause: options.cause });
        this.name = 'RobotError';
        this.code = code;
        this.words = words;
        this.number = options.number ?? 0;
    }
}
