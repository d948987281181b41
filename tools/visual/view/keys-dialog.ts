// SPDX-License-Identifier: MIT
// All keys, area by area: opened by "?" or its button.

import { isTyping, make } from './element.ts';

type Group = readonly [string, readonly (readonly [string, string])[]];

const KEYS: readonly Group[] = [
    [
        'Everywhere',
        [
            ['?', 'these keys'],
            ['Tab, Shift+Tab', 'to the next thing, back'],
            ['← → on a tab', 'another area'],
            ['Ctrl+Z, Ctrl+Y', 'undo, redo, while the document is shown'],
            ['↑ ↓ Enter in a list', 'choose, do it'],
            ['F6', 'picture or area'],
            ['Esc', 'take it back, close'],
        ],
    ],
    [
        'Remote',
        [
            ['↑ ↓ ← →, W A S D', 'start walking and turning'],
            ['1 … 4', 'other motions'],
            ['5', 'pause'],
            ['6, space bar', 'stop'],
        ],
    ],
    [
        'Picture',
        [
            ['Shift+← →', 'turn the view'],
            ['Page Up, Page Down', 'from above, from below'],
            ['+ −', 'nearer, farther'],
            ['P, Shift+P', 'push the robot ahead, back (not in Pose)'],
            ['Esc', 'take a drag back'],
        ],
    ],
    [
        'Picture, Pose',
        [
            ['← →', 'choose a joint'],
            ['↑ ↓', 'turn it (Shift: by ten)'],
            ['Shift+click', 'choose one more'],
        ],
    ],
    [
        'Steps',
        [
            ['← →', 'choose a step (Shift: several)'],
            ['Alt+← →', 'move the chosen ones'],
            ['Ctrl+A', 'choose all'],
            ['Ctrl+C, X, V', 'copy, cut, paste as text'],
            ['D', 'duplicate'],
            ['B', 'one between this and the next'],
            ['M, Shift+M', 'mirror right to left, left to right'],
            ['X', 'exchange left and right'],
            ['Insert, Delete', 'insert, delete'],
        ],
    ],
    [
        'Curves',
        [
            ['← →', 'choose a step'],
            ['↑ ↓', 'turn the chosen joints (Shift: by ten)'],
            ['Alt+← →', 'less or more time'],
        ],
    ],
    [
        'Pages',
        [
            ['← → ↑ ↓', 'choose a page'],
            ['Enter', 'its steps'],
            ['F2', 'rename'],
            ['Ctrl+C, Ctrl+V', 'take it, put it here: copied or moved'],
            ['Delete', 'clear'],
        ],
    ],
    [
        'Links',
        [
            ['← → ↑ ↓', 'the nearest page that way'],
            ['Enter', 'its steps'],
        ],
    ],
    ['Terminal', [['Tab, Shift+Tab', 'leave it; all other keys go to the robot']]],
    [
        'Robot',
        [
            ['Enter, held', 'a button of the panel, held'],
            ['← →', 'a slider'],
        ],
    ],
];

export class KeysDialog {
    readonly element = make('dialog', { class: 'keys-dialog', 'aria-labelledby': 'keys-title' });

    constructor() {
        const groups = KEYS.map(([title, keys]) =>
            make(
                'section',
                {},
                make('h3', {}, title),
                make('dl', {}, ...keys.flatMap(([key, what]) => [make('dt', {}, key), make('dd', {}, what)])),
            ),
        );
        this.element.append(
            make('header', {}, make('h2', { id: 'keys-title' }, 'Keys'), make('button', { onclick: () => this.element.close() }, 'Close')),
            make('div', { class: 'groups' }, ...groups),
        );
    }

    /** "?" anywhere but where one types. */
    listen(): () => void {
        const key = (event: KeyboardEvent): void => {
            const isInList = event.target instanceof HTMLSelectElement; // there a letter is a choice
            if (event.key === '?' && !isTyping(event) && !isInList && !event.ctrlKey && !event.altKey) this.open();
        };
        document.addEventListener('keydown', key);
        return () => document.removeEventListener('keydown', key);
    }

    open(): void {
        if (!this.element.open) this.element.showModal();
    }
}
