// SPDX-License-Identifier: MIT
// Light or dark: as chosen by the button, also at the next visit; without a choice as the system has it.

import { recall, store } from './remembered.ts';

export function showTheme(): void {
    const theme = recall('theme');
    if (theme === 'light' || theme === 'dark') document.documentElement.dataset.theme = theme;
}

export function changeTheme(): void {
    const root = document.documentElement;
    const theme = root.dataset.theme ?? (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light');
    root.dataset.theme = theme === 'dark' ? 'light' : 'dark';
    store('theme', root.dataset.theme);
}
