// SPDX-License-Identifier: MIT
// Every sentence of the editor that is more than a label: names of edits, refusals.

import type { Refusal, RefusalCode } from '../../model/result.ts';
import type { PageFinding } from '../../model/checks.ts';
import { NOMINAL_VOLTS } from '../../model/motion.ts';
import type { PageFault } from '../../model/motion.ts';
import type { LinkField } from '../../model/page.ts';
import type { EditName, Transaction } from '../../model/transaction.ts';
import type { PageAccount } from '../../robot/page-write.ts';
import { buttonsOf } from '../../robot/remote.ts';
import type { TransferState } from '../session/transfer.ts';

const EDITS: Record<EditName, string> = {
    'set-joints': 'pose',
    'insert-step': 'new step',
    'delete-steps': 'steps deleted',
    'duplicate-steps': 'steps duplicated',
    'move-steps': 'steps moved',
    'paste-steps': 'steps pasted',
    'set-time': 'time',
    'set-pause': 'pause',
    'mirror-steps': 'mirror',
    'exchange-steps': 'left and right exchanged',
    interpolate: 'step between',
    rename: 'name',
    'set-header': 'page settings',
    'set-link': 'link',
    'copy-page': 'page copied',
    'move-page': 'page moved',
    'swap-pages': 'pages exchanged',
    'clear-page': 'page cleared',
    'replace-page': 'page replaced',
    'replace-pages': 'motions taken',
    drag: 'drag',
};

