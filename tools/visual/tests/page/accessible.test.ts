// SPDX-License-Identifier: MIT
// axe-core finds no serious fault in any area or dialog; contrast also holds in the dark theme. Screenshots of both are kept.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { expect, test } from 'vitest';
import { Visitor } from './page-bench.ts';
import { SHOTS, pageSuite } from './page-suite.ts';

const WIDE = { width: 1440, height: 800 };
const AREAS = ['Remote', 'Steps', 'Curves', 'Motions', 'Links', 'Checks', 'Terminal', 'Robot'] as const;
const LIBRARY = new URL('../../../../build/motions/motions.bin', import.meta.url).pathname;
const suite = pageSuite();

/** Serious and critical findings in a part of the page: "rule: element". */
function findings(visitor: Visitor, part: string, rules: 'all' | 'contrast'): Promise<string[]> {
    return visitor.page.evaluate(
        async ([within, which]) => {
            type Found = { id: string; impact: string; nodes: { target: string[]; failureSummary: string }[] };
            const { axe } = globalThis as unknown as { axe: { run(within: string, options: object): Promise<{ violations: Found[] }> } };
            const options = { resultTypes: ['violations'], ...(which === 'contrast' ? { runOnly: ['color-contrast'] } : {}) };
            const { violations } = await axe.run(within, options);
            return violations
                .filter(({ impact }) => impact === 'serious' || impact === 'critical')
                .flatMap(({ id, nodes }) => nodes.map(({ target, failureSummary }) => `${id}: ${target.join(' ')} ${failureSummary}`));
        },
        [part, rules] as const,
    );
}

test('no serious finding in any area and any dialog; in the dark the contrast holds too', async () => {
    const source = await readFile(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
    const person = await Visitor.come(suite.browser, suite.address, { screen: WIDE, hasPhysics: false });
    const { page } = person;
    const found: string[] = [];
    const paint = (theme: 'light' | 'dark'): Promise<void> =>
        page.evaluate(name => {
            document.documentElement.dataset.theme = name;
        }, theme);
    /** Checks what is open, light and dark. A dialog covers the button for the theme. */
    const look = async (name: string, part: 'body' | 'main' | 'dialog[open]'): Promise<void> => {
        found.push(...(await findings(person, part, 'all')).map(what => `${name}: ${what}`));
        await paint('dark');
        await person.untilSeen();
        found.push(...(await findings(person, part, 'contrast')).map(what => `${name}, dark: ${what}`));
        await page.screenshot({ path: `${SHOTS}dark-${name.toLowerCase().replaceAll(' ', '-')}.png` });
        await paint('light');
        await person.untilSeen();
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
    await person.button('Pause').click(); // a still picture, and the robot leaves the processor to axe
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
    await paint('light');

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
