// SPDX-License-Identifier: MIT
// The menu's list of languages, with a note on the translation below it.

import { onChoice } from './choice.ts';
import { define, make } from './element.ts';
import { SessionElement } from './session-element.ts';
import { LANGUAGES, chooseLanguage } from './texts/languages.ts';
import { TEXTS } from './texts/texts.ts';

export class LanguageChoice extends SessionElement {
    connectedCallback(): void {
        const { lang } = document.documentElement;
        const choices = Object.entries(LANGUAGES).map(([value, name]) =>
            make('option', { value, lang: value, selected: value === lang }, name),
        );
        const list = make('select', { 'aria-label': TEXTS.menu.language }, ...choices);
        onChoice(list, async language => {
            if (!(await this.session.reload(() => chooseLanguage(language)))) list.value = lang;
        });
        list.title = TEXTS.menu.translation;
        this.replaceChildren(list, ...(TEXTS.menu.translation === '' ? [] : [make('p', { class: 'hint' }, TEXTS.menu.translation)]));
    }
}

define('language-choice', LanguageChoice);
