// SPDX-License-Identifier: MIT
// The page in a language made from English with accents, 40 % longer (view/texts/pseudo.ts). Plain English in it does not come from the
// texts, and clipped text would be clipped in other languages. On the way axe-core and the contrast are asked, too.
import { expect, test } from 'vitest';
import PSEUDO from '../../view/texts/pseudo.ts';
import { pageSuite } from './page-suite.ts';
import { Walk } from './words.ts';

const DESKTOP = { width: 1440, height: 900 };
const PHONE = { width: 390, height: 844 };
/** Names and words that are the same in every language: of motions, of labels on the board, of programs and files. */
const KEPT = /Motion512|START|MODE|\.(m512|bin|hex|mtn)\b/g;
const suite = pageSuite();

test('no plain English anywhere, and nothing is cut at +40 %, on a desktop and on a phone; no serious finding of axe in any area and any dialog; the contrast holds, light and dark', async () => {
    const person = await suite.come({ screen: DESKTOP, hasPicture: true, hasPython: true, isNew: true }, `${suite.address}?lang=pseudo`);
    const { page } = person;
    await page.locator('status-bar .doing').filter({ hasText: PSEUDO.status.waits }).waitFor();
    await page.locator('robot-view canvas').waitFor();
    await person.stopDrawing();
    const names = await person.inPage(({ editor }) =>
        Array.from({ length: 128 }, (_, number) => editor.page(number).name).filter(one => one !== ''),
    );
    const withoutNames = (text: string): string =>
        [...names].sort((a, b) => b.length - a.length).reduce((rest, one) => rest.replaceAll(one, ''), text.replaceAll(KEPT, ''));
    const isPlain = (text: string): boolean => /[A-Za-z]{2}/.test(withoutNames(text));
    await new Walk(person, PSEUDO, [PHONE, DESKTOP], (place, { plain, cut, barred }) => {
        const isQuoted = place.startsWith('refused file'); // m512's words
        expect.soft(isQuoted ? [] : plain.filter(isPlain), `${place}: plain English`).toEqual([]);
        expect.soft(cut, `${place}: cut`).toEqual([]);
        expect.soft(barred, place).toEqual([]);
    }).all();
    await person.press(PSEUDO.menu.theme); // it is light
    expect(await page.evaluate(() => document.documentElement.dataset.theme)).toBe('dark');
    await person.leave();
});
