// SPDX-License-Identifier: MIT
// The documents that this browser keeps, as the views see them. app/documents.ts is behind it.

import type { Backup } from '../document-storage.ts';
import type { MotionDocument } from '../../model/document.ts';
import type { Store } from '../store.ts';

export interface DocumentEntry {
    readonly id: string;
    readonly name: string;
    readonly savedMs: number;
}

export interface DocumentsState {
    /** The open one is among them. */
    readonly documents: readonly DocumentEntry[];
    readonly openId: string;
    readonly backups: readonly Backup[];
    /** Names of what is kept but cannot be read. */
    readonly unreadable: readonly string[];
    /** So many of the oldest steps of the open one's history are not kept any more. */
    readonly forgotten: number;
    /** 'off': this browser keeps nothing. */
    readonly saving: 'saved' | 'saving' | 'off';
}

export interface Documents {
    readonly state: Store<DocumentsState>;
    /** Opens a new one of that name, with these pages; without them all pages are empty. */
    create(name: string, from?: MotionDocument): Promise<void>;
    open(id: string): Promise<void>;
    rename(name: string): void;
    /** The open one; the newest of the others takes its place. Cannot be undone: ask first. */
    remove(): Promise<void>;
    /** The pages of another document, to compare with. null: it is not there any more. */
    read(id: string): Promise<MotionDocument | null>;
}
