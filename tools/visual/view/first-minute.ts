// SPDX-License-Identifier: MIT
// Card over the picture for a first visit: what this is, and three things to do. The first click or key closes it for good.

import type { RobotState } from '../robot/robot-state.ts';
import { define, handOver, make, pictureCanvas } from './element.ts';
import { pushRobot } from './push.ts';
import { isRemembered, remember } from './remembered.ts';
import { startPageAddress } from './texts/languages.ts';
import { TEXTS } from './texts/texts.ts';
import { SessionElement } from './session-element.ts';
import './first-minute.css';

/** Keys that only reach or press a button; they do not close the card. */
const ON_THE_WAY: readonly string[] = ['Tab', 'Shift', 'Enter', ' ', 'Control', 'Alt', 'Meta', 'F6'];

export class FirstMinute extends SessionElement {
    onTeach: () => void = () => undefined; // set before it is connected

    connectedCallback(): void {
        this.hidden = isRemembered('begun');
        if (this.hidden) return;
        this.setAttribute('role', 'region');
        this.setAttribute('aria-label', TEXTS.first.region);
        const button = (title: string, action: () => void, kind = ''): HTMLButtonElement =>
            make('button', { class: kind, onclick: () => this.choose(action) }, title);
        this.replaceChildren(
            make('p', {}, TEXTS.first.what),
            make(
                'div',
                { class: 'row' },
                button(TEXTS.first.walk, () => this.walk(), 'primary'),
                button(TEXTS.first.push, () => this.push()),
                button(TEXTS.first.teach, () => this.onTeach()),
            ),
            make('a', { href: startPageAddress() }, TEXTS.first.motions),
        );
        const beside = ({ target }: Event): void => {
            if (target instanceof Node && !this.contains(target)) this.close();
        };
        for (const type of ['pointerdown', 'click'] as const) this.listenTo(document, type, beside, { capture: true });
        this.listenTo(document, 'keydown', ({ key }) => !ON_THE_WAY.includes(key) && this.close());
    }

    /** hasBegun: false shows the card again at the next visit. */
    close(hasBegun = true): void {
        if (this.hidden) return;
        handOver(this, pictureCanvas(), () => (this.hidden = true));
        if (hasBegun) remember('begun');
        this.disconnectedCallback(); // ends the listening
    }

    private choose(action: () => void): void {
        this.close();
        action();
    }

    /** Presses and releases the remote's key: a press that comes too early is stored until the robot can walk. */
    private walk(): void {
        this.session.say({ text: TEXTS.first.walks, tone: 'calm' });
        this.session.remote(new Set(['up']));
        this.session.remote(new Set());
    }

    /** Waits until the robot is ready and no longer held. */
    private push(): void {
        const end = (): void => {
            unwatch();
            unlisten();
        };
        const unwatch = this.session.onFrame(state => {
            if (!this.mayBePushed(state)) return;
            end();
            if (pushRobot(this.session, 1)) this.session.say({ text: TEXTS.first.pushed, tone: 'calm' });
        });
        const unlisten = this.session.onStop(end);
        this.session.say({ text: TEXTS.first.pushes, tone: 'calm' });
    }

    private mayBePushed({ isHeld, isPowered }: RobotState): boolean {
        const { physics, connection, where } = this.session.state.get();
        return physics !== 'loading' && connection === 'ready' && where !== null && !isHeld && isPowered;
    }
}

define('first-minute', FirstMinute);
