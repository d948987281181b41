// SPDX-License-Identifier: MIT
// Legs that were limp and bent do not carry the robot. The hand keeps holding it after "Hold" until "Let go" or a play. A limb whose release
// was refused is not shown as limp.
import { expect, test } from 'vitest';
import { pageSuite } from './page-suite.ts';

const suite = pageSuite();
const HELD = 'A hand holds the robot.';

test('the hand stays over legs that were let go, and over an arm beside them, until "Let go", and the next time until a play', async () => {
    const person = await suite.come({ hasPhysics: true });
    const { page, doing } = person;
    await person.untilStanding();
    for (const limbs of [['Right leg'], ['Left leg', 'Right arm']]) {
        await person.open('Steps');
        for (const limb of limbs) await person.button(limb).click();
        await person.untilDoing(HELD);
        await person.robotSeconds(0.5); // all limbs are limp
        await person.button('Hold').click();
        await page
            .getByRole('log', { name: 'Last message' })
            .filter({ hasText: /^The legs were limp, so the hand still holds the robot/ })
            .waitFor();
        await person.robotSeconds(2); // a hand needs 0.4 s to let go
        expect(await doing.textContent()).toContain(HELD);
        if (limbs.length === 1) await person.button('Let go').click();
        else {
            await person.open('Remote');
            await person.button('Bow').click();
            await doing.filter({ hasText: /^Playing motion 2 \(bow\)/ }).waitFor(); // it lets go before it plays
        }
        await doing.filter({ hasNotText: HELD }).waitFor();
    }
    await person.untilStanding();

    await person.open('Steps'); // only an arm: the legs carry the robot
    await person.button('Right arm').click();
    await doing.filter({ hasText: HELD }).waitFor();
    await person.button('Hold').click();
    await doing.filter({ hasNotText: HELD }).waitFor();

    await person.open('Robot'); // a robot that is off releases nothing
    await person.button('Power off').click();
    await person.open('Steps');
    await person.button('Right leg').click();
    await page.getByRole('log', { name: 'Last message' }).filter({ hasText: 'off' }).waitFor();
    await expect.poll(() => person.button('Right leg').getAttribute('aria-pressed')).toBe('false');
    await person.leave();
});
