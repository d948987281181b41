// SPDX-License-Identifier: MIT
// axe-core finds no serious fault in any area or dialog; the contrast holds in the light and in the dark.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { expect, test } from 'vitest';
import type { Visitor } from './page-bench.ts';
import { pageSuite } from './page-suite.ts';

const WIDE = { width: 1440, height: 800 };
const AREAS = ['Remote', 'Steps', 'Curves', 'Motions', 'Links', 'Checks', 'Terminal', 'Robot'] as const;
const LIBRARY = new URL('../../../../build/motions/motions.bin', import.meta.url).pathname;
const suite = pageSuite();

/** Serious and critical findings in a part of the page: "rule: element". */
function findings(visitor: Visitor, part: string): Promise<string[]> {
    return visitor.page.evaluate(async within => {
        type Found = { id: string; impact: string; nodes: { target: string[]; failureSummary: string }[] };
        const { axe } = globalThis as unknown as { axe: { run(within: string, options: object): Promise<{ violations: Found[] }> } };
        const { violations } = await axe.run(within, {
            resultTypes: ['violations'],
            preload: false,
            rules: { 'color-contrast': { enabled: false } },
        });
        return violations
            .filter(({ impact }) => impact === 'serious' || impact === 'critical')
            .flatMap(({ id, nodes }) => nodes.map(({ target, failureSummary }) => `${id}: ${target.join(' ')} ${failureSummary}`));
    }, part);
}

/** In the browser: texts of a part of the page that stand out too little from what is behind them (WCAG, AA). axe's own rule takes as long
 *  as all its others. It also sees what lies across a text, which screens.test.ts checks. The page is dark only here, so that
 *  no picture is drawn in the dark. */
function faint(part: string): string[] {
    type Colour = readonly [number, number, number, number];
    const canvas = new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true });
    const known = new Map<string, Colour>();
    const read = (css: string): Colour => {
        canvas?.clearRect(0, 0, 1, 1);
        Object.assign(canvas ?? {}, { fillStyle: css });
        canvas?.fillRect(0, 0, 1, 1);
        const [r = 0, g = 0, b = 0, a = 0] = canvas?.getImageData(0, 0, 1, 1).data ?? [];
        known.set(css, [r, g, b, a / 255]);
        return [r, g, b, a / 255];
    };
    const colour = (css: string): Colour => known.get(css) ?? read(css);
    const over = ([r, g, b, a]: Colour, [x, y, z]: Colour): Colour => [r * a + x * (1 - a), g * a + y * (1 - a), b * a + z * (1 - a), 1];
    const behind = (element: Element | null): Colour | null => {
        if (!element) return [255, 255, 255, 1];
        const { backgroundColor, backgroundImage } = getComputedStyle(element);
        const own = colour(backgroundColor);
        const below = own[3] === 1 ? own : behind(element.parentElement);
        return backgroundImage === 'none' ? below && over(own, below) : null;
    };
    const light = ([r, g, b]: Colour): number =>
        [r, g, b].reduce((sum, of, i) => {
            const share = of / 255;
            return sum + ([0.2126, 0.7152, 0.0722][i] ?? 0) * (share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4);
        }, 0.05);
    const found: string[] = [];
    const look = (theme: string): void => {
        const walker = document.createTreeWalker(document.querySelector(part) ?? document, NodeFilter.SHOW_TEXT);
        for (let node = walker.nextNode(); node; node = walker.nextNode()) {
            const parent = node.parentElement;
            if (!node.textContent?.trim() || !parent?.checkVisibility({ visibilityProperty: true, opacityProperty: true })) continue;
            const back = behind(parent);
            if (!back || parent.closest(':disabled, svg, script, style, .visually-hidden, .skip')) continue;
            const { color, fontSize, fontWeight } = getComputedStyle(parent);
            const [a, b] = [light(over(colour(color), back)), light(back)];
            const ratio = Math.max(a, b) / Math.min(a, b);
            const isLarge = parseFloat(fontSize) >= (Number(fontWeight) >= 700 ? 18.66 : 24);
            if (ratio < (isLarge ? 3 : 4.5)) found.push(`${theme}: ${ratio.toFixed(1)}: ${node.textContent.trim()}`);
        }
    };
    for (const theme of ['dark', 'light']) {
        document.documentElement.dataset.theme = theme;
        look(theme);
    }
    return found;
}

