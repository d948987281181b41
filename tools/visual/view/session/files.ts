// SPDX-License-Identifier: MIT
// Interface of the views to files and links. app/files.ts implements it.

import type { FileFormats, Refused, Suffix } from '../../model/file-formats.ts';
import type { Store } from '../store.ts';

/** A motion file that was read but not yet imported. */
export interface OpenedFile {
    readonly name: string;
    /** 65,536 bytes. */
    readonly image: Uint8Array;
    readonly notes: readonly string[];
    readonly losses: readonly string[];
    /** Number of motion pages; `damaged` of them are damaged. */
    readonly count: number;
    readonly damaged: number;
    /** It contains page 0: the trim of the robot that it was made on. */
    readonly hasTrim: boolean;
}

/** Motions from the page's address. */
export interface SentMotion {
    readonly name: string;
    readonly pages: ReadonlyMap<number, Uint8Array>;
}

/** A file that the user chose or dropped; not read yet. */
export interface ChosenFile {
    readonly name: string;
    readonly size: number;
    arrayBuffer(): Promise<ArrayBuffer>;
}

export interface FilesState {
    /** Description of what is being read or made; null: nothing. */
    readonly busy: string | null;
    readonly opened: OpenedFile | null;
    /** A file with pages beyond the 128 that fit; `pages` lists them. */
    readonly tooLarge: { readonly name: string; readonly pages: string } | null;
    readonly sent: SentMotion | null;
    /** What went wrong, in one sentence. */
    readonly trouble: string | null;
    /** Why there was nothing to do; `name` is of the file. */
    readonly done: { readonly name: string; readonly text: string } | null;
}

/** Result of reading a file only to view it. Refused: `text` says why it could not be read. */
export type LookedAt = { readonly kind: 'read'; readonly image: Uint8Array } | Refused | { readonly kind: 'cancelled' };

export interface SavedFile {
    readonly name: string;
    readonly bytes: Uint8Array;
    readonly losses: readonly string[];
}

export interface Files {
    /** m512 for queries that change nothing: contents of a file, differences of two images, faults of one. */
    readonly formats: FileFormats;
    readonly state: Store<FilesState>;
    /** Opens a file unless it is larger than any motion file can be. Several are refused: each is looked at before anything is imported. */
    choose(file: ChosenFile, ...others: readonly ChosenFile[]): Promise<void>;
    open(name: string, bytes: Uint8Array): Promise<void>;
    /** Reads a file only to view it; the state does not change. */
    look(file: ChosenFile): Promise<LookedAt>;
    /** Cancels the running read or write; nothing changes. */
    cancel(): void;
    /** Opens the file that is too large, without the pages that do not fit. */
    openWithoutRest(): Promise<void>;
    /** Copies the opened file's intact pages with their links into free pages. Existing pages stay. One undo step. */
    addOpened(): void;
    /** Makes a new document of the opened file, including its trim. */
    createFromOpened(): Promise<void>;
    /** Replaces all pages of the document by the opened file's, page 0 only withTrim. One undo step. */
    replaceAll(withTrim: boolean): void;
    /** Drops the opened file or sent motion without importing it. */
    dismiss(): void;
    /** null: refused; `trouble` says why. */
    save(suffix: Suffix): Promise<SavedFile | null>;
    /** Address fragment with the selected page and the pages that it leads to. null: there is nothing to send, or too much; `trouble` says
     *  which. */
    link(): Promise<string | null>;
    /** Copies the sent motion into free pages. Returns the number of the first; 0: no space. */
    addSent(): number;
}
