// SPDX-License-Identifier: MIT
// Time and pause of the steps, drawn to scale; their ends are dragged. By keyboard the fields below the pictures do the same.

import type { Desk } from '../desk.ts';
import type { Gesture } from '../editor-desk.ts';
import { define, make } from '../element.ts';
import { nearestSetting, stepTimes } from './step-times.ts';
import type { TimedField } from './step-times.ts';

/** Seconds behind the end, so that the last step can be dragged longer. */
const ROOM_S = 0.4;

interface Drag {
  readonly index: number;
  readonly field: TimedField;
  readonly startX: number;
  readonly startSeconds: number;
  readonly secondsPerPixel: number;
  readonly gesture: Gesture;
}

export class TimeLine extends HTMLElement {
  desk!: Desk; // set before it is connected
  private readonly bar = make('div', { class: 'bar', role: 'img' });
  private readonly total = make('p', { class: 'total' });
  private drag: Drag | null = null;
  private scale = 1;
  private isBehind = false;
  private unwatch: () => void = () => undefined;
  private readonly escape = (event: KeyboardEvent): void => {
    if (event.key === 'Escape' && this.drag) this.end(false);
  };

  connectedCallback(): void {
    this.replaceChildren(this.bar, this.total);
    this.bar.addEventListener('pointermove', (event) => this.move(event));
    this.bar.addEventListener('pointerup', () => this.end(true));
    this.bar.addEventListener('pointercancel', () => this.end(false));
    window.addEventListener('keydown', this.escape);
    const unwatchDesk = this.desk.state.watch(({ tab }) => tab === 'steps' && this.isBehind && this.render());
    const unwatchEditor = this.desk.editor.state.watch(() => this.render());
    this.unwatch = () => {
      unwatchDesk();
      unwatchEditor();
    };
  }

  disconnectedCallback(): void {
    this.unwatch();
    window.removeEventListener('keydown', this.escape);
  }

  private render(): void {
    this.isBehind = this.desk.state.get().tab !== 'steps'; // nobody looks: drawn when somebody does
    if (this.isBehind) return;
    const { editor } = this.desk;
    const { page, steps: chosen } = editor.state.get();
    const times = stepTimes(editor, page);
    const isTimed = editor.page(page).schedule === 'time';
    const all = times.reduce((sum, { move, pause }) => sum + move + pause, 0);
    if (!this.drag) this.scale = all + ROOM_S; // the scale stands still under a drag
    const share = (seconds: number): string => `${(100 * seconds) / this.scale}%`;
    this.bar.replaceChildren(...times.flatMap(({ move, pause }, index) => {
      const way = make('div', { class: `way${chosen.has(index) ? ' chosen' : ''}` }, make('span', {}, String(index + 1)), isTimed ? this.handle(index, 'time', move) : null);
      const rest = make('div', { class: 'rest' }, this.handle(index, 'pause', pause));
      way.style.width = share(move);
      rest.style.width = share(pause);
      return [way, rest];
    }));
    this.hidden = times.length === 0;
    this.total.textContent = `${all.toFixed(2)} s`;
    this.bar.setAttribute('aria-label', `The page takes ${all.toFixed(2)} seconds`);
  }

  private handle(index: number, field: TimedField, seconds: number): HTMLElement {
    const handle = make('i', { class: `handle ${field}`, title: field === 'time' ? 'Drag: how long the step takes' : 'Drag: how long it pauses' });
    handle.addEventListener('pointerdown', (event) => {
      if (event.button !== 0) return;
      event.preventDefault();
      this.bar.setPointerCapture(event.pointerId);
      const gesture = this.desk.editor.gesture(field === 'time' ? 'set-time' : 'set-pause');
      this.drag = { index, field, startX: event.clientX, startSeconds: seconds, secondsPerPixel: this.scale / Math.max(1, this.bar.clientWidth), gesture };
    });
    return handle;
  }

  private move(event: PointerEvent): void {
    if (!this.drag) return;
    const { index, field, startX, startSeconds, secondsPerPixel, gesture } = this.drag;
    const { editor } = this.desk;
    const { page } = editor.state.get();
    const seconds = Math.max(0, startSeconds + (event.clientX - startX) * secondsPerPixel);
    const value = nearestSetting(editor, page, index, field, seconds);
    gesture.change(field === 'time' ? editor.edits.setTime(gesture.start, page, [index], value) : editor.edits.setPause(gesture.start, page, [index], value));
  }

  private end(keep: boolean): void {
    const { drag } = this;
    this.drag = null;
    if (keep) drag?.gesture.finish();
    else drag?.gesture.cancel();
    if (drag) this.render();
  }
}

define('time-line', TimeLine);
