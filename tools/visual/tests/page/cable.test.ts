// SPDX-License-Identifier: MIT
// A cable that leads to another robot. One that is pulled in a write: pages.test.ts; in live follow: stop.test.ts.
import { expect, test } from 'vitest';
import { pageSuite } from './page-suite.ts';

const suite = pageSuite();

test('the cable leads to another robot while the comparison is open: it shows that robot, and after a refused write what was read then', async () => {
    const person = await suite.come();
    const { page } = person;
    await person.untilStanding();
    await person.open('Motions');
    await page.getByRole('option', { name: /^motion 7 stand/ }).click();
    await person.button('Copy or move …').click();
    await page.getByRole('textbox', { name: 'To number' }).fill('60');
    await page.keyboard.press('Enter');
    await page.getByRole('dialog').getByRole('button', { name: 'Copy', exact: true }).click();
    await person.button('To the robot (1) …').click();
    const rows = page.getByRole('list', { name: 'Motions that differ' });
    await person.button('Write 1 motion into the robot').waitFor();
    // What the page does when another robot answers: motions 5 and 60 of that one differ.
    await person.inPage(({ editor }) => {
        const { robot } = editor.state.get();
        editor.setRobot(robot.map((bytes, at) => (at === 5 || at === 60 ? (robot[8] ?? null) : bytes)));
    });
    await rows.locator('[data-page="5"]').waitFor();
    expect(await rows.getByRole('listitem').and(page.locator('[data-page]')).count()).toBe(2);
    // Now the first one is on the cable again.
    await person.button('Write 2 motions into the robot').click();
    await page.getByRole('status', { name: 'Transfer' }).filter({ hasText: 'has changed in the robot since it was read' }).waitFor();
    await rows.locator('[data-page="5"]').waitFor({ state: 'detached' });
    await rows.locator('[data-page="60"]').waitFor();
    await person.leave();
});
