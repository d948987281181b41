// SPDX-License-Identifier: MIT
// Stop precedes everything that waits, and no key moves the robot by surprise: neither in a dialog nor when released elsewhere.
import { expect, test } from 'vitest';
import { Visitor } from './page-bench.ts';
import type { Shell } from './page-bench.ts';
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

test('Stop ends live follow, and so does a cable or an adapter that is pulled: the robot does not move by itself when it is connected again', async () => {
    const person = await Visitor.come(suite.browser, suite.address, { hasPicture: false, hasPhysics: false });
    const { page } = person;
    await person.untilStanding();
    const follow = await person.follow();
    await page.locator('#area-steps').getByRole('button', { name: 'Stop' }).click();
    await expect.poll(() => follow.isChecked()).toBe(false);
    await follow.check();
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
