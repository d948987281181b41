// SPDX-License-Identifier: MIT
// What a narrow screen has no room for in the row of the head, behind one button. A broad screen shows it in the row.

import { closesByItself, define, make } from './element.ts';
import './more-menu.css';

export class MoreMenu extends HTMLElement {
    /** What is in it; set before it is connected. Its dialogs are seen while it is closed, too. */
    content: readonly HTMLElement[] = [];
    private readonly toggle = make(
        'button',
        { class: 'toggle', 'aria-expanded': 'false', onclick: () => (this.open = !this.open) },
        'Menu',
    );
    private unlisten: () => void = () => undefined;

    connectedCallback(): void {
        this.replaceChildren(this.toggle, make('div', { class: 'tools' }, ...this.content));
        this.unlisten = closesByItself(this);
    }

    disconnectedCallback(): void {
        this.unlisten();
    }

    get open(): boolean {
        return this.classList.contains('open');
    }

    set open(open: boolean) {
        this.classList.toggle('open', open);
        this.toggle.setAttribute('aria-expanded', String(open));
    }
}

define('more-menu', MoreMenu);
