// SPDX-License-Identifier: MIT
// The area Steps: the page's steps as pictures, their times, and actions on them.

import { define, make } from '../element.ts';
import type { Store } from '../store.ts';
import type { Editing } from './editing.ts';
import { FollowBar } from './follow-bar.ts';
import { PageHead } from './page-head.ts';
import { PlayBar } from './play-bar.ts';
import { StepActions } from './step-actions.ts';
import { StepRow } from './step-row.ts';
import { TeachBar } from './teach-bar.ts';
import { TEXTS } from '../texts/texts.ts';
import { TimeLine } from './time-line.ts';
import { SessionElement } from '../session-element.ts';
import './steps-pane.css';

export class StepsPane extends SessionElement {
    editing!: Store<Editing>; // set before it is connected

    connectedCallback(): void {
        const { editing } = this;
        const actions = this.give(new StepActions());
        const row = this.give(new StepRow());
        this.replaceChildren(
            make('p', { class: 'purpose' }, TEXTS.steps.purpose),
            this.give(new PageHead()),
            row,
            this.give(new TimeLine()),
            this.give(new PlayBar()),
            actions,
            this.give(new TeachBar(), { editing, add: () => actions.addFromRobot() }),
            this.give(new FollowBar(), { editing }),
        );
        row.addEventListener('keydown', event => {
            if (event.target instanceof HTMLInputElement || !actions.key(event)) return;
            event.preventDefault();
            row.focusCursor();
        });
        row.listenForAll();
        for (const [name, action] of [
            ['copy', actions.onCopy],
            ['cut', actions.onCut],
            ['paste', actions.onPaste],
        ] as const) {
            row.addEventListener(name, event => {
                if (!(event.target instanceof HTMLInputElement)) action.call(actions, event);
            });
        }
    }
}

define('steps-pane', StepsPane);
