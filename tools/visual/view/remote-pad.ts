// SPDX-License-Identifier: MIT
// The RC-100 remote control on the screen, by keyboard (arrows or W A S D, 1 to 6) and by gamepad. Buttons act while they are held, several
// at once if needed. The stick of a gamepad drives (`@drive`).

import { wordOf } from '../robot/remote.ts';
import type { RemoteButton } from '../robot/remote.ts';
import type { Shape } from '../model/motion.ts';
import { LayerBar } from './editor/layer-bar.ts';
import { ShapeBar } from './editor/shape-bar.ts';
import { define, make, withoutMenu } from './element.ts';
import type { Store } from './store.ts';
import { startPageAddress } from './texts/languages.ts';
import { TEXTS } from './texts/texts.ts';
import { WaveButton } from './wave-button.ts';
import { GamePad, padOf } from './game-pad.ts';
import { KeyList } from './key-list.ts';
import { buttonOf, isForFocus } from './remote-keys.ts';
import { SessionElement } from './session-element.ts';
import './remote-pad.css';

const BUTTONS: readonly (readonly [RemoteButton, string])[] = [
    ['up', '▲'],
    ['left', '◀'],
    ['right', '▶'],
    ['down', '▼'],
    ['b1', '1'],
    ['b2', '2'],
    ['b3', '3'],
    ['b4', '4'],
    ['b5', '5'],
    ['b6', '6'],
];

export class RemotePad extends SessionElement {
    shape!: Store<Shape>; // set before it is connected
    /** A game pad is used. */
    onPad: () => void = () => undefined;
    private readonly pad = new GamePad();
    private readonly held = { screen: new Set<RemoteButton>(), keys: new Set<RemoteButton>(), pad: new Set<RemoteButton>() };
    private readonly buttons = new Map<RemoteButton, HTMLButtonElement>();
    private readonly keyList = new KeyList();
    private sent = '';

    connectedCallback(): void {
        const pad = make('div', { class: 'pad', role: 'group', 'aria-label': TEXTS.remote.title });
        for (const [name, sign] of BUTTONS) pad.append(this.button(name, sign, TEXTS.remote[name]));
        const shape = this.give(new ShapeBar(), { shape: this.shape });
        this.replaceChildren(
            make('h2', {}, TEXTS.remote.title),
            make('div', { class: 'drive' }, pad, make('div', { class: 'goes' }, shape, this.give(new WaveButton()))),
            make('p', { class: 'hint' }, TEXTS.remote.keys),
            this.give(this.keyList),
            make('details', { class: 'overlay' }, make('summary', {}, TEXTS.remote.layers), this.give(new LayerBar())),
            make('p', { class: 'hint' }, make('a', { href: startPageAddress() }, TEXTS.remote.motions)),
        );
        for (const type of ['keydown', 'keyup'] as const) this.listenTo(window, type, event => this.key(event));
        this.listenTo(window, 'blur', () => this.letGo());
        this.disposals.push(() => this.letGo());
        this.watchPad();
    }

    private button(name: RemoteButton, sign: string, title: string): HTMLButtonElement {
        const button = make('button', { class: `key ${name}`, 'aria-label': title, title }, sign);
        const hold = (event: PointerEvent): void => {
            if (event.button !== 0) return;
            button.setPointerCapture(event.pointerId);
            this.change('screen', name, true);
        };
        button.addEventListener('pointerdown', hold);
        for (const end of ['pointerup', 'pointercancel'] as const) button.addEventListener(end, () => this.change('screen', name, false));
        withoutMenu(button);
        button.addEventListener('keydown', event => event.key === 'Enter' && this.change('screen', name, true));
        button.addEventListener('keyup', event => event.key === 'Enter' && this.change('screen', name, false));
        button.addEventListener('blur', () => this.change('screen', name, false));
        this.buttons.set(name, button);
        return button;
    }

    /** Polls the gamepad while there is one: its buttons cause no events. */
    private watchPad(): void {
        let frame = 0;
        const ask = (): void => {
            const pad = padOf(navigator.getGamepads());
            this.readPad(pad);
            frame = pad ? requestAnimationFrame(ask) : 0;
        };
        this.listenTo(window, 'gamepadconnected', () => frame === 0 && ask());
        this.disposals.push(() => cancelAnimationFrame(frame));
    }

    private key(event: KeyboardEvent): void {
        if (event.key === 'Meta') return this.letGo(); // while Cmd is held, macOS reports no key that is released
        const name = buttonOf(event, this.held.keys);
        if (!name) return;
        if (event.type === 'keydown' && this.session.state.get().tab !== 'remote') return; // in other areas the arrows edit
        if (event.type === 'keydown' && name !== 'b6' && isInDialog()) return; // in dialogs the arrows scroll
        const focus = event.target instanceof Element ? event.target : null;
        if (event.type === 'keydown' && isForFocus(event.code, focus, this.session.state.get().where)) return;
        event.preventDefault();
        this.change('keys', name, event.type === 'keydown');
    }

    /** null: it is disconnected; all its buttons are released. */
    private readPad(pad: Gamepad | null): void {
        const { buttons, stick } = this.pad.read(pad, document.hasFocus() && !isInDialog() ? this.session.state.get().tab : null);
        if (stick || buttons.length > 0) this.onPad();
        this.session.drive(stick);
        this.held.pad = new Set(buttons);
        this.tell();
    }

    private change(by: 'screen' | 'keys', name: RemoteButton, down: boolean): void {
        if (down) this.held[by].add(name);
        else this.held[by].delete(name);
        this.tell();
    }

    private letGo(): void {
        this.held.screen.clear();
        this.held.keys.clear();
        this.tell();
    }

    private tell(): void {
        const all = new Set([...this.held.screen, ...this.held.keys, ...this.held.pad]);
        const names = [...all].sort().join(' ');
        if (names === this.sent) return;
        this.sent = names;
        for (const [name, button] of this.buttons) button.setAttribute('aria-pressed', String(all.has(name)));
        this.keyList.light(this.session.editor.format.remoteCode(wordOf(all)));
        this.session.remote(all);
    }
}

function isInDialog(): boolean {
    return document.querySelector('dialog[open]') !== null;
}

define('remote-pad', RemotePad);
