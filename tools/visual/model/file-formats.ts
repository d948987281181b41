// SPDX-License-Identifier: MIT
// Motion files from the page's view. m512 (Python, in Pyodide) reads and writes them, so files, losses and messages are the same as on the
// command line. An image is 65,536 bytes: pages 0..127 as in flash.

/** `notes`: decisions that m512 made; `losses`: what the new form cannot represent. */
export interface Opened {
    readonly kind: 'opened';
    readonly image: Uint8Array;
    readonly notes: readonly string[];
    readonly losses: readonly string[];
}

export interface Saved {
    readonly kind: 'saved';
    readonly file: Uint8Array;
    readonly losses: readonly string[];
}

/** Some of the user's pages do not fit into the 128. Open again with leaveOut to drop them. */
export interface NoRoom {
    readonly kind: 'no-room';
    readonly pages: string;
}

/** The file cannot be read as motions, or the format cannot hold the image. text: one sentence from m512. */
export interface Refused {
    readonly kind: 'refused';
    readonly text: string;
}

export interface Finding {
    readonly page: number;
    readonly text: string;
    /** false: valid, but may surprise. */
    readonly isFault: boolean;
}

export interface Difference {
    readonly page: number;
    readonly text: string;
}

/** Suffixes of the formats that can be written. */
export const SUFFIXES = ['.m512', '.bin', '.hex', '.mtn'] as const;
export type Suffix = (typeof SUFFIXES)[number];

/** Largest motion file, m512's own limit (files/storage.py). */
export const MOST_BYTES = 4 << 20;

/** The first call loads Python (5 MB, 2 to 4 s). Later calls take 0.1 to 0.6 s. They reject with Error if it cannot be loaded. */
export interface FileFormats {
    /** Like `m512 convert NAME image.bin`. leaveOut: drop the pages that do not fit. */
    open(name: string, data: Uint8Array, leaveOut?: boolean): Promise<Opened | NoRoom | Refused>;
    /** Like `m512 convert image.bin NAME`. */
    save(name: string, image: Uint8Array): Promise<Saved | Refused>;
    /** The findings of `m512 pages image.bin check`. */
    check(image: Uint8Array): Promise<readonly Finding[]>;
    /** The output of `m512 diff`. */
    differences(first: Uint8Array, second: Uint8Array): Promise<readonly Difference[]>;
}

/** Runs in a worker, so that a long operation can be cancelled. */
export interface FormatsWorker extends FileFormats {
    /** Cancels what is being opened or saved: those promises reject. A new worker answers all other requests. */
    cancel(): void;
}
