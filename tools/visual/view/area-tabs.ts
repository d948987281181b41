// SPDX-License-Identifier: MIT
// The tabs of the areas. A new user sees two and "More", which shows the others for good.

import type { Tab } from './session/session.ts';
import { define, make } from './element.ts';
import { isRemembered, remember } from './remembered.ts';
import { TEXTS } from './texts/texts.ts';
import './area-tabs.css';

const TABS: readonly Tab[] = ['remote', 'steps', 'curves', 'pages', 'links', 'checks', 'terminal', 'robot'];
const FIRST_DAY: readonly Tab[] = ['remote', 'steps'];

export class AreaTabs extends HTMLElement {
    /** An area was chosen; isClick: by click, not by arrow keys. */
    onChoose: (tab: Tab, isClick: boolean) => void = () => undefined;
    private readonly tabs = new Map<Tab, HTMLButtonElement>();
    private readonly more = make(
        'button',
        { class: 'more-areas', title: TEXTS.areas.moreHint, onclick: () => this.showMore() },
        TEXTS.areas.more,
    );

    connectedCallback(): void {
        const list = make('div', { role: 'tablist', 'aria-label': TEXTS.areas.areas });
        for (const name of TABS) {
            const tab = make(
                'button',
                { role: 'tab', id: `tab-${name}`, 'aria-controls': `area-${name}`, onclick: () => this.onChoose(name, true) },
                TEXTS.areas.titles[name],
            );
            tab.addEventListener('keydown', event => this.move(event, name));
            this.tabs.set(name, tab);
            list.append(tab);
        }
        this.replaceChildren(list, this.more);
        this.showAll(isRemembered('all-areas'));
    }

    /** Selects a tab. If it is not one of the first two, all tabs are shown. */
    select(chosen: Tab): void {
        if (!FIRST_DAY.includes(chosen)) this.showAll(true);
        for (const [name, tab] of this.tabs) {
            tab.setAttribute('aria-selected', String(name === chosen));
            tab.tabIndex = name === chosen ? 0 : -1;
        }
    }

    focusTab(name: Tab): void {
        this.tabs.get(name)?.focus({ preventScroll: true });
    }

    private showMore(): void {
        remember('all-areas');
        this.showAll(true);
        this.focusTab(TABS.find(name => !FIRST_DAY.includes(name)) ?? 'remote');
    }

    private showAll(shows: boolean): void {
        this.more.hidden = shows;
        for (const [name, tab] of this.tabs) tab.hidden = !shows && !FIRST_DAY.includes(name);
    }

    private move(event: KeyboardEvent, from: Tab): void {
        const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
        if (by === undefined) return;
        event.preventDefault();
        const seen = TABS.filter(name => this.tabs.get(name)?.hidden === false);
        const next = seen[(seen.indexOf(from) + by + seen.length) % seen.length] ?? from;
        this.onChoose(next, false);
        this.focusTab(next);
    }
}

define('area-tabs', AreaTabs);
