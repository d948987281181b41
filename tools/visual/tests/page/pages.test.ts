// SPDX-License-Identifier: MIT
// The hobbyist's row of the specification on the robot in the page: editing pages by mouse and keyboard, preview of changes, backup, write
// over a cable that is pulled, compare; links and checks; closed tabs.
import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { inPage } from './page-bench.ts';
import type { Visitor } from './page-bench.ts';
import { pageSuite } from './page-suite.ts';

const suite = pageSuite();

const card = (page: Page, name: RegExp) => page.getByRole('option', { name });
const button = (page: Page, name: string | RegExp) => page.getByRole('button', { name });

/** Pulls the cable when the second page is being saved. */
function pullAtSecondSave(person: Visitor): Promise<void> {
    return person.inPage(({ sources }) => {
        const { port } = sources.simulated.connection;
        const deliver = port.deliver;
        let saves = 0;
        port.deliver = bytes => {
            deliver(bytes);
            if (new TextDecoder().decode(bytes).includes('@save') && ++saves === 2) port.unplug();
        };
    });
}

const answer = async (page: Page, dialog: string, name: string): Promise<void> => {
    await page.getByRole('dialog', { name: dialog }).getByRole('textbox', { name: 'Name' }).fill(name);
    await page.keyboard.press('Enter');
};

/** The robot does not answer, because its time stands still: the name is asked for at once, and the page waits in a dialog. */
async function documentOfTheRobot(page: Page): Promise<void> {
    const title = 'What the robot has, as a document';
    const setSpeed = (speed: number): Promise<void> => inPage(page, ({ sim }, to) => sim.setSpeed(to), speed);
    const documents = page.getByRole('combobox', { name: 'Document' });
    await setSpeed(0);
    await documents.selectOption('robot');
    await answer(page, title, 'theirs');
    await page
        .getByRole('dialog', { name: title })
        .getByText(/time stands still$/)
        .waitFor();
    await page.keyboard.press('Enter'); // held a little too long: it does not cancel
    expect(await page.getByRole('dialog', { name: title }).isVisible()).toBe(true);
    await button(page, 'Cancel').click();
    await page.getByRole('dialog').waitFor({ state: 'hidden' });
    await documents.selectOption('robot');
    await answer(page, title, 'theirs');
    await setSpeed(1);
    await documents.locator('option:checked', { hasText: /^theirs$/ }).waitFor({ state: 'attached' });
    await card(page, /^motion 2 curtsy/).waitFor(); // as it was written
}

/** Another document comes, from a slow disk, while a new name is typed. */
async function renamedTooLate(page: Page): Promise<void> {
    const documents = page.getByRole('combobox', { name: 'Document' });
    await documents.selectOption('rename');
    await inPage(page, async ({ documents: all }) => void (await all.create('other')));
    await answer(page, 'Rename this document', 'better');
    const message = page.getByRole('log', { name: 'Last message' });
    await message.filter({ hasText: 'theirs was not renamed: another document is open now.' }).waitFor();
    expect(await documents.locator('option:checked').textContent()).toBe('other');
}

