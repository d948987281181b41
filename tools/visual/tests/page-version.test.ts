// SPDX-License-Identifier: MIT
// A new version of the page, in two tabs.
import { afterEach, expect, test, vi } from 'vitest';
import { PageVersion } from '../app/page-version.ts';
import type { SessionState } from '../view/session/session.ts';
import { Store } from '../view/store.ts';

afterEach(() => {
    vi.unstubAllGlobals();
});

test('the first tab asks the new version to take over; the second one, where nothing waits any more, is loaded anew as well', async () => {
    const posted: unknown[] = [];
    const changed: (() => void)[] = [];
    const waiting = { state: 'installed', postMessage: (what: unknown) => posted.push(what), addEventListener: () => undefined };
    const registration = { waiting: waiting as object | null, installing: null, addEventListener: () => undefined };
    const reload = vi.fn();
    vi.stubGlobal('navigator', {
        serviceWorker: {
            controller: {},
            register: () => Promise.resolve(registration),
            addEventListener: (_: string, call: () => void) => changed.push(call),
        },
    });
    vi.stubGlobal('document', { addEventListener: () => undefined });
    vi.stubGlobal('window', { location: { reload } });
    const state = new Store({ hasNewVersion: false } as SessionState);
    const version = new PageVersion(state);
    await version.keep();
    expect(state.get().hasNewVersion).toBe(true);
    version.take();
    expect(posted).toEqual(['take-over']);
    expect(reload).not.toHaveBeenCalled();
    for (const call of changed) call();
    expect(reload).toHaveBeenCalledTimes(1);
    registration.waiting = null; // another tab has taken it
    version.take();
    expect(reload).toHaveBeenCalledTimes(2);
});
