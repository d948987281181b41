// SPDX-License-Identifier: MIT
// The status bar at the bottom: what the robot does, and the last message.

import { Announcer } from './announcer.ts';
import type { SessionState, Notice } from './session/session.ts';
import { define, make, setText } from './element.ts';
import { postureText } from './texts/robot.ts';
import { TEXTS } from './texts/texts.ts';
import { SessionElement } from './session-element.ts';
import './status-bar.css';

export class StatusBar extends SessionElement {
    private readonly doing = make('p', { class: 'doing', role: 'status', 'aria-live': 'off', 'aria-label': TEXTS.status.activity });
    private readonly message = make('p', { class: 'message', role: 'log', 'aria-live': 'off', 'aria-label': TEXTS.status.message });
    /** The only part that screen readers read aloud. */
    private readonly spoken = make('p', { class: 'visually-hidden', 'aria-live': 'polite', 'aria-label': TEXTS.status.announcements });
    private readonly announcer = new Announcer({
        say: text => setText(this.spoken, text),
        after: (delayMs, call) => void setTimeout(call, delayMs),
    });
    /** Stands as long as what the robot saves is not kept. */
    private readonly unkept = make('p', { class: 'unkept', role: 'status', 'aria-label': TEXTS.status.memory, 'data-tone': 'bad' });
    private readonly facts = make('p', { class: 'facts' });
    /** As the robot in the page reported last. */
    private posture = { hasFallen: false, isHeld: false };

    connectedCallback(): void {
        this.replaceChildren(this.doing, this.message, this.facts, this.unkept, this.spoken);
        const sizes = new ResizeObserver(() => document.documentElement.style.setProperty('--status-bar-height', `${this.offsetHeight}px`));
        sizes.observe(this); // tour.css
        this.disposals.push(
            () => sizes.disconnect(),
            this.session.state.watch(state => this.render(state)),
            this.session.onFrame(({ hasFallen, isHeld }) => {
                if (hasFallen === this.posture.hasFallen && isHeld === this.posture.isHeld) return;
                this.posture = { hasFallen, isHeld };
                this.render(this.session.state.get());
            }),
        );
    }

    private render(state: SessionState): void {
        const posture = postureText(state, this.posture);
        const liesIdle =
            posture === TEXTS.status.fallen && (state.doing.text === TEXTS.status.waits || state.doing.text === TEXTS.status.editRuns);
        this.write(this.doing, {
            ...state.doing,
            text: liesIdle ? TEXTS.status.getUp : [state.doing.text, posture].filter(Boolean).join(' '),
        });
        this.announcer.look(state, posture);
        this.write(this.message, state.message);
        setText(this.unkept, state.isSecond && state.source === 'simulated' ? TEXTS.robot.second : '');
        const where = state.where;
        const version = state.version;
        setText(
            this.facts,
            [
                version
                    ? `${version.image === 'edit' ? 'Edit' : version.image === 'play' ? 'Play' : version.image} ${version.version}`
                    : '',
                where && where.batteryVolts > 0 ? `${where.batteryVolts.toFixed(1)} V` : '',
                state.speed === 1 || state.source !== 'simulated'
                    ? ''
                    : state.speed === 0
                      ? TEXTS.status.timeStands
                      : TEXTS.status.timeRuns(state.speed),
            ]
                .filter(Boolean)
                .join(' · '),
        );
    }

    private write(line: HTMLElement, notice: Notice | null): void {
        setText(line, notice?.text ?? '');
        line.dataset.tone = notice?.tone ?? 'calm';
    }
}

define('status-bar', StatusBar);
