// SPDX-License-Identifier: MIT
// How the servos follow a curve, as physics has it: asked for in the background once the hand rests, and only while somebody
// wants to see it.

import { JOINTS } from '../../model/motion.ts';
import type { Curve, Shape } from '../../model/motion.ts';
import type { Session } from '../session/session.ts';

const REST_MS = 250;

export class ServoFollow {
    private readonly session: Session;
    /** Something else is to be drawn. */
    private readonly changed: () => void;
    private isOn = false;
    private asked: readonly unknown[] = [];
    private stop = new AbortController();
    private timer: ReturnType<typeof setTimeout> | undefined;
    /** JOINTS servo units a tick; null: not known now. */
    positions: Float32Array | null = null;
    /** Physics was asked and cannot tell. */
    isUnknown = false;

    constructor(session: Session, changed: () => void) {
        this.session = session;
        this.changed = changed;
    }

    setOn(on: boolean): void {
        this.isOn = on;
        this.forget();
        this.changed();
    }

    /** What is drawn now: asks again when it is another motion. */
    look(ticks: number, shape: Shape): void {
        const { document, page, law, gesture } = this.session.editor.state.get();
        const wanted = [document, page, law, shape, ticks];
        if (!this.isOn || wanted.every((value, i) => value === this.asked[i])) return;
        this.forget();
        if (gesture) return;
        this.asked = wanted;
        this.timer = setTimeout(() => void this.ask(page, ticks, shape), REST_MS);
    }

    /** The most that a joint is behind what it is sent (servo units); null: not known. */
    lag({ ticks, goals }: Curve, joint: number): number | null {
        const { positions } = this;
        if (!positions) return null;
        let most = 0;
        for (let at = joint; at < Math.min(positions.length, ticks * JOINTS); at += JOINTS)
            most = Math.max(most, Math.abs((goals[at] ?? 0) - (positions[at] ?? 0)));
        return most;
    }

    dispose(): void {
        this.forget();
    }

    private forget(): void {
        clearTimeout(this.timer);
        this.stop.abort();
        this.stop = new AbortController();
        this.asked = [];
        this.positions = null;
        this.isUnknown = false;
    }

    private async ask(page: number, ticks: number, shape: Shape): Promise<void> {
        const { signal } = this.stop;
        const positions = await this.session.trials.follow(page, ticks, shape, signal).catch(() => null);
        if (signal.aborted) return;
        this.positions = positions;
        this.isUnknown = positions === null;
        this.changed();
    }
}
