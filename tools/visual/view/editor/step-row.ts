// SPDX-License-Identifier: MIT
// The steps of the page as a row of pictures with time and pause. A click chooses a step, Shift and Ctrl choose several, a drag moves them.
// Arrow keys choose, with Shift several; with Alt they move the steps.

import { anglesOf } from '../../model/body.ts';
import type { EditorState } from '../../model/editor-state.ts';
import type { Step } from '../../model/page.ts';
import { define, handOver, isTyping, make, withoutMenu } from '../element.ts';
import { keyOf } from '../key-of.ts';
import { showPose } from './pose-picture.ts';
import { TEXTS } from '../texts/texts.ts';
import { ShownFor } from './shown-for.ts';
import { chosenSteps } from './step-choice.ts';
import { stepTimes } from './step-times.ts';
import type { TimedField } from './step-times.ts';
import { FIELD_STEP, setStepField } from './typed-numbers.ts';
import { SessionElement } from '../session-element.ts';

const PICTURE = { width: 64, height: 84 };
const DRAG_PX = 6;

interface Card {
    readonly root: HTMLLIElement;
    readonly pick: HTMLButtonElement;
    readonly canvas: HTMLCanvasElement;
    readonly time: HTMLInputElement;
    readonly pause: HTMLInputElement;
    pose: string;
}

export class StepRow extends SessionElement {
    private readonly list = make('ol', { 'aria-label': TEXTS.steps.row });
    private readonly cards: Card[] = [];
    private readonly empty = make('p', { class: 'empty', tabindex: -1 }, TEXTS.steps.empty);
    private playing = -1;
    private isBehind = false;
    /** The field in which the user is typing. */
    private typing: HTMLInputElement | null = null;
    private readonly shownFor = new ShownFor();
    /** began: an undo or another motion meanwhile ends it, because the steps are no longer those that were taken hold of. */
    private drag: { readonly from: number; readonly startX: number; readonly began: EditorState; to: number | null } | null = null;

    connectedCallback(): void {
        const titles = make(
            'p',
            { class: 'titles', 'aria-hidden': true },
            make('span', {}, TEXTS.steps.time),
            make('span', {}, TEXTS.steps.pause),
        );
        this.replaceChildren(titles, this.list, this.empty);
        this.listenTo(window, 'keydown', event => event.key === 'Escape' && this.endDrag());
        this.disposals.push(
            this.session.editor.state.watch(({ document, page }) => {
                const began = this.drag?.began;
                if (began && (began.document !== document || began.page !== page)) this.endDrag();
                this.render();
            }),
            this.session.state.watch(({ tab }) => {
                if (tab === 'steps' && this.isBehind) this.render();
                this.markPlaying();
            }),
            this.session.preview.state.watch(() => this.markPlaying()),
        );
    }

    /** Ctrl+A chooses all steps anywhere in Steps, except while typing. */
    listenForAll(): void {
        this.listenTo(document, 'keydown', event => {
            if (keyOf(event) !== 'a' || !(event.ctrlKey || event.metaKey) || event.altKey || this.session.state.get().tab !== 'steps')
                return;
            if (isTyping(event) || (event.target instanceof Element && event.target.closest('dialog'))) return;
            event.preventDefault();
            this.session.editor.select({ steps: new Set(this.cards.keys()) });
        });
    }

    /** Marks the step that the picture previews or the robot plays. */
    private markPlaying(): void {
        const { where } = this.session.state.get();
        const { figure, at } = this.session.preview.state.get();
        const { page } = this.session.editor.state.get();
        const now = figure === 'shown' ? at : where?.state === 'playing' ? where : null;
        const playing = now !== null && now.page === page ? now.step - 1 : -1;
        if (playing === this.playing) return;
        this.playing = playing;
        for (const [index, card] of this.cards.entries()) card.root.classList.toggle('playing', index === playing);
    }

    /** Focuses the cursor's card; without steps, the hint in its place. */
    focusCursor(): void {
        const { page, step } = this.session.editor.state.get();
        const isEmpty = this.session.editor.page(page).steps.length === 0;
        ((isEmpty ? null : this.cards[step]?.pick) ?? this.empty).focus();
    }

    private render(): void {
        this.isBehind = this.session.state.get().tab !== 'steps'; // hidden: rendered when shown again
        if (this.isBehind) return;
        const { editor } = this.session;
        const state = editor.state.get();
        if (this.shownFor.isOther(state)) this.typing = null;
        const { steps, schedule } = editor.page(state.page);
        const count = Math.max(1, steps.length); // without steps an invisible card reserves the space, so that nothing jumps later
        while (this.cards.length > count) this.cards.pop()?.root.remove();
        while (this.cards.length < count) this.addCard(this.cards.length);
        const isEmpty = steps.length === 0;
        handOver(isEmpty ? this : this.empty, isEmpty ? this.empty : (this.cards[state.step]?.pick ?? null), () => {
            this.empty.hidden = !isEmpty;
            this.classList.toggle('without', isEmpty);
        });
        const times = stepTimes(editor, state.page);
        for (const [index, card] of this.cards.entries()) {
            const isCursor = index === state.step;
            card.pick.setAttribute('aria-pressed', String(state.steps.has(index)));
            card.pick.setAttribute('aria-current', String(isCursor));
            card.pick.tabIndex = isCursor ? 0 : -1;
            card.root.classList.toggle('playing', index === this.playing);
            this.showFields(card, schedule, steps[index], times[index]);
            this.picture(card, index);
        }
    }

