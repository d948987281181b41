// SPDX-License-Identifier: MIT
// Buttons for the first actions: walk, wave, get up, stop. They play pages of the robot, found by name; a list has all pages.

import type { PageEntry } from '../robot/protocol.ts';
import type { RobotState } from '../robot/robot-state.ts';
import type { SessionState } from './session/session.ts';
import { onChoice } from './choice.ts';
import { define, handOver, keepFocus, make, once } from './element.ts';
import { GetUp } from './get-up.ts';
import { TEXTS } from './texts/texts.ts';
import { SessionElement } from './session-element.ts';
import './action-bar.css';

/** Motions of the library that get a button; `lesser` ones only where there is space. */
const BUTTONS = [
    ['walk', ''],
    ['back', 'lesser'],
    ['left', 'lesser'],
    ['right', 'lesser'],
    ['wave', ''],
    ['bow', 'lesser'],
    ['dance', 'lesser'],
] as const;
/** Pages for a robot on its face and on its back. */
const GET_UP = { face: 'get_up', back: 'get_up_back' };

export class ActionBar extends SessionElement {
    private shown = '';
    private readonly getUp = make(
        'button',
        { class: 'get-up', title: TEXTS.actions.getUpHint, onclick: once(() => this.standUp()) },
        TEXTS.actions.getUp,
    );
    private readonly letGo = make(
        'button',
        { title: TEXTS.actions.letGoHint, onclick: () => this.session.sim.hold(false) },
        TEXTS.actions.letGo,
    );
    private readonly gettingUp = new GetUp(motion => this.playNamed(GET_UP[motion]));
    private frame: RobotState | null = null;

    connectedCallback(): void {
        this.setAttribute('role', 'toolbar');
        this.setAttribute('aria-label', TEXTS.actions.actions);
        this.disposals.push(
            this.session.state.watch(state => this.render(state)),
            this.session.onFrame(frame => this.look(frame)),
            this.session.onStop(() => this.gettingUp.stop()),
        );
    }

    private render(state: SessionState): void {
        const isReady = state.connection === 'ready';
        const key = `${isReady} ${state.source} ${state.pages.map(({ page, name, steps }) => `${page}:${name}:${steps}`).join()}`;
        if (key === this.shown) return;
        this.shown = key;
        const byName = new Map(state.pages.map(page => [page.name, page]));
        const plays = (name: string, title: string, kind = ''): HTMLButtonElement[] => {
            const page = byName.get(name);
            if (!page) return [];
            const play = once(() => this.session.play(page.page));
            return [this.button(title, isReady, play, kind)];
        };
        keepFocus(this, () =>
            this.replaceChildren(
                this.button(TEXTS.page.stop, true, () => void this.session.command('stop'), 'stop'), // also for what waits until it is ready
                ...(state.source === 'simulated' ? [this.letGo] : []),
                ...BUTTONS.flatMap(([name, kind]) => plays(name, TEXTS.actions[name], kind)),
                ...(state.source === 'simulated'
                    ? this.oneGetUp(byName)
                    : [...plays(GET_UP.face, TEXTS.actions.getUpFace), ...plays(GET_UP.back, TEXTS.actions.getUpBack)]),
                this.list(state.pages, isReady),
            ),
        );
        this.look(this.frame);
    }

    /** One button is enough for the simulated robot, whose pose is known. A real robot has no sensor for it, so the user chooses. */
    private oneGetUp(pages: ReadonlyMap<string, PageEntry>): HTMLButtonElement[] {
        return pages.has(GET_UP.face) && pages.has(GET_UP.back) ? [this.getUp] : [];
    }

    private look(frame: RobotState | null): void {
        this.frame = frame;
        const { where } = this.session.state.get();
        if (frame) this.gettingUp.look(where !== null && where.state !== 'idle', frame.trunk, frame.hasFallen);
        const lies = frame?.hasFallen === true && frame.isPowered;
        this.allow(this.letGo, frame?.isHeld === true);
        this.allow(this.getUp, lies && this.session.state.get().connection === 'ready');
        this.getUp.classList.toggle('wanted', lies);
    }

    private allow(button: HTMLButtonElement, may: boolean): void {
        if (button.disabled === may) handOver(button, this.querySelector('.stop'), () => (button.disabled = !may));
    }

    private standUp(): void {
        if (this.frame) this.gettingUp.start(this.frame.trunk);
    }

    private async playNamed(wanted: string): Promise<boolean> {
        const page = this.session.state.get().pages.find(({ name }) => name === wanted);
        return page !== undefined && this.session.play(page.page);
    }

    private button(title: string, isReady: boolean, action: (event: Event) => void, kind = ''): HTMLButtonElement {
        return make('button', { class: kind, disabled: !isReady, onclick: action }, title);
    }

    private list(pages: readonly PageEntry[], isReady: boolean): HTMLSelectElement {
        const playable = pages.filter(page => page.steps > 0 && page.page > 0);
        const options = playable.map(page => make('option', { value: page.page }, `${page.page} ${page.name}`));
        const list = make(
            'select',
            { 'aria-label': TEXTS.actions.choose, disabled: !isReady || playable.length === 0 },
            make('option', { value: '' }, TEXTS.actions.all),
            ...options,
        );
        onChoice(list, page => {
            if (page !== '') void this.session.play(Number(page));
            list.value = '';
        });
        return list;
    }
}

define('action-bar', ActionBar);
