// SPDX-License-Identifier: MIT
// All keys, area by area: opened by "?" or its button.

import { make } from './element.ts';

type Group = readonly [string, readonly (readonly [string, string])[]];

const KEYS: readonly Group[] = [
  ['Everywhere', [['?', 'these keys'], ['Ctrl+Z, Ctrl+Y', 'undo, redo, while the document is shown'], ['Tab', 'to the next thing'], ['← → on a tab', 'another area']]],
  ['Picture', [['← →', 'turn the view'], ['Esc', 'take a drag back']]],
  ['Picture, Pose', [['← →', 'choose a joint'], ['↑ ↓', 'turn it (Shift: by ten)'], ['Shift+click', 'choose one more'], ['Shift+← →', 'turn the view']]],
  ['Steps', [['← →', 'choose a step (Shift: several)'], ['Alt+← →', 'move the chosen ones'], ['Ctrl+C, X, V', 'copy, cut, paste as text'], ['D', 'duplicate'], ['B', 'one between this and the next'],
    ['M, Shift+M', 'mirror right to left, left to right'], ['X', 'exchange left and right'], ['Insert, Delete', 'insert, delete']]],
  ['Curves', [['← →', 'choose a step'], ['↑ ↓', 'turn the chosen joints (Shift: by ten)'], ['Alt+← →', 'less or more time']]],
  ['Pages', [['← → ↑ ↓', 'choose a page'], ['Enter', 'its steps'], ['F2', 'rename'], ['Ctrl+C, Ctrl+V', 'take it, put it here: copied or moved'], ['Delete', 'clear']]],
  ['Links', [['← → ↑ ↓', 'the nearest page that way'], ['Enter', 'its steps']]],
  ['Remote', [['↑ ↓ ← →, W A S D', 'walk and turn, while held'], ['1 … 4', 'other motions'], ['5', 'pause'], ['6, space bar', 'stop']]],
];

export class KeysDialog {
  readonly element = make('dialog', { class: 'keys-dialog', 'aria-label': 'Keys' });

  constructor() {
    const groups = KEYS.map(([title, keys]) => make('section', {}, make('h3', {}, title),
      make('dl', {}, ...keys.flatMap(([key, what]) => [make('dt', {}, key), make('dd', {}, what)]))));
    this.element.append(make('h2', {}, 'Keys'), make('div', { class: 'groups' }, ...groups),
      make('p', {}, make('button', { onclick: () => this.element.close() }, 'Close')));
  }

  /** "?" anywhere but where one types. */
  listen(): () => void {
    const key = (event: KeyboardEvent): void => {
      const isTyping = event.target instanceof Element && event.target.closest('input:not([type="range"]):not([type="checkbox"]), textarea, select, terminal-pane') !== null;
      if (event.key === '?' && !isTyping && !event.ctrlKey && !event.altKey) this.open();
    };
    document.addEventListener('keydown', key);
    return () => document.removeEventListener('keydown', key);
  }

  open(): void {
    if (!this.element.open) this.element.showModal();
  }
}
