// SPDX-License-Identifier: MIT
// Live follow: the robot moves slowly to the chosen step. Off by default, and switched off when the taught limbs change, the robot is stopped
// (also at its own panel), moved another way or refuses, a servo fails in a move, the steps are left for another area or document, or the
// connection ends or the servo adapter is out: a robot that is plugged in again must not move by itself.

import { define, make, setDisabled } from '../element.ts';
import type { Store } from '../store.ts';
import type { Editing } from './editing.ts';
import { TEXTS } from '../texts/texts.ts';
import { SessionElement } from '../session-element.ts';

export class FollowBar extends SessionElement {
    editing!: Store<Editing>; // set before it is connected
    private readonly box = make('input', { type: 'checkbox', onchange: () => this.editing.set({ follow: this.box.checked }) });
    private isFollowing = false;

    connectedCallback(): void {
        this.replaceChildren(make('label', {}, this.box, TEXTS.steps.follow));
        this.watch(() => this.render(), this.editing, this.session.editor.state, this.session.state);
        this.disposals.push(
            this.session.onStop(() => this.end()),
            () => this.isFollowing && this.session.follow(null),
        );
    }

    private render(): void {
        const { follow } = this.editing.get();
        this.box.checked = follow;
        const { connection, adapter } = this.session.state.get();
        const { editor } = this.session;
        const { page, step } = editor.state.get();
        setDisabled(this.box, connection !== 'ready' || adapter === 'out');
        if (follow && this.box.disabled) return this.end(); // this renders again
        if (!follow && !this.isFollowing) return;
        this.isFollowing = follow;
        const hasSteps = editor.page(page).steps.length > 0;
        this.session.follow(follow && hasSteps ? editor.poseAfter(page, step) : null, () => this.end());
    }

    private end(): void {
        this.editing.set({ follow: false });
    }
}

define('follow-bar', FollowBar);
