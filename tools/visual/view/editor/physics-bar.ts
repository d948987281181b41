// SPDX-License-Identifier: MIT
// Part of Checks: starts trials of motions in physics, shows progress and a summary of the results.

import { pageOf } from '../../model/document.ts';
import { define, handOver, make, setText } from '../element.ts';
import type { TrialsState } from '../session/trials.ts';
import { titleOf } from '../texts/editor.ts';
import { TEXTS } from '../texts/texts.ts';
import { countedText } from '../texts/trials.ts';
import { SessionElement } from '../session-element.ts';

export class PhysicsBar extends SessionElement {
    private readonly one = make('button', { onclick: () => void this.session.trials.run([this.session.editor.state.get().page]) });
    private readonly all = make(
        'button',
        { class: 'primary', onclick: () => void this.session.trials.run(this.playable()) },
        TEXTS.trials.tryAll,
    );
    private readonly stop = make('button', { onclick: () => this.session.trials.cancel() }, TEXTS.trials.stop);
    private readonly progress = make('progress', { 'aria-label': TEXTS.trials.tried });
    private readonly row = make('div', { class: 'row' }, this.one, this.all, this.stop, this.progress);
    private readonly status = make('p', { class: 'result', role: 'status', tabindex: '-1', 'aria-label': TEXTS.trials.state });

    connectedCallback(): void {
        this.replaceChildren(make('p', { class: 'purpose' }, TEXTS.trials.purpose), this.row, this.status);
        const { trials, editor, state } = this.session;
        this.watch(() => this.render(), trials.state, editor.state, state);
    }

    private playable(): number[] {
        const { format, state } = this.session.editor;
        const { document } = state.get();
        return document.pages.flatMap((_, page) => (page > 0 && format.isPlayable(pageOf(document, page)) ? [page] : []));
    }

    private render(): void {
        const { editor, trials, state } = this.session;
        if (state.get().tab !== 'checks' || editor.state.get().gesture) return;
        const { page } = editor.state.get();
        const trial = trials.state.get();
        const isBusy = trial.phase === 'loading' || trial.phase === 'trying';
        const playable = this.playable();
        this.one.textContent = TEXTS.trials.tryOne(titleOf(editor, page));
        this.one.disabled = !playable.includes(page) || trials.isFresh(page);
        this.all.disabled = playable.every(one => trials.isFresh(one));
        if (this.stop.hidden === isBusy) this.turn(isBusy);
        this.progress.max = Math.max(1, trial.total);
        this.progress.value = trial.done;
        setText(this.status, this.textOf(trial, playable));
    }

    private turn(isBusy: boolean): void {
        const wanted = isBusy ? this.stop : ([this.all, this.one].find(button => !button.disabled) ?? this.status);
        handOver(this.row, wanted, () => {
            this.one.hidden = this.all.hidden = isBusy;
            this.stop.hidden = this.progress.hidden = !isBusy;
        });
    }

    private textOf(trial: TrialsState, playable: readonly number[]): string {
        if (trial.phase === 'loading') return TEXTS.trials.loading;
        if (trial.phase === 'failed') return TEXTS.trials.failed(trial.trouble ?? '');
        if (trial.phase === 'trying' && trial.page !== null)
            return TEXTS.trials.trying(titleOf(this.session.editor, trial.page), trial.done + 1, trial.total);
        const known = playable.flatMap(page => trial.trials.get(page) ?? []);
        const changed = playable.filter(page => trial.trials.has(page) && !this.session.trials.isFresh(page)).length;
        return countedText(
            known.map(({ verdict }) => verdict.kind),
            playable.length - known.length,
            changed,
        );
    }
}

define('physics-bar', PhysicsBar);