/** What an undo would take back, for its button: "pose (page 12)". */
export function editText(edit: Transaction): string {
    const pages = edit.changes.map(change => change.page);
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

/** What the autosave says. */
export function keptText(saving: 'saved' | 'saving' | 'off'): string {
    switch (saving) {
        case 'saved':
            return '✓ saved';
        case 'saving':
            return 'saving …';
        case 'off':
            return '⚠ This browser does not save your work (private window, or the disk is full). Save it as a file.';
        default:
            return saving satisfies never;
    }
}

export const EDITOR_TEXTS = {
    byNumber: 'played by its number',
    ofLibrary: 'This motion belongs to the library that the robot came with. Edit a copy of it?',
    editsCopy: 'Edit a copy',
    editsItself: 'Edit it itself',
    secondTab: (name: string): string => `Another tab has this document open, so this one has a copy: ${name}.`,
    pages: 'Pages: the 128 motions of this document. Drag one to copy or move it; double-click to edit its steps.',
    unreadable: 'cannot be read; it stays as it is',
    forgotten: (steps: number) => `Undo: the first ${steps} steps of this document were not saved when its tab was closed.`,
    removal: (name: string) => `"${name}" is removed from this browser. This cannot be undone. Robots and files keep what they have.`,
    nothingFound: 'No page is called so. Empty the search to see all of them.',
    nameHint: 'At most 13 letters, digits and signs.',
    clear: (names: string) => `${names} will be empty. Links of other pages still lead there. Undo brings it back.`,
    transfer: (from: string, to: string) => `What shall become of ${from}, which you put on ${to}?`,
    checks: 'Checks: what would not play, what servos or balance would not bear, and what only may surprise.',
    links: 'Links: which page follows which. Click a page to choose it, drag from one to another to link them, or use the list.',
    noLinks: 'No page has steps yet, so there is nothing to link.',
    checking: 'm512 checks too: its program is being loaded (5 MB, once) …',
    noM512: "m512's checks could not be loaded. What stands here is what the firmware itself and the body say.",
    allGood: (count: number) => `${count} pages in use, nothing to complain of.`,
    compare:
        'What differs, page by page: strong is what would come, pale what is there now. A backup of the robot is saved before anything is written.',
    same: 'Nothing differs.',
    trimStays: 'Page 0 is the trim of the robot it was read from. It is never written into another one.',
    damagedStays: 'This page is damaged and is not passed on.',
    wordsComing: 'In words: a moment …',
    noWords: 'The words could not be loaded; the pictures are right.',
    backupOf: (robot: string, when: string) => `Backup of ${when}, ${robot}`,
    replaced: (to: string) => `${to} is not empty: it would be replaced. Undo brings it back.`,
} as const;

const ARROWS: Readonly<Record<string, string>> = { up: '▲', down: '▼', left: '◀', right: '▶' };

/** A remote's code as its keys: "▲ + B1"; '' for none. */
export function codeText(code: number): string {
    return buttonsOf(code)
        .map(button => ARROWS[button] ?? button.toUpperCase())
        .join(' + ');
}

/** "page 12 (walk)". */
export function pageText(page: number, name: string): string {
    return name === '' ? `page ${page}` : `page ${page} (${name})`;
}

/** What the transfer does, in one sentence. */
export function transferText({ phase, done, total, trouble }: TransferState): string {
    switch (phase) {
        case 'idle':
            return '';
        case 'reading':
            return total === 0 ? 'Asking the robot which pages it has …' : `Reading page ${Math.min(done + 1, total)} of ${total} …`;
        case 'writing':
            return total === 0 ? 'Preparing: the robot is read and saved as a backup …' : `Written: ${done} of ${total} pages …`;
        case 'written':
            return `Written and verified: ${total} ${total === 1 ? 'page' : 'pages'}.`;
        case 'stopped':
            return [trouble ?? '', total > 0 ? `${done} of ${total} pages are done; the others are as they were.` : '']
                .filter(Boolean)
                .join(' ');
        default:
            return phase satisfies never;
    }
}

export const ACCOUNT_TEXTS: Readonly<Record<PageAccount, string>> = {
    waiting: 'as it was',
    sending: 'as it was',
    saving: 'being saved …',
    written: '✓ written',
    verified: '✓ verified',
};

const FAULTS: Record<PageFault, string> = {
    checksum: 'its checksum is wrong',
    steps: 'it counts more than seven steps',
    schedule: 'its schedule is unknown',
    speed: 'its speed is 0',
    position: 'a position is above 1023',
};

/** Beyond this a servo cannot follow at all: the limit is 90 % of what it turns without load. */
const HOPELESS = 1 / 0.9;

/** Faults keep a page from doing what it says; the others may surprise. */
export function isFaulty({ kind, amount }: PageFinding): boolean {
    return kind === 'damaged' || kind === 'out-of-reach' || kind === 'exit-circle' || (kind === 'too-fast' && amount > HOPELESS);
}

/** One finding as a sentence; jointTitle: of its joint. */
export function findingText({ kind, step, amount, fault }: PageFinding, jointTitle: string): string {
    const where = step === null ? '' : `Step ${step + 1}: `;
    switch (kind) {
        case 'damaged':
            return `Damaged: ${fault ? FAULTS[fault] : ''}. It is not played. Clear it, or take it from a backup or a file.`;
        case 'too-fast':
            return `${where}the ${jointTitle} is asked for ${amount.toFixed(2)} times the speed that suits the servo at ${NOMINAL_VOLTS} V, and lags behind. Give the step more time.`;
        case 'out-of-reach':
            return `${where}the ${jointTitle} is turned farther than the body lets it.`;
        case 'tips-over':
            return `${where}held like this it tips over: its centre of mass is ${Math.round(amount * 1000)} mm outside the soles. In a fast motion, or lying, that may be meant.`;
        case 'exit-circle':
            return 'Its exit links go round in a circle, so a stop comes to no page that ends. The robot breaks the circle off where it began.';
        default:
            return kind satisfies never;
    }
}

export const LINK_TEXTS: Readonly<Record<LinkField, string>> = {
    next: 'next',
    exit: 'exit (on stop)',
    linked1: 'linked 1',
    linked2: 'linked 2',
    blendRight: 'blend right',
    blendLeft: 'blend left',
};

export const LEGEND_TEXTS = {
    next: 'next',
    exit: 'exit, on stop',
    linked: 'linked, by a key',
    blend: 'blend partner',
    dead: '⚠ nothing to play there',
} as const;
