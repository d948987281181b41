// SPDX-License-Identifier: MIT
// Light or dark, as chosen before: another language or a new version of the page loads it anew.
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { changeTheme, showTheme } from '../view/theme.ts';

const kept = new Map<string, string>();
let root: { dataset: { theme?: string } } = { dataset: {} };

/** A page that was just loaded. */
function load(): void {
    root = { dataset: {} };
    vi.stubGlobal('document', { documentElement: root });
    showTheme();
}

beforeEach(() => {
    kept.clear();
    const localStorage = { getItem: (key: string) => kept.get(key) ?? null, setItem: (key: string, value: string) => kept.set(key, value) };
    vi.stubGlobal('localStorage', localStorage);
    vi.stubGlobal('matchMedia', () => ({ matches: true })); // a system that is dark
});
afterEach(() => {
    vi.unstubAllGlobals();
});

test('without a choice it is as the system has it; a choice stays', () => {
    load();
    expect(root.dataset.theme).toBeUndefined();
    changeTheme();
    expect(root.dataset.theme).toBe('light');
    load();
    expect(root.dataset.theme).toBe('light');
    changeTheme();
    load();
    expect(root.dataset.theme).toBe('dark');
});

test('a browser that stores nothing, or something else, leaves it to the system', () => {
    kept.set('motion512.theme', 'pink');
    load();
    expect(root.dataset.theme).toBeUndefined();
    vi.stubGlobal('localStorage', undefined);
    load();
    changeTheme();
    expect(root.dataset.theme).toBe('light');
});
