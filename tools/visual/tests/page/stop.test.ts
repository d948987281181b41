// SPDX-License-Identifier: MIT
// Stop precedes everything that waits, and no key moves the robot by surprise: neither in a dialog nor when released elsewhere.
import { expect, test } from 'vitest';
import { Visitor } from './page-bench.ts';
import { pageSuite } from './page-suite.ts';

const suite = pageSuite();

/** Records all status texts of the robot from now on. */
async function listen(person: Visitor): Promise<() => Promise<string[]>> {
    await person.doing.evaluate(doing => {
        const heard: string[] = [];
        Object.assign(window, { heard });
        new MutationObserver(() => heard.push(doing.textContent)).observe(doing, { characterData: true, childList: true, subtree: true });
    });
    return () => person.page.evaluate(() => (window as unknown as { heard: string[] }).heard);
}

test('Stop takes back what waits until the robot stands: "Walk it", "Push it", a motion', async () => {
    const person = await Visitor.come(suite.browser, suite.address, { isNew: true, hasPicture: false });
    await person.button('Walk it').click();
    const heard = await listen(person);
    await person.doing.filter({ hasText: 'A hand holds the robot.' }).waitFor();
    await person.button('Bow').click();
    await person.button('Stop').click();
    await person.untilStanding();
    await person.button('Wave').click();
    await person.doing.filter({ hasText: /^Playing motion 3 \(wave\)/ }).waitFor();
    expect((await heard()).filter(text => /walk|bow/.test(text))).toEqual([]);
    await person.leave();
    const other = await Visitor.come(suite.browser, suite.address, { isNew: true, hasPicture: false });
    await other.button('Push it').click();
    expect(await other.button('Stop').isEnabled()).toBe(true); // while the robot starts
    await other.button('Stop').click();
    await other.untilStanding();
    await other.button('Wave').click();
    await other.doing.filter({ hasText: /^Playing motion 3 \(wave\), step [2-7]/ }).waitFor(); // a pushed robot is lying
    expect(await other.doing.textContent()).not.toContain('lies');
    await other.leave();
});

test('the space bar stops Edit, and Edit goes on; no key drives the robot from a dialog; one that is let go elsewhere is let go', async () => {
    const person = await Visitor.come(suite.browser, suite.address, { hasPicture: false, hasPhysics: false });
    const { page } = person;
    const ahead = person.button('U: ahead');
    const isPressed = (): Promise<string | null> => ahead.getAttribute('aria-pressed');
    await person.untilStanding();
    await ahead.focus();
    await page.keyboard.down('Enter');
    expect(await isPressed()).toBe('true');
    await page.keyboard.press('Tab');
    await page.keyboard.up('Enter');
    expect(await isPressed()).toBe('false');
    await person.button('Stop').click();
    await page.keyboard.press('?');
    await page.keyboard.down('ArrowUp');
    expect(await isPressed()).toBe('false');
    await page.keyboard.up('ArrowUp');
    await page.keyboard.press('Escape');
    await person.untilStanding();

    await person.open('Robot');
    await person.button('Run Edit').click();
    await person.doing.filter({ hasText: /^Edit runs/ }).waitFor();
    await person.open('Remote');
    await person.button('Dance').click();
    await person.doing.filter({ hasText: /^Playing motion \d+ \(dance/ }).waitFor();
    expect(await page.getByText('at its end the keys lead on to').isVisible()).toBe(false); // they lead nowhere
    const heard = await listen(person);
    await page.keyboard.press('Space');
    await person.doing.filter({ hasText: /^Edit runs/ }).waitFor();
    expect((await heard()).filter(text => text.includes('starting'))).toEqual([]);
    await person.leave();
});

test('Stop ends live follow: nothing that is edited then moves the robot', async () => {
    const person = await Visitor.come(suite.browser, suite.address, { hasPicture: false, hasPhysics: false });
    const { page } = person;
    await person.untilStanding();
    const follow = await person.follow();
    await page.locator('#area-steps').getByRole('button', { name: 'Stop' }).click();
    await expect.poll(() => follow.isChecked()).toBe(false);
    await person.leave();
});

test('Power off, or Factory fresh, while Play has still to write: the robot does not play afterwards, and a new one does not get the motion', async () => {
    const person = await Visitor.come(suite.browser, suite.address, { hasPicture: false, hasPhysics: false });
    const { page } = person;
    const said = page.getByRole('log', { name: 'Last message' }).filter({ hasText: /^Not done: the robot was switched off/ });
    await person.untilStanding();
    await person.open('Steps');
    await page.getByRole('combobox', { name: 'Motion', exact: true }).selectOption('2');
    const heard = await listen(person);
    const play = async (name: string): Promise<void> => {
        await person.open('Steps');
        const field = page.getByRole('textbox', { name: 'Name of the motion' });
        await field.fill(name);
        await field.press('Enter');
        await person.button('▶ Play').click();
        await person.doing.filter({ hasText: 'The robot is starting' }).waitFor(); // with Edit, to write
    };
    /** At once, before Edit has started: without going to its tab. */
    const press = (name: string): Promise<void> => page.locator('robot-pane button', { hasText: name }).dispatchEvent('click');
    await play('aaa');
    await press('Power off');
    await said.waitFor();
    await person.open('Robot'); // in Steps the picture shows the step
    await person.doing.filter({ hasText: /switched off/ }).waitFor();
    await press('Power on');
    await person.untilStanding();
    await person.robotSeconds(4);
    await press('Run Play');
    await person.doing.filter({ hasText: /^The robot stands/ }).waitFor();
    await play('bbb');
    await press('Factory fresh');
    await person.button('Forget everything').dispatchEvent('click');
    await said.waitFor();
    await person.open('Robot');
    await person.untilStanding();
    await person.robotSeconds(4);
    expect((await heard()).filter(text => /^(Playing|Going slowly).*motion 2/.test(text))).toEqual([]);
    const motions = await page.locator('action-bar select').first().innerText();
    expect(motions).toContain('2 bow');
    await person.leave();
});
