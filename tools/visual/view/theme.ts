// SPDX-License-Identifier: MIT
// Light or dark: as chosen by the button, also at the next visit; without a choice as the system has it.

import { recall, store } from './remembered.ts';

const DARK_GROUND = '#14181c'; // theme.css

export function showTheme(): void {
    const theme = recall('theme');
    if (theme === 'light' || theme === 'dark') document.documentElement.dataset.theme = theme;
}

export function changeTheme(): void {
    const root = document.documentElement;
    const isDark = getComputedStyle(root).getPropertyValue('--ground').trim() === DARK_GROUND;
    root.dataset.theme = isDark ? 'light' : 'dark';
    store('theme', root.dataset.theme);
}
