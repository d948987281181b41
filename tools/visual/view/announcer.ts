// SPDX-License-Identifier: MIT
// What a screen reader announces: start, end, fall, held robot and errors, at most one sentence per second. The status bar changes at
// every step of a motion, which is too often to be read aloud.

import type { SessionState } from './session/session.ts';
import { doingText, startText } from './texts/robot.ts';

export const ANNOUNCE_MS = 1000;

export interface AnnouncerParts {
    say(text: string): void;
    after(delayMs: number, call: () => void): void;
}

/** A joint that is moved by code is told like a play, and told again when a play over it has ended. */
function movementOf({ where }: SessionState): 'none' | 'code' | 'play' {
    if (where === null) return 'none';
    if (where.state !== 'idle' && where.state !== 'ready') return 'play';
    return where.aimed > 0 ? 'code' : 'none';
}

export class Announcer {
    private readonly parts: AnnouncerParts;
    private movement: 'none' | 'code' | 'play' = 'none';
    private isWaiting = false;
    private due: string[] = [];
    private last = '';
    private lastTrouble = '';
    private wasReady = true;
    private lastFallen = '';

    constructor(parts: AnnouncerParts) {
        this.parts = parts;
    }

    /** fallen: text for a robot that lies or is held; '' otherwise. */
    look(state: SessionState, fallen: string): void {
        const movement = movementOf(state);
        if (movement !== this.movement) this.tell(startText(state));
        this.movement = movement;
        if (fallen !== this.lastFallen && fallen !== '') this.tell(fallen);
        this.lastFallen = fallen;
        const isOff = state.source === 'simulated' && !state.isPowered;
        const answers = state.connection === 'ready' && !isOff;
        // Not state.doing, which may be set after the state that it describes.
        const silence = answers ? '' : doingText({ ...state, shownPage: null }, null);
        const trouble = state.message?.tone === 'bad' ? state.message.text : silence;
        if (trouble !== this.lastTrouble && trouble !== '') this.tell(trouble);
        this.lastTrouble = trouble;
        const isReady = state.connection === 'ready';
        if (isReady && !this.wasReady && movement === 'none') this.tell(startText(state));
        this.wasReady = isReady;
    }

    private tell(text: string): void {
        if (text === this.last && this.due.length === 0) return;
        this.due = [...this.due.filter(one => one !== text), text].slice(-2); // anything older is out of date
        this.next();
    }

    private next(): void {
        if (this.isWaiting) return;
        const text = this.due.shift();
        if (text === undefined) return;
        this.last = text;
        this.parts.say(text);
        this.isWaiting = true;
        this.parts.after(ANNOUNCE_MS, () => {
            this.isWaiting = false;
            this.next();
        });
    }
}
