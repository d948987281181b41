// SPDX-License-Identifier: MIT
// Locks for a browser that has none, as over plain http from another machine: a tab asks all others, and takes what none of them has. A tab
// that is too busy to answer counts as closed.

import type { Release } from './hold-document.ts';

const ANSWER_MS = 500;

interface Message {
    readonly name: string;
    /** Of the tab that asks for the lock; null: the sender has it. */
    readonly asks: number | null;
}

export class TabLocks {
    private readonly channel = new BroadcastChannel('motion512-locks');
    /** Of two tabs that ask at the same time the one with the lower number gets it. */
    private readonly number = Math.random();
    /** What this tab has or asks for. */
    private readonly mine = new Set<string>();
    /** What this tab asks for. The function gives it up. */
    private readonly asked = new Map<string, () => void>();

    constructor() {
        this.channel.onmessage = ({ data }: MessageEvent) => this.hear(data as Message);
    }

    /** Locks this name until the returned function is called or the tab closes. null: it is locked already. */
    async request(name: string): Promise<Release | null> {
        if (this.mine.has(name)) return null;
        this.mine.add(name);
        const isMine = await new Promise<boolean>(resolve => {
            this.asked.set(name, () => resolve(false));
            this.tell({ name, asks: this.number });
            setTimeout(() => resolve(true), ANSWER_MS);
        });
        this.asked.delete(name);
        const release = (): void => void this.mine.delete(name);
        if (isMine) return release;
        release();
        return null;
    }

    private hear({ name, asks }: Message): void {
        const giveUp = this.asked.get(name);
        if (asks === null) giveUp?.();
        else if (giveUp && asks < this.number) giveUp();
        else if (this.mine.has(name)) this.tell({ name, asks: null });
    }

    private tell(message: Message): void {
        this.channel.postMessage(message);
    }
}
