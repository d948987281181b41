// SPDX-License-Identifier: MIT
// Motion files as the page sees them. m512 (Python, in Pyodide) reads and writes them, so that every file, loss and sentence is
// the same here and on the command line. An image is 65,536 bytes: pages 0..127 as they lie in flash.

/** What reading or writing said: `notes` what it had to decide, `losses` what the new form cannot say. */
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

/** Pages of the user's have no room among 128; to open it without them, say so. */
export interface NoRoom {
    readonly kind: 'no-room';
    readonly pages: string;
}

/** A file that cannot be read as motions, or an image that the format cannot hold: one sentence of m512's. */
export interface Refused {
    readonly kind: 'refused';
    readonly text: string;
}

export interface Finding {
    readonly page: number;
    readonly text: string;
    /** false: right, but may surprise. */
    readonly isFault: boolean;
}

export interface Difference {
    readonly page: number;
    readonly text: string;
}

/** Suffixes that can be written. */
export const SUFFIXES = ['.m512', '.bin', '.hex', '.mtn'] as const;
export type Suffix = (typeof SUFFIXES)[number];

/** No motion file is larger: m512's own bound (files/storage.py). */
export const MOST_BYTES = 4 << 20;

/** The first call loads Python (5 MB, 2 to 4 s); later ones take 0.1 to 0.6 s. Rejects with Error when it cannot be loaded. */
export interface FileFormats {
    /** What `m512 convert NAME image.bin` makes. leaveOut: without the pages that have no room. */
    open(name: string, data: Uint8Array, leaveOut?: boolean): Promise<Opened | NoRoom | Refused>;
    /** What `m512 convert image.bin NAME` makes. */
    save(name: string, image: Uint8Array): Promise<Saved | Refused>;
    /** What `m512 pages image.bin check` says. */
    check(image: Uint8Array): Promise<readonly Finding[]>;
    /** What `m512 diff` says. */
    differences(first: Uint8Array, second: Uint8Array): Promise<readonly Difference[]>;
}

/** In a worker, so that what takes long can be ended. */
export interface FormatsWorker extends FileFormats {
    /** Ends what is being opened or saved: those promises reject. What else was asked is answered, by a new worker. */
    cancel(): void;
}
