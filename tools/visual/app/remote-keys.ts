// SPDX-License-Identifier: MIT
// Sends the keys of the remote while they are held: to the robot in the page over its own link, to yours over the serial line.

import type { RemoteButton } from '../robot/remote.ts';

export const REPEAT_MS = 100;

export class RemoteKeys {
    private readonly send: (held: ReadonlySet<RemoteButton>) => void;
    private held: ReadonlySet<RemoteButton> = new Set();

    constructor(send: (held: ReadonlySet<RemoteButton>) => void) {
        this.send = send;
        setInterval(() => this.held.size > 0 && this.send(this.held), REPEAT_MS);
    }

    get isHeld(): boolean {
        return this.held.size > 0;
    }

    hold(held: ReadonlySet<RemoteButton>): void {
        this.held = held;
        this.send(held);
    }
}
