// SPDX-License-Identifier: MIT
// Edit's screen after the terminal was opened or resized. Edit ignores a size while a line or a question is open.
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { Status } from '../app/status.ts';
import type { Connection } from '../robot/connection.ts';
import type { SessionState } from '../view/session/session.ts';
import { Store } from '../view/store.ts';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

const bytesOf = (text: string): Uint8Array => new TextEncoder().encode(text);
/** More than the page waits after a key and between two of its questions. */
const MEANWHILE_MS = 2000;

/** A robot with Edit that stands still. reports: how often the page has reported the size of its terminal. */
function editAtTerminal() {
    const robot = { reports: 0 };
    const connection = {
        requests: { ask: async () => 'state=idle page=0 step=0 repetition=0 code=0 volts=96 faulty=00000000' },
        write: async (bytes: Uint8Array) => {
            if (new TextDecoder().decode(bytes).endsWith('\x1b[32;80R')) robot.reports++;
        },
    } as unknown as Connection;
    const version = { image: 'edit' } as SessionState['version'];
    const state = new Store({
        source: 'yours',
        connection: 'ready',
        speed: 1,
        tab: 'terminal',
        version,
        pages: [],
    } as unknown as SessionState);
    return { robot, status: new Status({ state, connection: () => connection, isWriting: () => false }) };
}

test('a size that Edit ignored is reported again when the person has typed, until Edit draws', async () => {
    const { robot, status } = editAtTerminal();
    status.terminalSize({ rows: 32, columns: 80 });
    void status.ask();
    await vi.advanceTimersByTimeAsync(MEANWHILE_MS);
    expect(robot.reports).toBe(1); // Edit asks "Are you sure?", and draws nothing
    status.hear(bytesOf('no\x1b[K'));
    await vi.advanceTimersByTimeAsync(MEANWHILE_MS);
    expect(robot.reports).toBe(1);
    status.typed();
    await vi.advanceTimersByTimeAsync(MEANWHILE_MS);
    expect(robot.reports).toBe(2);
    status.hear(bytesOf('\x1b[H\x1b['));
    status.hear(bytesOf('2J'));
    status.typed();
    await vi.advanceTimersByTimeAsync(MEANWHILE_MS);
    expect(robot.reports).toBe(2);
});

test('it is not reported while the person types', async () => {
    const { robot, status } = editAtTerminal();
    void status.ask();
    status.terminalSize({ rows: 32, columns: 80 });
    for (let i = 0; i < 10; i++) {
        status.typed();
        await vi.advanceTimersByTimeAsync(MEANWHILE_MS / 4);
    }
    expect(robot.reports).toBe(0);
    await vi.advanceTimersByTimeAsync(MEANWHILE_MS);
    expect(robot.reports).toBe(1);
});
