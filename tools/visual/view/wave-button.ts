// SPDX-License-Identifier: MIT
// Waves while the robot walks: overlays a page of the library that uses only the right arm. A standing robot begins to walk first.

import type { Session, SessionState } from './session/session.ts';
import { define, make } from './element.ts';
import { TEXTS } from './texts/texts.ts';

const WAVE = 'wave_over';

export class WaveButton extends HTMLElement {
    session!: Session; // set before it is connected
    private readonly button = make('button', { title: TEXTS.remote.waveHint, onclick: () => this.press() }, TEXTS.remote.wave);
    /** Pressed while the robot does not walk yet. */
    private isWanted = false;
    private readonly disposals: (() => void)[] = [];

    connectedCallback(): void {
        this.replaceChildren(this.button);
        this.disposals.push(
            this.session.state.watch(state => this.render(state)),
            this.session.onStop(() => (this.isWanted = false)), // Stop, and another robot
        );
    }

    disconnectedCallback(): void {
        for (const dispose of this.disposals.splice(0)) dispose();
    }

    private render(state: SessionState): void {
        this.hidden = this.pageOf(state) === undefined;
        this.button.disabled = state.connection !== 'ready' || state.version?.image !== 'play';
        this.isWanted &&= state.isPowered; // else it would wave over the first motion after it is switched on
        if (!this.isWanted || state.where?.state !== 'playing') return;
        this.isWanted = false;
        this.wave();
    }

    private pageOf({ pages }: SessionState): number | undefined {
        return pages.find(({ name }) => name === WAVE)?.page;
    }

    private press(): void {
        if (this.session.state.get().where?.state === 'playing') return this.wave();
        this.isWanted = true;
        this.session.remote(new Set(['up']));
        this.session.remote(new Set());
    }

    private wave(): void {
        const page = this.pageOf(this.session.state.get());
        if (page !== undefined) void this.session.overlay({ kind: 'layer', page, joints: [] });
    }
}

define('wave-button', WaveButton);
