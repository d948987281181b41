// SPDX-License-Identifier: MIT
// What the remote's keys start now. At rest: the pages that have a code. While a page plays: where it leads. Held keys light up; a click
// plays a page as its key would.

import { targetsFromRest, targetsFrom } from '../model/key-targets.ts';
import type { KeyTarget } from '../model/key-targets.ts';
import { codeText } from './texts/editor.ts';
import { define, make, once } from './element.ts';
import { TEXTS } from './texts/texts.ts';
import { SessionElement } from './session-element.ts';
import './key-list.css';

export class KeyList extends SessionElement {
    private readonly heading = make('h2');
    private readonly list = make('ul');
    private shown = '';
    private pages: unknown = null;
    /** Code of the held keys; 0: none. */
    private held = 0;

    connectedCallback(): void {
        this.replaceChildren(this.heading, this.list);
        this.watch(() => this.render(), this.session.state, this.session.editor.state);
    }

    /** code: of the held keys; 0: none. */
    light(code: number): void {
        this.held = code;
        for (const item of this.list.children) item.classList.toggle('lit', code !== 0 && item.getAttribute('data-code') === String(code));
    }

    private render(): void {
        const { where, version, connection } = this.session.state.get();
        const { robot } = this.session.editor.state.get();
        const page = connection === 'ready' && where && where.state !== 'idle' && where.state !== 'ready' ? where.page : 0;
        const hears = version?.image === 'play'; // Edit ignores the remote
        const key = `${page} ${hears}`;
        if (key === this.shown && robot === this.pages) return;
        this.shown = key;
        this.pages = robot;
        const { format } = this.session.editor;
        const targets = !hears ? [] : page > 0 ? targetsFrom(format, robot, page) : targetsFromRest(format, robot);
        const name = this.session.state.get().pages.find(entry => entry.page === page)?.name ?? '';
        this.heading.textContent = targets.length === 0 ? '' : page > 0 ? TEXTS.remote.leadsOn(page, name) : TEXTS.remote.keysStart;
        this.classList.toggle('playing', page > 0);
        this.list.replaceChildren(...targets.map(target => this.item(target)));
        this.light(this.held); // the key that has started this page is still held
    }

    private item({ kind, code, page, name }: KeyTarget): HTMLLIElement {
        const keys = kind === 'stop' ? '6' : kind === 'then' ? TEXTS.remote.atItsEnd : codeText(code).replaceAll(/B(\d)/g, '$1');
        const content = [make('kbd', {}, keys), make('span', {}, name === '' ? String(page) : name)];
        return make(
            'li',
            { 'data-code': code },
            ...(kind === 'call' ? [make('button', { onclick: once(() => this.session.play(page)) }, ...content)] : content),
        );
    }
}

define('key-list', KeyList);
