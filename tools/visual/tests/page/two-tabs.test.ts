// SPDX-License-Identifier: MIT
// Two tabs have one robot each but share one memory in the browser: the second never overwrites what the first has saved.
import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { PHYSICS, type Visitor } from './page-bench.ts';
import { pageSuite } from './page-suite.ts';

const suite = pageSuite();

/** The EEPROM that the browser stores, as text; '' if none. */
function keptEeprom(page: Page): Promise<string> {
    return page.evaluate(
        () =>
            new Promise<string>((resolve, reject) => {
                const opened = indexedDB.open('motion512');
                opened.onerror = () => reject(opened.error);
                opened.onsuccess = () => {
                    const asked = opened.result.transaction('robot').objectStore('robot').get('cm5');
                    asked.onerror = () => reject(asked.error);
                    asked.onsuccess = () => {
                        opened.result.close();
                        resolve(asked.result ? Array.from(asked.result.eeprom as Uint8Array).join() : '');
                    };
                };
            }),
    );
}

/** Saves a setting as a person does in Play. */
async function saveLaw(page: Page, law = 'classic'): Promise<void> {
    const more = page.getByRole('button', { name: 'More' });
    if (await more.isVisible()) await more.click();
    await page.getByRole('tab', { name: 'Terminal', exact: true }).click();
    await page.getByRole('textbox', { name: 'Terminal of the robot' }).focus();
    await page.keyboard.type(`law ${law}`);
    await page.keyboard.press('Enter');
}

/** Opens the page in a second tab and waits until its robot stands. */
async function openSecond(person: Visitor): Promise<Page> {
    const second = await person.page.context().newPage();
    await second.route(PHYSICS, () => undefined); // late: that it is missing would take the place of what is said of the copy
    await second.goto(suite.address);
    await second.locator('status-bar .doing').filter({ hasText: 'The robot stands and waits.' }).waitFor();
    return second;
}

/** Whether the browser asks a person who leaves the page. */
function isAskedToStay(page: Page): Promise<boolean> {
    return page.evaluate(() => !window.dispatchEvent(new Event('beforeunload', { cancelable: true })));
}

test('a second tab says that it has a copy; what the first has saved stays, whatever the second saves or forgets, which says so all the time; when the first is closed, the second keeps its robot', async () => {
    const person = await suite.come();
    await person.untilStanding();
    const second = await openSecond(person);
    expect(await second.getByRole('log', { name: 'Last message' }).textContent()).toMatch(
        /^Another tab has this document open, so this one has a copy: .* What you change here is kept in the copy alone\.$/,
    );
    const notice = second.getByRole('status', { name: "Robot's memory" }).filter({ hasText: /^Another tab keeps its robot/ });
    await notice.waitFor();
    expect(await isAskedToStay(second)).toBe(false); // nothing is saved yet
    const before = await keptEeprom(second);
    await saveLaw(second);
    await expect.poll(() => isAskedToStay(second)).toBe(true);
    await notice.waitFor();
    expect(await keptEeprom(second)).toBe(before);
    await saveLaw(person.page);
    await expect.poll(() => keptEeprom(person.page)).not.toBe(before);
    const saved = await keptEeprom(person.page);
    await second.getByRole('tab', { name: 'Robot', exact: true }).click();
    await second.getByRole('button', { name: 'Factory fresh' }).click();
    await second
        .getByRole('dialog', { name: 'Factory fresh?' })
        .getByRole('button', { name: /^(?!Cancel)/ })
        .first()
        .click();
    await second.locator('status-bar .doing').filter({ hasText: 'The robot is starting' }).waitFor();
    await second.locator('status-bar .doing').filter({ hasText: 'The robot stands and waits.' }).waitFor();
    expect(await keptEeprom(second)).toBe(saved);

    await person.page.reload(); // it is still the first tab
    await person.untilStanding();
    await person.open('Terminal');
    await person.type('law\r');
    await person.untilScreenSays(/\] law\s+classic/); // the robot of before
    await saveLaw(person.page, 'exact');
    await expect.poll(() => keptEeprom(person.page)).not.toBe(saved);

    await saveLaw(second);
    await expect.poll(() => isAskedToStay(second)).toBe(true);
    const last = await keptEeprom(second);
    await person.page.close();
    await notice.waitFor({ state: 'detached' });
    await expect.poll(() => keptEeprom(second)).not.toBe(last);
    await expect.poll(() => isAskedToStay(second)).toBe(false);
    await person.leave();
});

test('over plain http from another machine, where the browser has no locks: the second tab has a copy, and says that its robot is not kept', async () => {
    const person = await suite.come({
        before: page => page.context().addInitScript(() => Reflect.deleteProperty(Navigator.prototype, 'locks')),
    });
    await person.untilStanding();
    const second = await openSecond(person);
    expect(await second.evaluate(() => 'locks' in navigator)).toBe(false);
    await second
        .getByRole('status', { name: "Robot's memory" })
        .filter({ hasText: /^Another tab keeps its robot/ })
        .waitFor();
    const more = second.getByRole('button', { name: 'More' });
    if (await more.isVisible()) await more.click();
    await second.getByRole('tab', { name: 'Steps', exact: true }).click();
    const chosen = second.getByRole('combobox', { name: 'Document', exact: true }).locator('option:checked');
    await expect.poll(() => chosen.textContent()).toMatch(/\(copy\)$/);
    await person.page.close();
    await second
        .getByRole('log', { name: 'Last message' })
        .filter({ hasText: /^The other tab is closed/ })
        .waitFor();
    await person.leave();
});
