// SPDX-License-Identifier: MIT
// Pages between the document and a robot, as the views see it. app/transfer.ts is behind it.

import type { PageAccount } from '../../robot/page-write.ts';
import type { RobotError } from '../../robot/robot-error.ts';
import type { Store } from '../store.ts';

export interface TransferState {
    /** stopped: something went wrong in mid-way; `trouble` says what, and tryAgain() goes on. */
    readonly phase: 'idle' | 'reading' | 'writing' | 'stopped' | 'written';
    /** Pages done, of how many. */
    readonly done: number;
    readonly total: number;
    /** Of the write under way or of the last one, by page. */
    readonly account: ReadonlyMap<number, PageAccount>;
    readonly trouble: string | null;
}

/** How a transfer ended. `trouble` of the state says the error in words, unless it is transfer-busy: then the one under way goes on. */
export type TransferEnd = { readonly isDone: true } | { readonly isDone: false; readonly error: RobotError };

export interface Transfer {
    readonly state: Store<TransferState>;
    /** Reads what the robot has; what is known of it needs no time. */
    read(): Promise<TransferEnd>;
    /** Writes these pages of the document, after a backup of the robot. */
    write(pages: readonly number[]): Promise<TransferEnd>;
    /** Goes on with what was stopped. */
    tryAgain(): Promise<TransferEnd>;
    /** Stops at once, or between two pages. */
    cancel(): void;
}
