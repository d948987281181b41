// SPDX-License-Identifier: MIT
// What a person wants first: walk, wave, get up, stop. The buttons are pages of the robot, found by their names; all the
// others are in a list.

import type { PageEntry } from '../robot/protocol.ts';
import type { Desk, DeskState } from './desk.ts';
import { define, make } from './element.ts';
import './action-bar.css';

/** Names of the motion library that get a button, and what stands on it. */
const BUTTONS: readonly (readonly [string, string])[] = [
  ['walk', 'Walk'], ['back', 'Back'], ['left', 'Turn left'], ['right', 'Turn right'], ['wave', 'Wave'], ['bow', 'Bow'], ['dance', 'Dance'],
  ['get_up', 'Get up (face)'], ['get_up_back', 'Get up (back)'],
];

export class ActionBar extends HTMLElement {
  desk!: Desk; // set before it is connected
  private shown: readonly PageEntry[] | null = null;
  private isReady: boolean | null = null;
  private unwatch: () => void = () => undefined;

  connectedCallback(): void {
    this.setAttribute('role', 'toolbar');
    this.setAttribute('aria-label', 'Motions');
    this.unwatch = this.desk.state.watch((state) => this.render(state));
  }

  disconnectedCallback(): void {
    this.unwatch();
  }

  private render(state: DeskState): void {
    const isReady = state.connection === 'ready';
    if (state.pages === this.shown && isReady === this.isReady) return;
    this.shown = state.pages;
    this.isReady = isReady;
    const byName = new Map(state.pages.map((page) => [page.name, page]));
    const buttons = BUTTONS.flatMap(([name, title]) => {
      const page = byName.get(name);
      return page ? [this.button(title, isReady, () => this.desk.play(page.page))] : [];
    });
    this.replaceChildren(
      this.button('Stop', isReady, () => this.desk.command('stop'), 'stop'), ...buttons, this.list(state.pages, isReady),
    );
  }

  private button(title: string, isReady: boolean, deed: () => Promise<void>, kind = ''): HTMLButtonElement {
    return make('button', { class: kind, disabled: !isReady, onclick: () => void deed() }, title);
  }

  private list(pages: readonly PageEntry[], isReady: boolean): HTMLSelectElement {
    const playable = pages.filter((page) => page.steps > 0 && page.page > 0);
    const options = playable.map((page) => make('option', { value: page.page }, `${page.page} ${page.name}`));
    const list = make('select', { 'aria-label': 'Play a page', disabled: !isReady || playable.length === 0 },
      make('option', { value: '' }, 'All pages …'), ...options);
    list.addEventListener('change', () => {
      if (list.value !== '') void this.desk.play(Number(list.value));
      list.value = '';
    });
    return list;
  }
}

define('action-bar', ActionBar);
