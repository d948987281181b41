// SPDX-License-Identifier: MIT
// Previews the motion in the picture only: play, pause, seek, loop. Nothing is sent to the robot.

import { TICKS_PER_SECOND } from '../../model/motion.ts';
import { define, make, setText, setDisabled } from '../element.ts';
import { TEXTS } from '../texts/texts.ts';
import { SessionElement } from '../session-element.ts';

export class PlayBar extends SessionElement {
    private readonly show = make('button', { class: 'show', title: TEXTS.preview.hint, onclick: () => this.toggle() }, TEXTS.preview.show);
    private readonly fromStep = make(
        'button',
        { title: TEXTS.preview.fromStepHint, onclick: () => this.startAtStep() },
        TEXTS.preview.fromStep,
    );
    private readonly moment = make('input', {
        type: 'range',
        min: 0,
        max: 0,
        step: 1,
        value: 0,
        'aria-label': TEXTS.preview.moment,
        oninput: () => this.seek(),
    });
    private readonly clock = make('output', { 'aria-live': 'off' });
    private readonly loop = make('input', { type: 'checkbox', onchange: () => this.session.preview.setLooping(this.loop.checked) });

    connectedCallback(): void {
        this.setAttribute('role', 'group');
        this.setAttribute('aria-label', TEXTS.preview.inPicture);
        this.replaceChildren(
            this.show,
            this.fromStep,
            this.moment,
            this.clock,
            make('label', { title: TEXTS.preview.loopHint }, this.loop, TEXTS.preview.loop),
        );
        this.watch(() => this.render(), this.session.preview.state, this.session.editor.state);
    }

    private render(): void {
        const { editor, preview } = this.session;
        const { page } = editor.state.get();
        const { isRunning, isLooping, tick, ticks } = preview.state.get();
        const isEmpty = editor.page(page).steps.length === 0;
        for (const control of [this.show, this.fromStep, this.moment]) setDisabled(control, isEmpty);
        setText(this.show, isRunning ? TEXTS.preview.pause : TEXTS.preview.show);
        this.moment.max = String(Math.max(1, ticks - 1));
        this.moment.value = String(tick);
        this.loop.checked = isLooping;
        const seconds = (count: number): string => (count / TICKS_PER_SECOND).toFixed(2);
        this.moment.setAttribute('aria-valuetext', `${seconds(tick)} s`);
        setText(this.clock, ticks === 0 ? '' : `${seconds(tick)} / ${seconds(ticks)} s`);
    }

    private toggle(): void {
        const { preview, editor } = this.session;
        const { isRunning, ticks } = preview.state.get();
        if (isRunning) preview.pause();
        else if (ticks > 0) preview.resume();
        else preview.start(editor.state.get().page);
    }

    private startAtStep(): void {
        const { page, step } = this.session.editor.state.get();
        this.session.preview.start(page, step);
    }

    private seek(): void {
        const { preview, editor } = this.session;
        const share = Number(this.moment.value) / Number(this.moment.max);
        const { page } = editor.state.get();
        if (preview.state.get().ticks === 0) preview.seek(page, 0); // this computes its length
        preview.seek(page, Math.round(share * (preview.state.get().ticks - 1)));
    }
}

define('play-bar', PlayBar);
