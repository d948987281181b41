// SPDX-License-Identifier: MIT
// Another language, from the menu, the address or the browser. Only its file is loaded, and the person's work is kept.
import { expect, test } from 'vitest';
import { EN } from '../../view/texts/en.ts';
import DE from '../../view/texts/de.ts';
import JA from '../../view/texts/ja.ts';
import { pageSuite } from './page-suite.ts';
import { comesLater } from './weight.ts';

const suite = pageSuite();

/** In the browser: a port that never finishes opening. */
function withPort(): void {
    const port = { getInfo: () => ({ usbVendorId: 0x0403 }), open: () => new Promise(() => undefined) };
    Object.assign((navigator as unknown as { serial: object }).serial, {
        requestPort: () => Promise.resolve(port),
        getPorts: () => Promise.resolve([]),
    });
}

test('German by the menu, after a new motion; Japanese by the address; each loads its own file and no other', async () => {
    const asked: string[] = [];
    const person = await suite.come({
        before: async page => {
            page.on('request', request => asked.push(request.url()));
            await page.addInitScript(withPort);
        },
    });
    const { page } = person;
    const languages = (): string[] =>
        asked.splice(0).flatMap(url => (comesLater(url, '') === 'languages' ? [url.replace(/^.*\/(\w+)-[^/]*$/, '$1')] : []));
    const doing = (text: string | RegExp) => page.locator('status-bar .doing').filter({ hasText: text });
    await person.untilStanding();
    expect(languages()).toEqual([]);
    await person.open('Steps');
    await person.button('New motion').click();
    await person.button('Add step from the robot').click();
    // Somebody's edits in Edit would be lost, because the robot in the page restarts.
    await person.open('Robot');
    await person.button('Run Edit').click();
    await doing(EN.status.editRuns).waitFor();
    await person.open('Terminal');
    await person.untilScreenSays('PageNumber');
    await person.type('page 100\rname mine\r');
    await person.untilScreenSays('unsaved');
    await person.openMenu();
    const language = page.getByRole('combobox', { name: 'Language' });
    await language.selectOption('de');
    await page.getByRole('log').filter({ hasText: 'has edits that are not saved' }).waitFor();
    expect(await language.inputValue()).toBe('en');
    await person.type('undo\r');
    await person.openMenu();
    await language.selectOption('de');
    await doing(DE.status.waits).waitFor();
    expect(languages()).toEqual(['de']);
    const description = page.locator('meta[name="description"]');
    expect(await page.evaluate(() => [document.documentElement.lang, document.title])).toEqual(['de', DE.page.title]);
    expect(await description.getAttribute('content')).toBe(DE.page.description);
    await page.getByRole('tab', { name: DE.areas.titles.steps }).click();
    await page.getByRole('button', { name: DE.steps.step(1), exact: true }).waitFor();
    await person.openMenu();
    await page.getByRole('button', { name: DE.menu.yourRobot, exact: true }).click();
    await page.getByRole('button', { name: DE.menu.port('FTDI'), exact: true }).waitFor();
    await page.goto(`${suite.address}?lang=ja`);
    await doing(JA.status.waits).waitFor();
    expect(languages()).toEqual(['ja']);
    await page.getByRole('link', { name: JA.remote.motions }).click();
    await page.getByRole('heading', { name: JA.first.what }).waitFor();
    await page.getByRole('link', { name: JA.start.toRobot }).click();
    await doing(JA.status.waits).waitFor();
    await page.goto(suite.address); // the choice is kept
    await doing(DE.status.waits).waitFor();
    await person.leave();
});