test('no serious finding in any area and any dialog; the contrast holds, light and dark', async () => {
    const source = await readFile(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
    const person = await suite.come({ hasPicture: true, hasPython: true, screen: WIDE });
    const { page } = person;
    const found: string[] = [];
    const look = async (name: string, part: 'body' | 'main' | 'dialog[open]'): Promise<void> => {
        found.push(...[...(await findings(person, part)), ...(await page.evaluate(faint, part))].map(what => `${name}: ${what}`));
    };
    const dialog = async (name: string, open: () => Promise<unknown>): Promise<void> => {
        await open();
        await page.locator('dialog[open]:not([aria-busy=true])').waitFor();
        await look(name, 'dialog[open]');
        await page.keyboard.press('Escape');
        await page.locator('dialog[open]').waitFor({ state: 'hidden' });
    };
    await person.untilStanding();
    await person.open('Robot');
    await person.button('Pause').click(); // the robot leaves the processor to axe
    await page.evaluate(source);
    await person.open('Motions');
    await page.getByRole('option', { name: /^motion 2 bow/ }).click();
    await page.keyboard.press('F2');
    await page.keyboard.type('curtsy');
    await page.keyboard.press('Enter');
    await page.getByRole('combobox', { name: 'Which motions' }).selectOption('changed'); // the other cards are built in the same way
    for (const area of AREAS) {
        await person.open(area);
        await look(area, area === 'Remote' ? 'body' : 'main'); // the head is the same everywhere
    }
    await person.press('Light or dark'); // also by its button
    expect(await page.evaluate(() => document.documentElement.dataset.theme)).toBe('dark');

    await person.open('Steps');
    await page.getByRole('combobox', { name: 'Motion', exact: true }).selectOption('3'); // otherwise a new page with nothing to send
    await page.getByText('View', { exact: true }).click();
    await person.button('Tour').click();
    await look('Tour and view', 'body');
    await person.button('End the tour').click();
    await dialog('Keys', async () => {
        await person.openMenu();
        await person.button('Keys').click();
    });
    await dialog('Link', () => person.button('Send as link').click());
    await dialog('File opened', () => page.getByLabel('Motion file').setInputFiles(LIBRARY));
    await dialog('File refused', () =>
        page.getByLabel('Motion file').setInputFiles({ name: 'torn.mtn', mimeType: 'text/plain', buffer: Buffer.from('type=0\n') }),
    );
    await dialog('Losses', () => page.getByLabel('Save as a file').selectOption('.mtn'));
    const documents = page.getByRole('combobox', { name: 'Document', exact: true });
    await dialog('Document deleted', () => documents.selectOption({ label: 'Delete …' }));
    await dialog('Document named', () => documents.selectOption({ label: 'Rename …' }));
    await person.open('Motions');
    await page.getByRole('combobox', { name: 'Which motions' }).selectOption('all');
    await dialog('Page cleared', () => person.button('Clear …').click());
    await dialog('Page moved', async () => {
        await person.button('Copy or move …').click();
        await page.getByRole('textbox', { name: 'To number' }).fill('2');
        await page.keyboard.press('Enter');
        await page.getByRole('dialog', { name: 'Copy or move', exact: true }).waitFor();
    });
    await person.open('Robot');
    await person.button('real time').click(); // the robot must run to answer requests
    await person.open('Motions');
    await dialog('Compare', async () => {
        await person.button('To the robot (1) …').click();
        await page.getByText('name "bow" -> "curtsy"').waitFor();
    });
    expect(found).toEqual([]);
    await person.leave();
}, 900_000);
