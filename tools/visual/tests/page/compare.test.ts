// SPDX-License-Identifier: MIT
// Opening a file, and comparing with one, that cannot be read or whose reading is cancelled; comparing with a robot that becomes another one.
// A cable that is pulled in a write: pages.test.ts; in live follow: stop.test.ts.
import { expect, test } from 'vitest';
import { misnamed } from './accessible.ts';
import { pageSuite } from './page-suite.ts';

const suite = pageSuite();
/** Python's own code. Without it no file can be read. */
const PYTHON = '**/python-*.zip';

const THEIRS = { name: 'theirs.m512', mimeType: '', buffer: Buffer.from('motion512 1\n') };

test('a file to open or to compare with: a reading that does not end is cancelled, by the button and by Close, and one that fails says why', async () => {
    let isOnline = true;
    const person = await suite.come({
        hasPython: true,
        before: page => page.route(PYTHON, route => (isOnline ? undefined : route.abort())),
    }); // online, but without an answer
    const { page } = person;
    await person.untilStanding();
    // The dialog is there before there is anything to say: later it would take the keys from a field.
    const opening = page.getByRole('dialog', { name: 'Reading theirs.m512 …' });
    for (const leave of [() => person.button('Cancel').click(), () => page.keyboard.press('Escape')]) {
        await page.getByLabel('Motion file').setInputFiles(THEIRS);
        await opening.waitFor();
        await page.keyboard.press('Enter'); // held a little too long: it does not cancel
        expect(await opening.isVisible()).toBe(true);
        await leave();
        await page.getByRole('dialog').waitFor({ state: 'hidden' });
    }

    await person.open('Steps');
    await page.getByRole('textbox', { name: 'Name of the motion' }).fill('mine');
    await page.keyboard.press('Enter');
    await person.button('To the robot (1) …').click();
    const dialog = page.getByRole('dialog', { name: 'Compare and write' });
    const status = dialog.getByRole('status', { name: 'Transfer' });
    const choose = (): Promise<void> => dialog.getByLabel('File to compare with').setInputFiles(THEIRS);
    const write = dialog.getByRole('button', { name: /^Write [012] motion/ });
    await write.filter({ hasText: 'Write 1 motion ' }).waitFor();
    // The document changes under the dialog, as by a file that is dropped on it: the list is made anew.
    await person.inPage(({ editor }) => editor.undo());
    await dialog.getByText('Nothing differs.').waitFor();
    expect(await write.isEnabled()).toBe(false);
    await person.inPage(({ editor }) => editor.redo());
    await write.filter({ hasText: 'Write 1 motion ' }).waitFor();

    // What the page does when the cable leads to another robot, whose motions 5 and mine differ; then the first one is there again.
    await person.inPage(({ editor }) => {
        const { robot, page: mine } = editor.state.get();
        editor.setRobot(robot.map((bytes, at) => (at === 5 || at === mine ? (robot[8] ?? null) : bytes)));
    });
    const fifth = page.getByRole('list', { name: 'Motions that differ' }).locator('[data-page="5"]');
    await fifth.waitFor();
    expect(await misnamed(page)).toEqual([]);
    await write.filter({ hasText: 'Write 2 motions ' }).click();
    await status.filter({ hasText: 'has changed in the robot since it was read' }).waitFor();
    await fifth.waitFor({ state: 'detached' }); // what was read then
    await write.filter({ hasText: 'Write 1 motion ' }).waitFor();

    await choose();
    await status.filter({ hasText: 'Reading theirs.m512 …' }).waitFor();
    await dialog.getByRole('button', { name: 'Cancel' }).click();
    await status.filter({ hasText: 'theirs.m512 was not read. Nothing has changed.' }).waitFor();
    expect(await dialog.getByRole('button', { name: 'Cancel' }).isVisible()).toBe(false);

    await choose();
    await status.filter({ hasText: 'Reading theirs.m512 …' }).waitFor();
    isOnline = false;
    await dialog.getByRole('button', { name: 'Close' }).click();
    await dialog.waitFor({ state: 'hidden' });
    await person.button('To the robot (1) …').click();
    expect(await status.textContent()).not.toContain('Reading theirs');

    await choose(); // the robot is still being read; its result must not remove a message
    await status.filter({ hasText: /could not be loaded\. Nothing was changed/ }).waitFor();
    await dialog.getByRole('button', { name: 'Stop' }).waitFor({ state: 'hidden' });
    await dialog.getByText('The words could not be loaded').waitFor();
    expect(await status.textContent()).toMatch(/could not be loaded\. Nothing was changed/);
    person.faults.splice(0); // the console reports the missing file
    await person.leave();
});
