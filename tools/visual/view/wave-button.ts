// SPDX-License-Identifier: MIT
// Waves while the robot walks: overlays a page of the library that uses only the right arm. A standing robot begins to walk first.

import { wordOf } from '../robot/remote.ts';
import type { SessionState } from './session/session.ts';
import { define, make, setDisabled } from './element.ts';
import { TEXTS } from './texts/texts.ts';
import { WaveWish } from './wave-wish.ts';
import { SessionElement } from './session-element.ts';

const WAVE = 'wave_over';

export class WaveButton extends SessionElement {
    private readonly button = make('button', { title: TEXTS.remote.waveHint, onclick: () => this.press() }, TEXTS.remote.wave);
    private readonly wish = new WaveWish();

    connectedCallback(): void {
        this.replaceChildren(this.button);
        this.disposals.push(
            this.session.state.watch(state => this.render(state)),
            this.session.onStop(() => this.wish.forget()),
        );
    }

    private render(state: SessionState): void {
        this.hidden = this.pageOf(state) === undefined;
        setDisabled(this.button, state.connection !== 'ready' || state.version?.image !== 'play');
        if (this.wish.isDue(state, this.session.editor.format.remoteCode(wordOf(['up'])))) this.wave();
    }

    private pageOf({ pages }: SessionState): number | undefined {
        return pages.find(({ name }) => name === WAVE)?.page;
    }

    private press(): void {
        if (this.session.state.get().where?.state === 'playing') return this.wave();
        this.session.remote(new Set(['up'])); // this forgets the wish before, as each key does
        this.session.remote(new Set());
        this.wish.ask();
    }

    private wave(): void {
        const page = this.pageOf(this.session.state.get());
        if (page !== undefined) void this.session.overlay({ kind: 'layer', page, joints: [] });
    }
}

define('wave-button', WaveButton);
