// SPDX-License-Identifier: MIT
// A field of Steps belongs to the motion that it was shown for. With the cursor in it another motion may be chosen: by a link in the address,
// or by a file. Leaving the page commits what the person has typed, and only that.
import type { Locator } from 'playwright-core';
import { expect, test } from 'vitest';
import { Visitor } from './page-bench.ts';
import { pageSuite } from './page-suite.ts';

const LIBRARY = new URL('../../../../build/motions/motions.bin', import.meta.url).pathname;
const suite = pageSuite();

interface InSteps {
    readonly person: Visitor;
    readonly name: Locator;
    readonly times: Locator;
    /** The number and name of a motion in the list. */
    listed(page: number): Promise<string | null>;
    choose(page: number): Promise<unknown>;
    /** Opens the link of motion 2, which the document has already, and waits until that motion is chosen. */
    openBow(): Promise<void>;
    /** Leaves the page and comes back. */
    comeBack(): Promise<void>;
}

async function inSteps(): Promise<InSteps> {
    const person = await Visitor.come(suite.browser, suite.address, { hasPicture: false, hasPhysics: false });
    const { page } = person;
    await person.untilStanding();
    await person.open('Steps');
    const choice = page.getByRole('combobox', { name: 'Motion', exact: true });
    const choose = (number: number): Promise<unknown> => choice.selectOption(String(number));
    await choose(2);
    const link = await page.evaluate(() => {
        const { session } = document.querySelector('app-shell') as unknown as { session: { files: { link(): Promise<string> } } };
        return session.files.link();
    });
    return {
        person,
        name: page.getByRole('textbox', { name: 'Name of the motion' }),
        times: page.getByRole('spinbutton', { name: 'Times', exact: true }),
        choose,
        listed: number => choice.locator(`option[value="${number}"]`).textContent(),
        openBow: async () => {
            await page.evaluate(hash => window.location.replace(hash), link);
            await expect.poll(() => choice.inputValue()).toBe('2');
        },
        comeBack: async () => {
            await page.reload();
            await person.open('Steps');
        },
    };
}

test('a link is opened with the cursor in a field: the field shows the new motion, which leaving the page does not change', async () => {
    const { person, name, times, listed, choose, openBow, comeBack } = await inSteps();
    await choose(3);
    await name.fill('mywave');
    await name.press('Enter'); // the cursor stays
    expect(await listed(3)).toBe('3 mywave');
    await openBow();
    expect(await name.inputValue()).toBe('bow');
    await comeBack();
    expect([await listed(2), await listed(3)]).toEqual(['2 bow', '3 mywave']);

    await choose(3);
    await times.fill('7');
    await times.press('Enter');
    await openBow();
    expect(await times.inputValue()).toBe('1');
    await comeBack();
    await choose(2);
    expect(await times.inputValue()).toBe('1');
    await choose(3);
    expect(await times.inputValue()).toBe('7');
    await person.leave();
});

test('a link is opened while a name or a time is half-typed: the motion it was typed for gets it', async () => {
    const { person, name, listed, choose, openBow, comeBack } = await inSteps();
    const time = person.page.getByLabel('Time of step 1', { exact: true });
    const bows = await time.inputValue();
    await choose(3);
    await name.fill('half');
    await openBow();
    expect(await name.inputValue()).toBe('bow');
    await choose(3);
    await time.fill('1.50');
    await openBow();
    expect(await time.inputValue()).toBe(bows);
    await comeBack();
    expect([await listed(2), await listed(3)]).toEqual(['2 bow', '3 half']);
    await choose(2);
    expect(await time.inputValue()).toBe(bows);
    await choose(3);
    expect(Number(await time.inputValue())).toBeCloseTo(1.5, 1);
    await person.leave();
});

test('a file becomes a new document with the cursor in the name: its motion keeps its own name', async () => {
    const { person, name, listed, choose, comeBack } = await inSteps();
    await choose(3);
    await name.fill('mywave');
    await name.press('Enter');
    await person.page.getByLabel('Motion file').setInputFiles(LIBRARY);
    await person.button('As a new document').click();
    await expect.poll(() => listed(3)).toBe('3 wave');
    const shown = await person.page.getByRole('combobox', { name: 'Motion', exact: true }).inputValue();
    const before = await listed(Number(shown));
    expect(await name.inputValue()).toBe('');
    await comeBack();
    expect(await listed(Number(shown))).toBe(before);
    await person.leave();
});

test('the cursor is in a time and nothing is typed: leaving the page gives that time to no other chosen step', async () => {
    const { person, choose, comeBack } = await inSteps();
    const { page } = person;
    await choose(3);
    const times = (): Promise<string[]> =>
        page.getByLabel(/^Time of step \d$/).evaluateAll(fields => fields.map(field => (field as HTMLInputElement).value));
    const before = await times();
    expect(new Set(before).size).toBeGreaterThan(1);
    await page.getByRole('button', { name: 'Step 1', exact: true }).focus();
    await page.keyboard.press('Control+a');
    await page.getByLabel('Time of step 1', { exact: true }).focus();
    await comeBack();
    await choose(3);
    expect(await times()).toEqual(before);
    await person.leave();
});
