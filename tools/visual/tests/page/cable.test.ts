// SPDX-License-Identifier: MIT
// A cable pulled while pages are written, or while the robot follows: what the page reports, what it knows of each page, and how it
// continues. The board is the one in the page, and its port has a method to pull the cable.
import { expect, test } from 'vitest';
import { Visitor } from './page-bench.ts';
import { pageSuite } from './page-suite.ts';

const suite = pageSuite();
const PAGES = [60, 61, 62, 63];

type Port = { deliver(bytes: Uint8Array): void; unplug(): void };
type Pages = readonly (Uint8Array | null)[];
type Shell = {
    session: {
        state: { set(change: { adapter: 'out' | 'back' | null }): void };
        sources: { simulated: { connection: { port: Port } } };
        editor: { state: { get(): { robot: Pages } }; setRobot(pages: Pages): void };
    };
};

/** Pulls the cable when the third page is being saved. */
async function pullAtThirdSave(person: Visitor): Promise<void> {
    await person.page.locator('app-shell').evaluate(shell => {
        const { port } = (shell as unknown as Shell).session.sources.simulated.connection;
        const deliver = port.deliver;
        let saves = 0;
        port.deliver = bytes => {
            deliver(bytes);
            if (new TextDecoder().decode(bytes).includes('@save') && ++saves === 3) port.unplug();
        };
    });
}

test('a cable pulled while four pages are written: each is told as old or new, "Try again" finishes', async () => {
    const person = await Visitor.come(suite.browser, suite.address, { hasPicture: false, hasPhysics: false });
    const { page } = person;
    await person.untilStanding();
    await person.open('Robot');
    await person.button('Run Edit').click();
    await person.doing.filter({ hasText: /^Edit runs:/ }).waitFor();
    await person.open('Motions');
    const card = (name: RegExp) => page.getByRole('option', { name });
    await card(/^motion 7 stand/).click();
    for (const number of PAGES) {
        await person.button('Copy or move …').click();
        await page.getByRole('textbox', { name: 'To number' }).fill(String(number));
        await page.keyboard.press('Enter');
        await page.getByRole('dialog').getByRole('button', { name: 'Copy', exact: true }).click();
        await card(new RegExp(`^motion ${number} stand`)).waitFor();
        await card(/^motion 7 stand/).click();
    }
    await person.button(`To the robot (${PAGES.length}) …`).click();
    const rows = page.getByRole('list', { name: 'Motions that differ' });
    await rows.getByText(`motion ${PAGES[0]} (stand)`).waitFor();
    await pullAtThirdSave(person);
    await person.button(`Write ${PAGES.length} motions into the robot`).click();
    const status = page.getByRole('status', { name: 'Transfer' });
    await status.filter({ hasText: 'cable' }).waitFor();
    const accounts = await rows.getByRole('listitem').locator('.account').allTextContents();
    expect(accounts.slice(0, 2)).toEqual(['✓ written', '✓ written']);
    expect(['being saved …', '✓ written']).toContain(accounts[2]);
    expect(accounts[3]).toBe('as it was');
    await expect
        .poll(
            async () => {
                // It reconnects by itself. Until then it reports the pulled cable again. The button may disappear between check and click;
                // then it was not needed.
                if (await person.button('Try again').isVisible())
                    await person
                        .button('Try again')
                        .click({ timeout: 2000 })
                        .catch(() => undefined);
                return status.textContent();
            },
            { timeout: 240_000, interval: 2000 },
        )
        .toContain(`Written and verified: ${PAGES.length} motions.`);
    await person.leave();
}, 900_000);

test('a cable pulled during live follow ends it: the robot does not move by itself when it is connected again', async () => {
    const person = await Visitor.come(suite.browser, suite.address, { hasPicture: false, hasPhysics: false });
    const { page } = person;
    await person.untilStanding();
    const follow = await person.follow();
    await page.locator('app-shell').evaluate(shell => (shell as unknown as Shell).session.sources.simulated.connection.port.unplug());
    await expect.poll(() => follow.isChecked()).toBe(false);
    await person.untilStanding(); // it connects again
    expect([await follow.isEnabled(), await follow.isChecked()]).toEqual([true, false]);
    // The adapter of My servos: the program behind it goes on, and so does the connection.
    await follow.check();
    const adapter = (change: 'out' | 'back'): Promise<void> =>
        page.locator('app-shell').evaluate((shell, now) => (shell as unknown as Shell).session.state.set({ adapter: now }), change);
    await adapter('out');
    expect([await follow.isEnabled(), await follow.isChecked()]).toEqual([false, false]);
    await adapter('back');
    expect([await follow.isEnabled(), await follow.isChecked()]).toEqual([true, false]);
    await person.leave();
});

test('the cable leads to another robot while the comparison is open: it shows that robot, and after a refused write what was read then', async () => {
    const person = await Visitor.come(suite.browser, suite.address, { hasPicture: false, hasPhysics: false });
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
    await page.locator('app-shell').evaluate(shell => {
        const { editor } = (shell as unknown as Shell).session;
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
