// SPDX-License-Identifier: MIT
// Dialog with all keys by area, opened by "?" or its button.

import { isTyping, make } from './element.ts';
import { TEXTS } from './texts/texts.ts';

export class KeysDialog {
    readonly element = make('dialog', { class: 'keys-dialog', 'aria-labelledby': 'keys-title' });

    constructor() {
        const titles: Readonly<Record<string, string>> = { ...TEXTS.areas.titles, ...TEXTS.keys.titles };
        const groups = Object.entries(TEXTS.keys.groups).map(([name, keys]) =>
            make(
                'section',
                {},
                make('h3', {}, titles[name] ?? ''),
                make('dl', {}, ...keys.flatMap(([key, what]) => [make('dt', {}, key), make('dd', {}, what)])),
            ),
        );
        this.element.append(
            make(
                'header',
                {},
                make('h2', { id: 'keys-title' }, TEXTS.keys.title),
                make('button', { onclick: () => this.element.close() }, TEXTS.page.close),
            ),
            make('div', { class: 'groups' }, ...groups),
        );
    }

    /** Opens the dialog on "?", except while typing. */
    key(event: KeyboardEvent): void {
        const isInList = event.target instanceof HTMLSelectElement; // letters select in a list
        if (event.key === '?' && !isTyping(event) && !isInList && !event.ctrlKey && !event.altKey) this.open();
    }

    open(): void {
        if (!this.element.open) this.element.showModal();
    }
}
