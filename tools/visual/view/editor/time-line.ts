// SPDX-License-Identifier: MIT
// Time and pause of the steps, drawn to scale, with ends to drag. The fields below the pictures do the same by keyboard.

import { TICKS_PER_SECOND } from '../../model/motion.ts';
import { BYTE_MAX } from '../../model/page.ts';
import type { Gesture } from '../session/editor.ts';
import { define, make, withoutMenu } from '../element.ts';
import { TypedFor } from './shown-for.ts';
import { nearestSetting, stepTimes } from './step-times.ts';
import type { TimedField } from './step-times.ts';
import { setTimes } from './typed-numbers.ts';
import { TEXTS } from '../texts/texts.ts';
import { SessionElement } from '../session-element.ts';

/** Distance at which a pointer grabs an end. */
const NEAR_PX = { mouse: 7, finger: 24 };
/** Spare seconds at the end, so that the last step can be dragged longer. */
const ROOM_S = 0.4;

interface Drag {
    readonly index: number;
    readonly field: TimedField;
    readonly startX: number;
    readonly startSeconds: number;
    readonly secondsPerPixel: number;
    readonly gesture: Gesture;
}

export class TimeLine extends SessionElement {
    private readonly bar = make('div', { class: 'bar', role: 'img' });
    private readonly head = make('i', { class: 'head', hidden: true });
    private readonly frame = make('div', { class: 'frame' });
    private isScrubbing = false;
    private readonly total = make('p', { class: 'total' });
    private readonly times = make('input', {
        type: 'number',
        min: 1,
        max: BYTE_MAX,
        'aria-label': TEXTS.steps.times,
        title: TEXTS.steps.timesHint,
        oninput: () => this.typedTimes.type(),
        onchange: () => this.setTimes(),
    });
    private readonly typedTimes = new TypedFor();
    private drag: Drag | null = null;
    private scale = 1;
    private isBehind = false;

    connectedCallback(): void {
        this.frame.replaceChildren(this.bar, this.head);
        this.replaceChildren(this.frame, this.total, make('label', { class: 'times' }, '×', this.times));
        withoutMenu(this.bar);
        this.bar.addEventListener('pointerdown', event => this.down(event));
        this.bar.addEventListener('pointermove', event => this.move(event));
        this.bar.addEventListener('pointerup', () => this.end(true));
        this.bar.addEventListener('pointercancel', () => this.end(false));
        this.listenTo(window, 'keydown', event => event.key === 'Escape' && this.drag && this.end(false));
        this.disposals.push(
            this.session.state.watch(({ tab }) => tab === 'steps' && this.isBehind && this.render()),
            this.session.editor.state.watch(() => this.render()),
            this.session.preview.state.watch(() => this.renderHead()),
        );
    }

    private render(): void {
        this.isBehind = this.session.state.get().tab !== 'steps'; // hidden: rendered when shown again
        if (this.isBehind) return;
        const { editor } = this.session;
        const { page, steps: chosen } = editor.state.get();
        const times = stepTimes(editor, page);
        const isTimed = editor.page(page).schedule === 'time';
        const all = times.reduce((sum, { move, pause }) => sum + move + pause, 0);
        if (!this.drag) this.scale = all + ROOM_S; // the scale stays fixed during a drag
        const share = (seconds: number): string => `${(100 * seconds) / this.scale}%`;
        this.bar.replaceChildren(
            ...times.flatMap(({ move, pause }, index) => {
                const way = make(
                    'div',
                    { class: `way${chosen.has(index) ? ' chosen' : ''}` },
                    make('span', {}, String(index + 1)),
                    isTimed ? this.handle('time') : null,
                );
                const rest = make('div', { class: 'rest' }, this.handle('pause'));
                way.style.width = share(move);
                rest.style.width = share(pause);
                return [way, rest];
            }),
        );
        this.hidden = times.length === 0;
        this.total.textContent = `${all.toFixed(2)} s`;
        if (!this.typedTimes.isHalfTyped(editor.state.get())) this.times.value = String(editor.page(page).repetitions);
        this.bar.setAttribute('aria-label', TEXTS.steps.takes(all.toFixed(2)));
    }

    /** Sets how often the steps are repeated before the motion ends or continues. */
    private setTimes(): void {
        if (!this.typedTimes.take()) return;
        const { editor } = this.session;
        setTimes(this.session, this.times.value);
        this.times.value = String(editor.page(editor.state.get().page).repetitions);
    }

    /** For a pointer away from all ends: the picture shows the moment under it. */
    private scrub(event: PointerEvent): void {
        event.preventDefault();
        this.bar.setPointerCapture(event.pointerId);
        this.isScrubbing = true;
        this.seekTo(event);
    }

