// SPDX-License-Identifier: MIT
// A robot that is switched off. The questions that the page asks periodically must not queue up before the one that finds out.
import { afterEach, expect, test, vi } from 'vitest';
import { Status } from '../app/status.ts';
import { wallClock } from '../robot/clock.ts';
import type { Connection } from '../robot/connection.ts';
import { Requests } from '../robot/requests.ts';
import type { SessionState } from '../view/session/session.ts';
import { Store } from '../view/store.ts';

afterEach(() => void vi.useRealTimers());

test('a robot that does not answer any more is asked who it is when the first question has ended', async () => {
    vi.useFakeTimers();
    const sent: string[] = [];
    const requests = new Requests({ write: async bytes => void sent.push(new TextDecoder().decode(bytes).slice(1, 5)) }, wallClock);
    const state = new Store({ source: 'yours', connection: 'ready', speed: 1 } as SessionState);
    const askAgain = (): void => {
        if (state.get().connection === 'ready') void requests.ask('@ver').catch(() => undefined);
        state.set({ connection: 'asking' });
    };
    const connection = { requests, askAgain } as unknown as Connection;
    const status = new Status({ state, connection: () => connection, isWriting: () => false });
    void status.ask();
    await vi.advanceTimersByTimeAsync(4000); // a question waits for 3 s, the line rests for half a second
    expect(sent).toEqual(['@whe', '@ver']);
});
