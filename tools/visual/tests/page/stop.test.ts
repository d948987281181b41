// SPDX-License-Identifier: MIT
// Stop precedes everything that waits, and no key moves the robot by surprise: neither in a dialog nor when released elsewhere.
import { expect, test } from 'vitest';
import type { Visitor } from './page-bench.ts';
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

test('Stop takes back what waits until the robot stands: "Push it", a key to walk, a motion', async () => {
    const person = await suite.come({ hasPhysics: true, isNew: true });
    await person.button('Push it').click();
    expect(await person.button('Stop').isEnabled()).toBe(true); // while the robot starts
    await person.button('Stop').click();
    await person.button('U: ahead').click(); // as "Walk it" does
    const heard = await listen(person);
    await person.untilDoing('A hand holds the robot.');
    await person.button('Bow').click();
    await person.button('Stop').click();
    await person.untilStanding();
    await person.button('Wave').click();
    await person.untilDoing(/^Playing motion 3 \(wave\), step [2-7]/); // a pushed robot is lying
    expect((await heard()).filter(text => /walk|bow|lies/.test(text))).toEqual([]);
    await person.leave();
});

test('the space bar stops Edit, and Edit goes on; no key drives the robot from a dialog; one that is let go elsewhere is let go', async () => {
    const person = await suite.come();
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
    await person.untilDoing(/^Edit runs/);
    await person.open('Remote');
    await person.button('Dance').click();
    await person.untilDoing(/^Playing motion \d+ \(dance/);
    expect(await page.getByText('at its end the keys lead on to').isVisible()).toBe(false); // they lead nowhere
    const heard = await listen(person);
    await page.keyboard.press('Space');
    await person.untilDoing(/^Edit runs/);
    expect((await heard()).filter(text => text.includes('starting'))).toEqual([]);
    await person.leave();
});

test('Stop ends live follow, and so does a cable or an adapter that is pulled: the robot does not move by itself when it is connected again', async () => {
    const person = await suite.come();
    const { page } = person;
    await person.untilStanding();
    const follow = await person.follow();
    await page.locator('#area-steps').getByRole('button', { name: 'Stop' }).click();
    await expect.poll(() => follow.isChecked()).toBe(false);
    await follow.check();
    await person.inPage(({ sources }) => sources.simulated.connection.port.unplug());
    await expect.poll(() => follow.isChecked()).toBe(false);
    await person.untilStanding(); // it connects again
    expect([await follow.isEnabled(), await follow.isChecked()]).toEqual([true, false]);
    // The adapter of My servos: the program behind it goes on, and so does the connection.
    await follow.check();
    const adapter = (change: 'out' | 'back'): Promise<void> => person.inPage(({ state }, now) => state.set({ adapter: now }), change);
    await adapter('out');
    expect([await follow.isEnabled(), await follow.isChecked()]).toEqual([false, false]);
    await adapter('back');
    expect([await follow.isEnabled(), await follow.isChecked()]).toEqual([true, false]);
    await person.leave();
});
