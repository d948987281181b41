// SPDX-License-Identifier: MIT
// What the remote's keys call now: from rest the pages that have a code, while a page plays where it leads. What is held and
// what plays light up; a click plays a page as its key would.

import { callsOf, waysFrom } from '../model/ways.ts';
import type { Way } from '../model/ways.ts';
import type { Desk } from './desk.ts';
import { codeText } from './texts/editor.ts';
import { define, make } from './element.ts';
import { WAY_TEXTS } from './texts/robot.ts';
import './way-list.css';

export class WayList extends HTMLElement {
    desk!: Desk; // set before it is connected
    private readonly disposals: (() => void)[] = [];
    private readonly heading = make('h2');
    private readonly list = make('ul');
    private shown = '';
    private pages: unknown = null;

    connectedCallback(): void {
        this.replaceChildren(this.heading, this.list);
        const render = (): void => this.render();
        this.disposals.push(this.desk.state.watch(render), this.desk.editor.state.watch(render));
    }

    disconnectedCallback(): void {
        for (const dispose of this.disposals.splice(0)) dispose();
    }

    /** code: of the keys that are held. */
    light(code: number): void {
        for (const item of this.list.children) item.classList.toggle('lit', code !== 0 && item.getAttribute('data-code') === String(code));
    }

    private render(): void {
        const { where, version, connection } = this.desk.state.get();
        const { robot } = this.desk.editor.state.get();
        const page = connection === 'ready' && where && where.state !== 'idle' && where.state !== 'ready' ? where.page : 0;
        const hears = version?.image === 'play'; // Edit takes no remote
        const key = `${page} ${hears}`;
        if (key === this.shown && robot === this.pages) return;
        this.shown = key;
        this.pages = robot;
        const { format } = this.desk.editor;
        const ways = !hears ? [] : page > 0 ? waysFrom(format, robot, page) : callsOf(format, robot);
        const name = this.desk.state.get().pages.find(entry => entry.page === page)?.name ?? '';
        this.heading.textContent = page > 0 ? WAY_TEXTS.plays(page, name) : ways.length > 0 ? WAY_TEXTS.keys : '';
        this.classList.toggle('playing', page > 0);
        this.list.replaceChildren(...ways.map(way => this.item(way)));
    }

    private item({ kind, code, page, name }: Way): HTMLLIElement {
        const keys = kind === 'stop' ? '6' : kind === 'then' ? WAY_TEXTS.atItsEnd : codeText(code).replaceAll(/B(\d)/g, '$1');
        const content = [make('kbd', {}, keys), make('span', {}, name === '' ? String(page) : name)];
        return make(
            'li',
            { 'data-code': code },
            ...(kind === 'call' ? [make('button', { onclick: () => void this.desk.play(page) }, ...content)] : content),
        );
    }
}

define('way-list', WayList);
