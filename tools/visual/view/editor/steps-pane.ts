// SPDX-License-Identifier: MIT
// The area Steps: the page's steps as pictures, their times, and actions on them.

import type { Session } from '../session/session.ts';
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
import './steps-pane.css';

export class StepsPane extends HTMLElement {
    session!: Session; // these are set before it is connected
    editing!: Store<Editing>;

    connectedCallback(): void {
        const give = <T extends HTMLElement & { session: Session }>(element: T): T => Object.assign(element, { session: this.session });
        const actions = give(new StepActions());
        const row = give(new StepRow());
        const teach = Object.assign(give(new TeachBar()), { editing: this.editing, add: () => actions.addFromRobot() });
        const follow = Object.assign(give(new FollowBar()), { editing: this.editing });
        this.replaceChildren(
            make('p', { class: 'purpose' }, TEXTS.steps.purpose),
            give(new PageHead()),
            row,
            give(new TimeLine()),
            give(new PlayBar()),
            actions,
            teach,
            follow,
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
