// SPDX-License-Identifier: MIT
// Interface of the views to the transfer of pages between document and robot. app/transfer.ts implements it.

import type { MotionDocument } from '../../model/document.ts';
import type { PageAccount } from '../../robot/page-write.ts';
import type { RobotError } from '../../robot/robot-error.ts';
import type { Store } from '../store.ts';

export interface TransferState {
    /** stopped: an error or a cancel interrupted it; `trouble` says what, and tryAgain() continues. */
    readonly phase: 'idle' | 'reading' | 'writing' | 'stopped' | 'written';
    /** Number of pages done, of `total`. */
    readonly done: number;
    readonly total: number;
    /** State of the current or last write, by page. */
    readonly account: ReadonlyMap<number, PageAccount>;
    readonly trouble: string | null;
    /** The page of an earlier write that Edit's RAM had half, and has not any more; null: none. */
    readonly putBack: number | null;
}

/** How a transfer ended. The state's `trouble` describes the error, except transfer-busy: then another transfer is still running. */
export type TransferEnd = { readonly isDone: true } | { readonly isDone: false; readonly error: RobotError };

export interface Transfer {
    readonly state: Store<TransferState>;
    /** Reads the robot's pages; known ones are not read again. */
    read(): Promise<TransferEnd>;
    /** Backs up the robot, then writes these pages of the document. seen: the robot's pages that the person has compared; if one of them is
     *  another one by now (another board is on the cable, or somebody has saved it), nothing is written. shown: the document that it was
     *  compared with, of which the pages are; without it, the one that is open. */
    write(pages: readonly number[], seen?: readonly (Uint8Array | null)[], shown?: MotionDocument): Promise<TransferEnd>;
    /** Continues a stopped transfer. A write begins anew if the robot is another one by now: it is read, backed up and compared. If the
     *  document has other pages there by now, the robot is only read. */
    tryAgain(): Promise<TransferEnd>;
    /** Stops at once or between two pages. */
    cancel(): void;
}
