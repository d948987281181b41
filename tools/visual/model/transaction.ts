// SPDX-License-Identifier: MIT
// An edit as a value: the changed pages before and after. Its inverse swaps the two.

import { isSamePage } from './document.ts';

/** The kinds of edits. Their names for people are in view/texts/. */
export const EDIT_NAMES = [
    'set-joints',
    'insert-step',
    'delete-steps',
    'duplicate-steps',
    'move-steps',
    'paste-steps',
    'set-time',
    'set-pause',
    'mirror-steps',
    'exchange-steps',
    'interpolate',
    'rename',
    'set-header',
    'set-link',
    'copy-page',
    'move-page',
    'swap-pages',
    'clear-page',
    'replace-page',
    'replace-pages',
    'drag',
] as const;
export type EditName = (typeof EDIT_NAMES)[number];

export interface Change {
    readonly page: number;
    readonly before: Uint8Array;
    readonly after: Uint8Array;
}

export interface Transaction {
    readonly label: EditName;
    readonly changes: readonly Change[];
}

export function inverse(transaction: Transaction): Transaction {
    return { ...transaction, changes: transaction.changes.map(({ page, before, after }) => ({ page, before: after, after: before })) };
}

/** Makes a transaction and drops changes without effect. */
export function transaction(label: EditName, changes: readonly Change[]): Transaction {
    return { label, changes: changes.filter(({ before, after }) => !isSamePage(before, after)) };
}
