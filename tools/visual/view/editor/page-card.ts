// SPDX-License-Identifier: MIT
// Card of one of the 128 pages: its most distinctive pose, number, name, duration and remote code. The picture is drawn when it first comes
// into view.

import { anglesOf } from '../../model/body.ts';
import type { Body } from '../../model/body.ts';
import { pageSeconds, readPage } from '../../model/page.ts';
import type { PageView, Step } from '../../model/page.ts';
import type { PageFormat } from '../../model/page-format.ts';
import { define, make } from '../element.ts';
import { showPose } from './pose-picture.ts';
import { codeText } from '../texts/editor.ts';
import { TEXTS } from '../texts/texts.ts';

const PICTURE = { width: 64, height: 74 };

/** The step farthest from the first one. Most motions begin and end standing and look alike there. */
export function tellingStep(page: PageView): Step | undefined {
    const [first] = page.steps;
    const way = (step: Step): number =>
        step.positions.reduce<number>((sum, position, id) => {
            const from = first?.positions[id] ?? null;
            return position === null || from === null ? sum : sum + Math.abs(position - from);
        }, 0);
    return page.steps.reduce<Step | undefined>((best, step) => (best && way(best) >= way(step) ? best : step), first);
}

export interface CardState {
    readonly isSelected: boolean;
    /** The robot's page differs. */
    readonly isDirty: boolean;
    readonly isPlaying: boolean;
}

export class PageCard extends HTMLElement {
    body!: Body; // set before it is connected, like format and page
    format!: PageFormat;
    page = 0;
    private bytes: Uint8Array | null = null;
    private isSeen = false;
    private picture: HTMLCanvasElement | null = null;
    private readonly title1 = make('b');
    private readonly name1 = make('span', { class: 'name' });
    private readonly facts = make('span', { class: 'facts' });
    private readonly frame = make('span', { class: 'picture' });

    connectedCallback(): void {
        if (this.hasChildNodes()) return;
        this.setAttribute('role', 'option');
        this.dataset.page = String(this.page);
        this.title1.textContent = String(this.page);
        this.append(this.frame, make('span', { class: 'line' }, this.title1, ' ', this.name1), ' ', this.facts);
    }

    /** Text for the search, in lower case. */
    get words(): string {
        return `${this.page} ${this.name1.textContent ?? ''}`.toLowerCase();
    }

    show(bytes: Uint8Array, state: CardState): void {
        if (bytes !== this.bytes) this.take(bytes);
        this.setAttribute('aria-selected', String(state.isSelected));
        this.tabIndex = state.isSelected ? 0 : -1;
        this.classList.toggle('dirty', state.isDirty);
        this.classList.toggle('playing', state.isPlaying);
        this.title = state.isDirty ? TEXTS.motion.ofRobotDiffers : '';
    }

    /** Call when the card comes into view: draws its picture. */
    see(): void {
        this.isSeen = true;
        this.draw();
    }

    private take(bytes: Uint8Array): void {
        this.bytes = bytes;
        const { format } = this;
        const isEmpty = format.isEmpty(bytes);
        const isDamaged = format.fault(bytes) !== null;
        const page = readPage(format, bytes);
        this.classList.toggle('empty', isEmpty);
        this.classList.toggle('damaged', isDamaged);
        this.draggable = !isEmpty && !isDamaged && this.page > 0;
        this.name1.textContent = this.page === 0 ? TEXTS.motion.trim : page.name;
        const seconds = pageSeconds(format, bytes);
        const steps = page.steps.length;
        const parts = [seconds > 0 ? `${seconds.toFixed(1)} s` : '', steps > 0 ? TEXTS.motion.stepsShort(steps) : '', codeText(page.code)];
        this.facts.textContent = isDamaged ? TEXTS.motion.damaged : isEmpty ? '' : parts.filter(Boolean).join(' · ');
        this.setAttribute('aria-label', this.label(isEmpty, steps));
        this.picture = null;
        this.draw();
    }

    /** The accessible name. It begins with the visible text in its order (WCAG 2.5.3), for voice control. Then come unabbreviated words. */
    private label(isEmpty: boolean, steps: number): string {
        const title = TEXTS.motion.card(this.page, this.name1.textContent ?? '');
        const whole = isEmpty ? TEXTS.motion.empty : TEXTS.motion.steps(steps);
        return [title, this.facts.textContent, whole].filter(Boolean).join(', ');
    }

    private draw(): void {
        const { bytes, format } = this;
        if (!this.isSeen || this.picture || !bytes) return;
        const step = format.isEmpty(bytes) || this.page === 0 ? undefined : tellingStep(readPage(format, bytes));
        if (!step) return this.frame.replaceChildren();
        this.picture = make('canvas', { 'aria-hidden': 'true' });
        showPose(this.picture, this.body, anglesOf(this.body, step.positions, new Map()), PICTURE.width, PICTURE.height);
        this.frame.replaceChildren(this.picture);
    }
}

define('page-card', PageCard);
