// SPDX-License-Identifier: MIT
// A field of Steps belongs to the motion that it was shown for. With the cursor in it another motion may be chosen: by a link in the address,
// or by a file. Leaving the page commits what the person has typed, and only that.
import { expect, test } from 'vitest';
import { pageSuite } from './page-suite.ts';

const LIBRARY = new URL('../../../../build/motions/motions.bin', import.meta.url).pathname;
const suite = pageSuite();

test('a link or a file is opened with the cursor in a field, or the page is left: what was typed goes to the motion it was typed for, and nothing else changes', async () => {
    const person = await suite.come({ hasPython: true });
    const { page } = person;
    await person.untilStanding();
    await person.open('Steps');
    const choice = page.getByRole('combobox', { name: 'Motion', exact: true });
    const name = page.getByRole('textbox', { name: 'Name of the motion' });
    const times = page.getByRole('spinbutton', { name: 'Times', exact: true });
    const time = page.getByLabel('Time of step 1', { exact: true });
    const choose = (number: number): Promise<unknown> => choice.selectOption(String(number));
    const listed = (number: number): Promise<string | null> => choice.locator(`option[value="${number}"]`).textContent();
    const comeBack = async (): Promise<void> => {
        await page.reload();
        await person.open('Steps');
    };
    await choose(2);
    const link = await person.inPage(({ files }) => files.link());
    /** The link of motion 2, which the document has already. */
    const openBow = async (): Promise<void> => {
        await page.evaluate(hash => window.location.replace(hash ?? ''), link);
        await expect.poll(() => choice.inputValue()).toBe('2');
    };
    const bows = await time.inputValue();

    // Typed and entered; the cursor stays.
    await choose(3);
    await name.fill('mywave');
    await name.press('Enter');
    expect(await listed(3)).toBe('3 mywave');
    await openBow();
    expect(await name.inputValue()).toBe('bow');
    await choose(3);
    await times.fill('7');
    await times.press('Enter');
    await openBow();
    expect(await times.inputValue()).toBe('1');
    await comeBack();
    expect([await listed(2), await listed(3)]).toEqual(['2 bow', '3 mywave']);
    await choose(2);
    expect(await times.inputValue()).toBe('1');
    await choose(3);
    expect(await times.inputValue()).toBe('7');

    // Half-typed: the motion it was typed for gets it.
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

    // Nothing is typed: leaving the page gives that time to no other chosen step.
    const all = (): Promise<string[]> =>
        page.getByLabel(/^Time of step \d$/).evaluateAll(fields => fields.map(field => (field as HTMLInputElement).value));
    const before = await all();
    expect(new Set(before).size).toBeGreaterThan(1);
    await page.getByRole('button', { name: 'Step 1', exact: true }).focus();
    await page.keyboard.press('Control+a');
    await time.focus();
    await comeBack();
    await choose(3);
    expect(await all()).toEqual(before);

    // A file becomes a new document: its motion keeps its own name.
    await name.fill('again');
    await name.press('Enter');
    await page.getByLabel('Motion file').setInputFiles(LIBRARY);
    await person.button('As a new document').click();
    await expect.poll(() => listed(3)).toBe('3 wave');
    const shown = Number(await choice.inputValue());
    const kept = await listed(shown);
    expect(await name.inputValue()).toBe('');
    await comeBack();
    expect(await listed(shown)).toBe(kept);

    // The motions of a file are added while the focus is on a card: the first added one is chosen, not the card's again.
    await person.open('Motions');
    await page.getByRole('option', { name: /^motion 1 / }).click();
    const text = 'motion512 1\nrow 1..3\npage 9 mine\n  step 1s | 500 512 512\n';
    await page.getByLabel('Motion file').setInputFiles({ name: 'mine.m512', mimeType: 'text/plain', buffer: Buffer.from(text) });
    await person.button('Add to free places').click();
    await page.getByRole('option', { name: /mine/, selected: true }).waitFor();
    await person.leave();
});