test('a hobbyist: renames and copies pages, sees what will change, writes with a backup over a cable that is pulled, takes a page back; a closed tab loses nothing', async () => {
    const person = await suite.come({ hasPython: true });
    const { page } = person;
    await person.untilStanding();
    await person.open('Robot');
    await person.button('Run Edit').click();
    await person.untilDoing(/^Edit runs:/);
    await person.open('Motions');
    await card(page, /^motion 2 bow/).click();
    await button(page, 'Rename …').click();
    await page.getByRole('textbox', { name: 'Name' }).fill('curtsy');
    await page.keyboard.press('Enter');
    await card(page, /^motion 2 curtsy/).waitFor();
    await button(page, /^Undo: name \(motion 2\)/).click();
    await card(page, /^motion 2 bow/).waitFor();
    await button(page, /^Redo: name \(motion 2\)/).click();
    await card(page, /^motion 3 wave/).dragTo(card(page, /^motion 2 curtsy/));
    await button(page, 'Cancel').click(); // the wrong place
    await page.setViewportSize({ width: 1440, height: 900 }); // both ends of the drag are visible
    await page.getByRole('searchbox', { name: 'Search motions' }).fill('7'); // page 7 among many empty ones
    await person.untilSeen();
    await card(page, /^motion 7 stand/).dragTo(card(page, /^motion 57, empty/));
    await page.getByRole('dialog').getByRole('button', { name: 'Copy' }).click();
    await card(page, /^motion 57 stand/).waitFor();
    await page.getByRole('searchbox', { name: 'Search motions' }).fill('walk');
    const inRow = page.getByRole('option', { name: /^motion \d+ walk/ });
    expect(await inRow.count()).toBeGreaterThan(2);
    await inRow.first().click();
    for (const key of ['ArrowDown', 'ArrowUp']) {
        await page.keyboard.press(key); // there is no other row
        expect(await inRow.first().getAttribute('aria-selected')).toBe('true');
    }
    await page.getByRole('searchbox', { name: 'Search motions' }).fill('');

    await button(page, 'To the robot (2) …').click();
    const rows = page.getByRole('list', { name: 'Motions that differ' });
    await rows.getByText('name "bow" -> "curtsy"').waitFor(); // m512's words, so Python is loaded
    await rows.getByText('motion 57 (stand)').waitFor();
    expect(await rows.getByRole('button', { name: "Take the robot's motion 2 (curtsy)" }).count()).toBe(1); // the label names the page
    await pullAtSecondSave(person);
    const transfer = page.getByRole('status', { name: 'Transfer' });
    // Read in the page, at the moment of the message, because it soon reconnects by itself and reads the robot anew.
    const atTheMessage = transfer.evaluate(
        status =>
            new Promise<string[]>(resolve => {
                const dialog = status.closest('dialog') ?? status;
                const observer = new MutationObserver(() => {
                    if (!status.textContent.includes('cable')) return;
                    observer.disconnect();
                    resolve([...dialog.querySelectorAll('li .account')].map(one => one.textContent));
                });
                observer.observe(dialog, { subtree: true, childList: true, characterData: true });
            }),
    );
    await button(page, 'Write 2 motions into the robot').click();
    const [first, second] = await atTheMessage;
    expect(first).toBe('✓ written');
    expect(['being saved …', '✓ written']).toContain(second);
    await expect
        .poll(
            async () => {
                // It reconnects by itself. Until then it reports the pulled cable again. The button may disappear between check and click;
                // then it was not needed.
                const again = person.button('Try again');
                if (await again.isVisible()) await again.click({ timeout: 2000 }).catch(() => undefined);
                return transfer.textContent();
            },
            { timeout: 240_000, interval: 2000 },
        )
        .toContain('Written and verified: 2 motions.');
    await rows.getByText('Nothing differs.').waitFor();
    const compared = page.getByRole('combobox', { name: 'Compare with' });
    await compared.selectOption({ index: 1 }); // the backup made before
    await button(page, 'Copy here motion 2 (bow)').click();
    await button(page, 'Close').click();
    await card(page, /^motion 2 bow/).waitFor();

    const context = page.context();
    let tab = page;
    for (const name of ['one', 'two']) {
        await card(tab, /^motion 2 /).press('F2');
        await tab.getByRole('textbox', { name: 'Name' }).fill(name);
        await tab.keyboard.press('Enter');
        await card(tab, new RegExp(`^motion 2 ${name}`)).waitFor(); // the edit is finished; the tab closes now
        await tab.close();
        tab = await context.newPage();
        await tab.goto(suite.address);
        await tab.getByRole('tab', { name: 'Motions' }).click();
        await card(tab, new RegExp(`^motion 2 ${name}`)).waitFor();
    }
    await button(tab, /^To the robot \(1\)/).waitFor(); // the robot kept what was written
    for (const name of ['one', 'bow']) {
        // Undo goes back through both closed tabs.
        await button(tab, /^Undo: name \(motion 2\)/).click();
        await card(tab, new RegExp(`^motion 2 ${name}`)).waitFor();
    }
    await documentOfTheRobot(tab);
    await renamedTooLate(tab);
    await person.leave();
}, 600_000);
