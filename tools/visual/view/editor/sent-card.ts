// SPDX-License-Identifier: MIT
// A motion from the page's address is added to the document, and the robot in the page plays it. The card names it and offers what to do
// next.

import { define, handOver, make, pictureCanvas } from '../element.ts';
import type { SentMotion } from '../session/files.ts';
import { TEXTS } from '../texts/texts.ts';
import { SessionElement } from '../session-element.ts';
import './sent-card.css';

export class SentCard extends SessionElement {
    onSent: () => void = () => undefined; // set before it is connected
    onTeach: () => void = () => undefined;
    /** The document that the motion was added to. */
    private openId = '';

    connectedCallback(): void {
        this.hidden = true;
        this.setAttribute('role', 'region');
        this.setAttribute('aria-label', TEXTS.sent.region);
        this.disposals.push(
            this.session.files.state.watch(({ sent }) => sent && this.take(sent)),
            this.session.documents.state.watch(({ openId }) => openId !== this.openId && this.leave()),
        );
    }

    private take({ name }: SentMotion): void {
        this.onSent();
        const page = this.session.files.addSent();
        if (page === 0) return this.session.files.dismiss(); // no space; addSent() has reported it
        window.history.replaceState(null, '', window.location.pathname + window.location.search);
        this.openId = this.session.documents.state.get().openId;
        this.show(name, page);
        if (this.session.state.get().source === 'simulated') void this.session.run(page);
        else this.session.preview.start(page); // another robot moves only when it is told to
    }

    leave(): void {
        if (!this.hidden) handOver(this, pictureCanvas(), () => (this.hidden = true));
    }

    private show(name: string, page: number): void {
        const button = (title: string, action: () => void, kind = ''): HTMLButtonElement =>
            make('button', { class: kind, onclick: action }, title);
        const leave = (action: () => void): void => {
            this.leave();
            action();
        };
        this.replaceChildren(
            make('h2', {}, TEXTS.sent.title(name)),
            make(
                'div',
                { class: 'row' },
                button(TEXTS.sent.again, () => void this.session.run(page), 'primary'),
                button(TEXTS.sent.edit, () => leave(() => this.session.show('steps'))),
                button(TEXTS.sent.teach, () => leave(this.onTeach)),
                button(TEXTS.page.close, () => leave(() => undefined)),
            ),
        );
        this.hidden = false;
    }
}

define('sent-card', SentCard);
