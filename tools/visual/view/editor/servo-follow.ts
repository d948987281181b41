// SPDX-License-Identifier: MIT
// How the servos follow a curve in physics. Computed in the background, while switched on and after edits have paused.

import { JOINTS } from '../../model/motion.ts';
import type { Curve, Shape } from '../../model/motion.ts';
import type { Session } from '../session/session.ts';

const REST_MS = 250;

export class ServoFollow {
    private readonly session: Session;
    /** Called when the drawing must be updated. */
    private readonly changed: () => void;
    private isOn = false;
    private asked: readonly unknown[] = [];
    private stop = new AbortController();
    private timer: ReturnType<typeof setTimeout> | undefined;
    /** JOINTS servo units per tick; null: unknown now. */
    positions: Float32Array | null = null;
    /** Physics could not compute the positions. */
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

    /** Call with what is drawn now: requests new positions if the motion has changed. */
    look(ticks: number, shape: Shape): void {
        const { document, page, law, gesture } = this.session.editor.state.get();
        const wanted = [document, page, law, shape, ticks];
        if (!this.isOn || wanted.every((value, i) => value === this.asked[i])) return;
        this.forget();
        if (gesture) return;
        this.asked = wanted;
        this.timer = setTimeout(() => void this.ask(page, ticks, shape), REST_MS);
    }

    /** Largest difference between goal and position of a joint (servo units); null: unknown. */
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
