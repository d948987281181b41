// SPDX-License-Identifier: MIT
// Interface of the views to the documents stored in this browser. app/documents.ts implements it.

import type { Backup } from '../document-storage.ts';
import type { MotionDocument } from '../../model/document.ts';
import type { Store } from '../store.ts';

export interface DocumentEntry {
    readonly id: string;
    readonly name: string;
    readonly savedMs: number;
}

export interface DocumentsState {
    /** Includes the open one. */
    readonly documents: readonly DocumentEntry[];
    readonly openId: string;
    readonly backups: readonly Backup[];
    /** Names of stored entries that cannot be read. */
    readonly unreadable: readonly string[];
    /** Number of the oldest steps of the open document's history that are no longer stored. */
    readonly forgotten: number;
    /** 'off': this browser stores nothing, or not the last version of each document. */
    readonly saving: 'saved' | 'saving' | 'off';
}

export interface Documents {
    readonly state: Store<DocumentsState>;
    /** Creates and opens a document with the pages of `from`; without it all pages are empty. A name that is taken is numbered. */
    create(name: string, from?: MotionDocument): Promise<void>;
    open(id: string): Promise<void>;
    /** Renames the open one. A name that is taken is numbered. */
    rename(name: string): void;
    /** Removes a document. If it is open, the newest of the others is opened. Cannot be undone: ask first. */
    remove(id: string): Promise<void>;
    /** Reads another document, to compare with. null: it no longer exists. */
    read(id: string): Promise<MotionDocument | null>;
}
