// SPDX-License-Identifier: MIT
// A hobbyist changes a motion: drags ends and way-points, takes steps to another page as text, asks physics where it falls, compares with
// another document and a file, aims a joint.
import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { pageSuite } from './page-suite.ts';
import { chooseJoints, wayPoint } from './way-point.ts';

/** As in status.ts. */
const WHERE_MS = 300;
const PATIENT = { timeout: 240_000 };
const LIBRARY = new URL('../../../../build/motions/motions.bin', import.meta.url).pathname;
const suite = pageSuite();

const button = (page: Page, name: string | RegExp) => page.getByRole('button', { name });
const timeOf = (page: Page, step: number) => page.getByRole('spinbutton', { name: `Time of step ${step}` });
const position = (page: Page, joint: RegExp) => page.getByRole('group', { name: 'Chosen joints' }).getByRole('spinbutton', { name: joint });
const verdicts = (page: Page) => page.getByRole('list', { name: 'Findings' }).getByRole('listitem');

async function drag(page: Page, from: { x: number; y: number }, dx: number, dy: number): Promise<void> {
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move(from.x + dx / 2, from.y + dy / 2);
    await page.mouse.move(from.x + dx, from.y + dy);
    await page.mouse.up();
}

test('a hobbyist: stretches a step, takes steps to another page as text, drags a way-point, hears from physics where it falls, compares, aims a joint', async () => {
    const person = await suite.come({ hasPhysics: 'later', hasPython: true, screen: { width: 1280, height: 800 } });
    const { page } = person;
    await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
    await person.untilStanding();
    await person.open('Motions');
    await page.getByRole('option', { name: /^motion 2 bow/ }).dblclick();

    const before = Number(await timeOf(page, 2).inputValue());
    const handle = await page.locator('time-line .handle.time').nth(1).boundingBox();
    await drag(page, { x: (handle?.x ?? 0) + 2, y: (handle?.y ?? 0) + 8 }, 40, 0);
    await expect.poll(async () => Number(await timeOf(page, 2).inputValue()), PATIENT).toBeGreaterThan(before + 0.1);
    await button(page, 'Undo: time (motion 2)').click();
    await expect.poll(async () => Number(await timeOf(page, 2).inputValue()), PATIENT).toBe(before);

    await button(page, 'Step 1').click();
    await button(page, 'Step 2').click({ modifiers: ['Shift'] });
    await page.keyboard.press('Control+c');
    const text = await page.evaluate(() => navigator.clipboard.readText());
    expect(text).toMatch(/^step \d+ .*\| 1:\d+ .* 18:\d+\nstep \d+ .*\| 1:\d+ .*\n$/);
    await button(page, 'New motion').click();
    await page.getByRole('textbox', { name: 'Name of the motion' }).fill('reel');
    await page.keyboard.press('Enter');
    await button(page, 'Paste').click();
    await expect.poll(() => button(page, /^Step \d$/).count(), PATIENT).toBe(2);

    await button(page, 'Step 2').click();
    await person.open('Curves');
    const legend = page.getByRole('list', { name: 'Lines' });
    await legend
        .getByText(/^\d+ (right|left) (hip|knee|ankle|shoulder|elbow)/)
        .first()
        .waitFor(); // a limb is preselected by name
    await chooseJoints(page, [15]);
    expect(await legend.innerText()).toBe('15 right ankle pitch');
    const ankle = Number(await position(page, /^15 /).inputValue());
    await drag(page, await wayPoint(page, 15, 1), 0, -60);
    await expect.poll(async () => Number(await position(page, /^15 /).inputValue()), PATIENT).toBeGreaterThan(ankle + 5);
    await button(page, /^Undo: drag/).click(); // one drag is one undo step
    await expect.poll(async () => Number(await position(page, /^15 /).inputValue()), PATIENT).toBe(ankle);
    await chooseJoints(page, [15, 16]);
    for (const [joint, to] of [
        [/^15 /, '690'],
        [/^16 /, '334'],
    ] as const) {
        await position(page, joint).fill('');
        await position(page, joint).pressSequentially(to, { delay: WHERE_MS }); // as slowly as the page polls the robot
        await position(page, joint).press('Enter');
        await expect.poll(() => position(page, joint).inputValue(), PATIENT).toBe(to);
    }
    await page.getByLabel('Servos in physics').check();
    await page
        .getByRole('status', { name: 'Other lines' })
        .filter({ hasText: /behind by up to \d+° \(joint 15\)/ })
        .waitFor(PATIENT);

    await person.open('Checks');
    await button(page, /^Try motion \d+ \(reel\)/).click();
    const falls = verdicts(page).filter({ hasText: /Falls in step 2 after \d\.\d s, and stays on the floor/ });
    await falls.waitFor(PATIENT);
    await falls.getByRole('button', { name: /^Show motion \d+ \(reel\), step 2/ }).click();
    expect(await button(page, 'Step 2').getAttribute('aria-current')).toBe('true');
    await button(page, 'Delete').click();
    await person.open('Checks');
    await verdicts(page)
        .filter({ hasText: /Before the last change: Falls/ })
        .waitFor(PATIENT);
    await button(page, /^Try motion \d+ \(reel\)/).click();
    await page
        .getByRole('status', { name: 'What physics says' })
        .filter({ hasText: /^1 motion stands/ })
        .waitFor(PATIENT);

    await person.open('Motions');
    await page.getByRole('combobox', { name: 'Document', exact: true }).selectOption({ label: 'Copy of this one …' });
    await page.getByRole('textbox', { name: 'Name' }).fill('second');
    await page.keyboard.press('Enter');
    const open = page.getByRole('combobox', { name: 'Document', exact: true }).locator('option:checked');
    await expect.poll(() => open.innerText(), PATIENT).toBe('second');
    for (const number of [2, 3]) {
        await page.getByRole('option', { name: new RegExp(`^motion ${number} `) }).press('Delete');
        await page.getByRole('dialog').getByRole('button', { name: 'Clear' }).press('Enter');
        await page.getByRole('option', { name: new RegExp(`^motion ${number}, empty`) }).waitFor();
    }
    await button(page, /^To the robot/).click();
    const rows = page.getByRole('list', { name: 'Motions that differ' }).locator('> li');
    const compared = page.getByRole('combobox', { name: 'Compare with' });
    await compared.selectOption({ label: await compared.locator('option', { hasText: 'My motions' }).innerText() });
    await button(page, 'Copy here motion 3 (wave)').click();
    await expect.poll(() => rows.count(), PATIENT).toBe(1);
    await page.getByLabel('File to compare with').setInputFiles(LIBRARY);
    await expect.poll(() => compared.inputValue(), PATIENT).toBe('file');
    await expect.poll(() => rows.count(), PATIENT).toBe(2); // the bow, and the page that is new here
    await button(page, 'Copy here motion 2 (bow)').click();
    await expect.poll(() => rows.count(), PATIENT).toBe(1);
    await button(page, 'Close').click();
    for (const name of ['bow', 'wave']) await page.getByRole('option', { name: new RegExp(`^motion \\d+ ${name},`) }).waitFor();

    await person.open('Curves');
    const beside = page.getByRole('status', { name: 'Layers now' });
    await chooseJoints(page, [1]);
    await person.open('Remote');
    await page.getByText('Layers over the motion').click();
    await button(page, 'Aim').click();
    await beside.filter({ hasText: 'Moved by code: joint 1.' }).waitFor(PATIENT);
    await button(page, 'Free').click();
    await beside.filter({ hasText: 'No layers.' }).waitFor(PATIENT);
    await person.leave();
}, 900_000);