    private showFields(
        card: Card,
        schedule: 'time' | 'speed',
        step: Step | undefined,
        seconds: { move: number; pause: number } | undefined,
    ): void {
        const isSpeed = schedule === 'speed';
        card.time.step = isSpeed ? '1' : String(FIELD_STEP);
        card.time.title = isSpeed ? TEXTS.steps.speedHint : TEXTS.steps.secondsHint;
        const write = (input: HTMLInputElement, value: string): void => {
            if (this.typing !== input) input.value = value;
        };
        write(card.time, isSpeed ? String(step?.time ?? 0) : (seconds?.move ?? 0).toFixed(2));
        write(card.pause, (seconds?.pause ?? 0).toFixed(2));
    }

    private picture(card: Card, index: number): void {
        const { editor, body } = this.session;
        const pose = editor.poseAfter(editor.state.get().page, index);
        const key = pose.join();
        if (key === card.pose) return;
        card.pose = key;
        showPose(card.canvas, body, anglesOf(body, pose, new Map()), PICTURE.width, PICTURE.height);
    }

    private addCard(index: number): void {
        const canvas = make('canvas', { 'aria-hidden': true });
        const pick = make(
            'button',
            { class: 'pick', 'aria-label': TEXTS.steps.step(index + 1) },
            canvas,
            make('span', { class: 'number' }, String(index + 1)),
        );
        const time = this.field(index, 'time', TEXTS.steps.timeOf(index + 1));
        const pause = this.field(index, 'pause', TEXTS.steps.pauseOf(index + 1));
        const root = make('li', {}, pick, time, pause);
        withoutMenu(pick);
        pick.addEventListener('pointerdown', event => this.down(event, index, pick));
        pick.addEventListener('pointermove', event => this.moveDrag(event));
        pick.addEventListener('pointerup', event => this.up(event));
        pick.addEventListener('pointercancel', () => this.endDrag());
        pick.addEventListener('keydown', event => this.key(event, index));
        this.cards.push({ root, pick, canvas, time, pause, pose: '' });
        this.list.append(root);
    }

    private field(index: number, field: TimedField, title: string): HTMLInputElement {
        const input = make('input', { type: 'number', min: 0, step: FIELD_STEP, 'aria-label': title });
        input.addEventListener('input', () => (this.typing = input));
        const typed = (): void => {
            this.typing = null;
            this.render(); // the stored value may differ from what was typed
        };
        input.addEventListener('change', () => {
            if (this.typing === input) setStepField(this.session, index, field, input.value);
            typed();
        });
        input.addEventListener('blur', typed);
        return input;
    }

    private choose(index: number, event: { readonly shiftKey: boolean; readonly ctrlKey: boolean; readonly metaKey: boolean }): void {
        const { editor } = this.session;
        editor.select(chosenSteps(editor.state.get(), index, event));
    }

    private key(event: KeyboardEvent, index: number): void {
        const count = this.cards.length;
        const by = { ArrowLeft: -1, ArrowRight: 1, Home: -count, End: count }[event.key];
        if (by === undefined) return;
        event.preventDefault();
        if (event.altKey) this.moveChosen(by < 0 ? -1 : 1);
        else {
            const to = Math.min(Math.max(index + by, 0), count - 1);
            this.choose(to, { shiftKey: event.shiftKey, ctrlKey: false, metaKey: false });
        }
        this.focusCursor();
    }

    /** Moves the chosen steps by one place, for the keyboard. */
    private moveChosen(by: 1 | -1): void {
        const { steps } = this.session.editor.state.get();
        const sorted = [...steps].sort((a, b) => a - b);
        const to = by < 0 ? (sorted[0] ?? 0) - 1 : (sorted.at(-1) ?? 0) + 2;
        if (to >= 0 && to <= this.cards.length) this.moveTo(to);
    }

    /** Moves the chosen steps before the one that is at `to` now; the cursor moves with them. */
    private moveTo(to: number): void {
        const { editor } = this.session;
        const { page, step, steps, document } = editor.state.get();
        if (!editor.dispatch(editor.edits.moveSteps(document, page, steps, to))) return;
        const sorted = [...steps].sort((a, b) => a - b);
        const begin = to - sorted.filter(index => index < to).length;
        editor.select({ step: begin + Math.max(0, sorted.indexOf(step)), steps: new Set(sorted.map((_, i) => begin + i)) });
    }

    private down(event: PointerEvent, index: number, pick: HTMLButtonElement): void {
        if (event.button !== 0) return;
        if (!this.session.editor.state.get().steps.has(index) || event.shiftKey || event.ctrlKey || event.metaKey)
            this.choose(index, event);
        pick.setPointerCapture(event.pointerId);
        this.drag = { from: index, startX: event.clientX, began: this.session.editor.state.get(), to: null };
    }

    private moveDrag(event: PointerEvent): void {
        const { drag } = this;
        if (!drag || (drag.to === null && Math.abs(event.clientX - drag.startX) < DRAG_PX)) return;
        const middles = this.cards.map(({ root }) => {
            const box = root.getBoundingClientRect();
            return box.left + box.width / 2;
        });
        drag.to = middles.filter(middle => middle < event.clientX).length;
        for (const [index, { root }] of this.cards.entries()) {
            root.classList.toggle('drop-before', index === drag.to);
            root.classList.toggle('drop-behind', index === this.cards.length - 1 && drag.to === this.cards.length);
        }
    }

    private up(event: PointerEvent): void {
        const { drag } = this;
        this.endDrag();
        if (!drag) return;
        if (drag.to !== null) this.moveTo(drag.to);
        else if (!event.shiftKey && !event.ctrlKey && !event.metaKey) this.choose(drag.from, event);
    }

    private endDrag(): void {
        this.drag = null;
        for (const { root } of this.cards) root.classList.remove('drop-before', 'drop-behind');
    }
}

define('step-row', StepRow);
