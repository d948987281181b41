// SPDX-License-Identifier: MIT
// Every sentence of the editor that is more than a label: names of edits, refusals.

import type { Refusal, RefusalCode } from '../../model/result.ts';
import type { EditName, Transaction } from '../../model/transaction.ts';

const EDITS: Record<EditName, string> = {
  'set-joints': 'pose', 'insert-step': 'new step', 'delete-steps': 'steps deleted', 'duplicate-steps': 'steps duplicated', 'move-steps': 'steps moved',
  'paste-steps': 'steps pasted', 'set-time': 'time', 'set-pause': 'pause', 'mirror-steps': 'mirror', 'exchange-steps': 'left and right exchanged',
  interpolate: 'step between', rename: 'name', 'set-header': 'page settings', 'set-link': 'link', 'copy-page': 'page copied', 'move-page': 'page moved',
  'swap-pages': 'pages exchanged', 'clear-page': 'page cleared', 'replace-page': 'page replaced', 'replace-pages': 'pages taken over', drag: 'drag',
};

/** What an undo would take back, for its button: "pose (page 12)". */
export function editText(edit: Transaction): string {
  const pages = edit.changes.map((change) => change.page);
  const where = pages.length === 1 ? `page ${pages[0]}` : `${pages.length} pages`;
  return `${EDITS[edit.label]} (${where})`;
}

const REFUSALS: Record<RefusalCode, string> = {
  'no-such-page': 'There is no such page; pages are 0 to 127:',
  'trim-page': 'Page 0 holds the trim of the robot, not a motion. Choose a page from 1 to 127.',
  'page-damaged': 'This page is damaged and cannot be edited. Clear it, or take it from a backup or a file: page',
  'page-in-use': 'There is a page already. Choose another place, or say that it may be replaced: page',
  'page-empty': 'There is nothing in that page: page',
  'no-such-step': 'The page has no such step:',
  'steps-full': 'A page holds seven steps. Put the others into another page and link it as "next".',
  'no-room': 'There are not enough free pages. Clear some first; nothing was changed.',
  'bad-name': 'A page name has at most 13 letters, digits and signs of ASCII:',
  'bad-number': 'A number is out of its range:',
  'no-such-joint': 'There is no such joint; servo IDs are 0 to 30:',
};

/** One sentence: what was refused, and what to do. */
export function refusalText({ code, words }: Refusal): string {
  const sentence = REFUSALS[code];
  return sentence.endsWith('.') || words === '' ? sentence : `${sentence} ${words}.`;
}
