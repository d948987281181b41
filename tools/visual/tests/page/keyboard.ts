// SPDX-License-Identifier: MIT
// A person without a mouse: moves through the page by Tab, sees the focus, and acts by keys.
import { expect } from 'vitest';
import type { Visitor } from './page-bench.ts';

/** More tab stops than any area has. */
const STOPS_MOST = 200;

/** The focused element. */
interface Stop {
    /** Its accessible name; '': no focus in the page. */
    readonly name: string;
    readonly isSeen: boolean;
}

export class Keyboard {
    private readonly person: Visitor;

    constructor(person: Visitor) {
        this.person = person;
    }

    stop(): Promise<Stop> {
        return this.person.page.evaluate(() => {
            const active = document.activeElement;
            if (!active || active === document.body) return { name: '', isSeen: true };
            const label = active.closest('label') ?? (active.id ? document.querySelector(`label[for="${active.id}"]`) : null);
            const name =
                active.getAttribute('aria-label') ??
                (label ? (label.querySelector('span')?.textContent ?? label.textContent) : active.textContent) ??
                '';
            // Its own outline, one of the element around it, or a frame (in a node of the chart).
            const marks = [active, active.closest('terminal-pane'), active.querySelector(':scope > rect')].filter(one => one !== null);
            // The marked element is what a person sees; the terminal's own field has no width before the terminal's first letter.
            const isSeen = marks.some(one => {
                const style = getComputedStyle(one);
                const { x, y, width, height } = one.getBoundingClientRect();
                const hit = document.elementFromPoint(x + width / 2, y + height / 2);
                const isCovered = hit !== null && !one.contains(hit) && !hit.contains(one) && hit !== label && !label?.contains(hit);
                const isMarked =
                    (style.outlineStyle !== 'none' && Number.parseFloat(style.outlineWidth) >= 1) ||
                    (one.tagName === 'rect' && Number.parseFloat(style.strokeWidth) >= 4);
                return isMarked && width > 0 && height > 0 && !isCovered;
            });
            return { name: name.trim(), isSeen };
        });
    }

    async press(...keys: string[]): Promise<void> {
        for (const key of keys) await this.person.page.keyboard.press(key);
    }

    async at(name: string | RegExp): Promise<void> {
        await expect
            .poll(async () => (await this.stop()).name)
            .toMatch(typeof name === 'string' ? new RegExp(`^${name.replaceAll(/[.*+?^${}()|[\]\\]/g, '\\$&')}$`) : name);
    }

    /** Goes to an element by Tab, or back by Shift+Tab. Every element on the way must show its focus. */
    async to(name: string | RegExp, key: 'Tab' | 'Shift+Tab' = 'Tab'): Promise<void> {
        const passed: string[] = [];
        for (let i = 0; i < STOPS_MOST; i++) {
            await this.press(key);
            const stop = await this.stop();
            expect(stop, `"${stop.name}" does not show that it has the keyboard`).toHaveProperty('isSeen', true);
            if (typeof name === 'string' ? stop.name === name : name.test(stop.name)) return;
            passed.push(stop.name);
        }
        throw new Error(`${key} never comes to ${name}; it comes to: ${[...new Set(passed)].join(' | ')}`);
    }

    /** Goes to an element and presses Enter. */
    async enter(name: string | RegExp, key: 'Tab' | 'Shift+Tab' = 'Tab'): Promise<void> {
        await this.to(name, key);
        await this.press('Enter');
    }

    /** Opens an area: past the elements before the tabs, then by the arrows. */
    async open(area: string): Promise<void> {
        if (!(await this.person.page.getByRole('tab', { selected: true }).evaluate(tab => tab === document.activeElement))) {
            await this.enter('To the areas');
        }
        const isSeen = await this.person.page.getByRole('tab', { name: area, exact: true }).isVisible();
        if (!isSeen) await this.enter('More');
        while ((await this.stop()).name !== area) await this.press('ArrowRight');
    }

    /** In a list: presses the arrow until the choice is selected, then Enter. */
    async choose(list: string, choice: string | RegExp): Promise<void> {
        await this.to(list);
        const chosen = (): Promise<string> =>
            this.person.page.evaluate(() => (document.activeElement as HTMLSelectElement).selectedOptions[0]?.textContent ?? '');
        for (let i = 0; i < STOPS_MOST && !(await chosen()).match(choice); i++) await this.press('ArrowDown');
        expect(await chosen()).toMatch(choice);
        await this.press('Enter');
    }
}
