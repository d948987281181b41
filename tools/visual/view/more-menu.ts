// SPDX-License-Identifier: MIT
// What a narrow screen has no room for in the row of the head, behind one button. A broad screen shows it in the row.

import { closesByItself, define, make } from './element.ts';
import { TEXTS } from './texts/texts.ts';
import './more-menu.css';

export class MoreMenu extends HTMLElement {
    /** What is in it; set before it is connected. Its dialogs are seen while it is closed, too. */
    content: readonly HTMLElement[] = [];
    private readonly toggle = make(
        'button',
        { class: 'toggle', 'aria-expanded': 'false', onclick: () => (this.open = !this.open) },
        TEXTS.menu.menu,
    );
    private readonly disposals: (() => void)[] = [];

    connectedCallback(): void {
        const tools = make('div', { class: 'tools' }, ...this.content);
        this.replaceChildren(this.toggle, tools);
        const sizes = new ResizeObserver(() => this.fit());
        for (const element of [tools, this.parentElement]) if (element) sizes.observe(element);
        this.disposals.push(closesByItself(this), () => sizes.disconnect());
    }

    disconnectedCallback(): void {
        for (const dispose of this.disposals.splice(0)) dispose();
    }

    /** How much room the words need is known when they stand there. */
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