    private seekTo({ clientX }: PointerEvent): void {
        const { editor, preview } = this.session;
        const { page } = editor.state.get();
        const boxes = [...this.bar.children].map(part => part.getBoundingClientRect());
        const under = boxes.findIndex(({ right }) => clientX < right);
        const part = under < 0 ? boxes.length - 1 : under; // behind the end: the last one
        const box = boxes[part];
        if (!box) return;
        const index = Math.floor(part / 2); // each step has a way and a rest
        const { move = 0, pause = 0 } = stepTimes(editor, page)[index] ?? {};
        const share = Math.max(0, Math.min((clientX - box.left) / box.width, 1));
        const seconds = part % 2 === 0 ? share * move : move + share * pause;
        preview.seek(page, preview.tickOf(page, index) + Math.round(seconds * TICKS_PER_SECOND));
    }

    /** Marks the moment that the picture shows, if it belongs to this page. */
    private renderHead(): void {
        const { editor, preview } = this.session;
        const { page } = editor.state.get();
        const { figure, ticks, at } = preview.state.get();
        const [way, rest] = [...this.bar.children].slice(2 * (at.step - 1), 2 * at.step) as HTMLElement[];
        const time = stepTimes(editor, page)[at.step - 1];
        this.head.hidden = figure !== 'shown' || ticks === 0 || at.page !== page || !way || !rest || !time;
        if (this.head.hidden || !way || !rest || !time) return;
        const since = preview.sinceStep() / TICKS_PER_SECOND;
        const within = (part: HTMLElement, seconds: number, all: number): number =>
            part.offsetLeft + part.offsetWidth * (all > 0 ? Math.min(seconds / all, 1) : 0);
        this.head.style.left = `${since < time.move ? within(way, since, time.move) : within(rest, since - time.move, time.pause)}px`;
    }

    private handle(field: TimedField): HTMLElement {
        return make('i', {
            class: `handle ${field}`,
            title: field === 'time' ? TEXTS.steps.dragTime : TEXTS.steps.dragPause,
        });
    }

    private down(event: PointerEvent): void {
        if (event.button !== 0) return;
        const end = this.endAt(event);
        if (!end) return this.scrub(event);
        event.preventDefault();
        this.bar.setPointerCapture(event.pointerId);
        const { index, field } = end;
        const { editor } = this.session;
        const times = stepTimes(editor, editor.state.get().page)[index];
        const gesture = editor.gesture(field === 'time' ? 'set-time' : 'set-pause');
        const startSeconds = (field === 'time' ? times?.move : times?.pause) ?? 0;
        this.drag = {
            index,
            field,
            startX: event.clientX,
            startSeconds,
            secondsPerPixel: this.scale / Math.max(1, this.bar.clientWidth),
            gesture,
        };
    }

    /** The nearest end within reach. CSS draws an empty pause slightly wide, so that both ends of a step can be grabbed. */
    private endAt({ clientX, pointerType }: PointerEvent): { readonly index: number; readonly field: TimedField } | null {
        const { editor } = this.session;
        const isTimed = editor.page(editor.state.get().page).schedule === 'time';
        const ends = [...this.bar.children].map((part, i) => {
            const field: TimedField = i % 2 === 0 ? 'time' : 'pause'; // in the order of render()
            return { index: Math.floor(i / 2), field, off: Math.abs(clientX - part.getBoundingClientRect().right) };
        });
        const [nearest] = ends.filter(({ field }) => isTimed || field === 'pause').sort((a, b) => a.off - b.off);
        return nearest && nearest.off <= (pointerType === 'touch' ? NEAR_PX.finger : NEAR_PX.mouse) ? nearest : null;
    }

    private move(event: PointerEvent): void {
        if (this.isScrubbing) this.seekTo(event);
        if (!this.drag) return;
        const { index, field, startX, startSeconds, secondsPerPixel, gesture } = this.drag;
        const { editor } = this.session;
        const { page } = editor.state.get();
        const seconds = Math.max(0, startSeconds + (event.clientX - startX) * secondsPerPixel);
        const value = nearestSetting(editor, page, index, field, seconds);
        gesture.change(
            field === 'time'
                ? editor.edits.setTime(gesture.start, page, [index], value)
                : editor.edits.setPause(gesture.start, page, [index], value),
        );
    }

    private end(keep: boolean): void {
        const { drag } = this;
        this.isScrubbing = false;
        this.drag = null;
        if (keep) drag?.gesture.finish();
        else drag?.gesture.cancel();
        if (drag) this.render();
    }
}

define('time-line', TimeLine);
