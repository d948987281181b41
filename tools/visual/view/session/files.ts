// SPDX-License-Identifier: MIT
// Files and links as the views see them. app/files.ts is behind it.

import type { FileFormats, Refused, Suffix } from '../../model/file-formats.ts';
import type { Store } from '../store.ts';

/** A motion file that was read, before anything of it is taken over. */
export interface OpenedFile {
    readonly name: string;
    /** 65,536 bytes. */
    readonly image: Uint8Array;
    readonly notes: readonly string[];
    readonly losses: readonly string[];
    /** Pages of motions in it, and how many of them are damaged. */
    readonly count: number;
    readonly damaged: number;
    /** It brings a page 0: the trim of the robot that it was made on. */
    readonly hasTrim: boolean;
}

/** Motions that came in the address of the page. */
export interface SentMotion {
    readonly name: string;
    readonly pages: ReadonlyMap<number, Uint8Array>;
}

/** A file that a person has chosen or dropped; nothing of it was read yet. */
export interface ChosenFile {
    readonly name: string;
    readonly size: number;
    arrayBuffer(): Promise<ArrayBuffer>;
}

export interface FilesState {
    /** What is being done, in words; null: nothing. */
    readonly busy: string | null;
    readonly opened: OpenedFile | null;
    /** A file with pages that have no room among 128, and which. */
    readonly tooLarge: { readonly name: string; readonly pages: string } | null;
    readonly sent: SentMotion | null;
    /** One sentence for what went wrong. */
    readonly trouble: string | null;
}

/** A file that somebody only looks at; `text` says why it could not be read. Cancelled: somebody had enough of it. */
export type LookedAt = { readonly kind: 'read'; readonly image: Uint8Array } | Refused | { readonly kind: 'cancelled' };

export interface SavedFile {
    readonly name: string;
    readonly bytes: Uint8Array;
    readonly losses: readonly string[];
}

export interface Files {
    /** m512 itself, for those who only want to know: what a file holds, how two images differ, what is wrong with one. */
    readonly formats: FileFormats;
    readonly state: Store<FilesState>;
    /** Opens it, unless it is too large for any motion file. */
    choose(file: ChosenFile): Promise<void>;
    open(name: string, bytes: Uint8Array): Promise<void>;
    /** Reads it for somebody who only looks: of the state only `busy` changes. */
    look(file: ChosenFile): Promise<LookedAt>;
    /** Ends what is being read or written; nothing was changed. */
    cancel(): void;
    /** The same file, without the pages that have no room. */
    openWithoutRest(): Promise<void>;
    /** Its whole motions go into free pages, links and all; what is there already stays. One undo step. */
    addOpened(): void;
    /** It becomes a document of its own, trim and all. */
    createFromOpened(): Promise<void>;
    /** All its pages take the places of the document's: one undo step. */
    replaceAll(withTrim: boolean): void;
    /** Puts what was opened or sent away; nothing of it was taken. */
    dismiss(): void;
    /** Null: refused, `trouble` says why. */
    save(suffix: Suffix): Promise<SavedFile | null>;
    /** The address that holds the selected page and those that it leads to; null: it has none, or too many; `trouble` says which. */
    link(): Promise<string | null>;
    /** Puts what was sent into free pages; returns the number of the first, 0: there was no room. */
    addSent(): number;
}
