// SPDX-License-Identifier: MIT
// Tools of the header row. Where they do not fit, a button opens them as a menu.

import { closesByItself, define, make } from './element.ts';
import { SessionElement } from './session-element.ts';
import { TEXTS } from './texts/texts.ts';
import './more-menu.css';

export class MoreMenu extends SessionElement {
    /** Set before it is connected. Its dialogs are visible even while the menu is closed. */
    content: readonly HTMLElement[] = [];
    private readonly toggle = make(
        'button',
        { class: 'toggle', 'aria-expanded': 'false', onclick: () => (this.open = !this.open) },
        TEXTS.menu.menu,
    );

    connectedCallback(): void {
        const tools = make('div', { class: 'tools' }, ...this.content);
        this.replaceChildren(this.toggle, tools);
        const sizes = new ResizeObserver(() => this.fit());
        for (const element of [tools, this.parentElement]) if (element) sizes.observe(element);
        this.disposals.push(closesByItself(this), () => sizes.disconnect());
    }

    /** Unfolds first, because the width of the texts can only be measured while they are shown. */
    private fit(): void {
        const { parentElement: head } = this;
        this.classList.remove('folded');
        this.classList.toggle('folded', head !== null && head.scrollWidth > head.clientWidth);
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
