// SPDX-License-Identifier: MIT
// The page in a language made from English with accents, 40 % longer (view/texts/pseudo.ts). Plain English in it does not come from the
// texts, and clipped text would be clipped in other languages.
import { expect, test } from 'vitest';
import PSEUDO from '../../view/texts/pseudo.ts';
import { Visitor } from './page-bench.ts';
import { SHOTS, pageSuite } from './page-suite.ts';
import { Walk } from './words.ts';

const SCREENS = { desktop: { width: 1440, height: 900 }, phone: { width: 390, height: 844, hasTouch: true } };
/** Names and words that are the same in every language: of motions, of labels on the board, of programs and files. */
const KEPT = /Motion512|START|MODE|\.(m512|bin|hex|mtn)\b/g;
const suite = pageSuite();

test.each(Object.entries(SCREENS))('no plain English anywhere, and nothing is cut at +40 %% (%s)', async (name, screen) => {
    const person = await Visitor.come(suite.browser, `${suite.address}?lang=pseudo`, {
        screen,
        isNew: true,
        hasPhysics: false,
    });
    const { page } = person;
    await page.locator('status-bar .doing').filter({ hasText: PSEUDO.status.waits }).waitFor();
    const names = await page.evaluate(() => {
        const { session } = document.querySelector('app-shell') as unknown as {
            session: { editor: { page(number: number): { name: string } } };
        };
        return Array.from({ length: 128 }, (_, number) => session.editor.page(number).name).filter(one => one !== '');
    });
    const withoutNames = (text: string): string =>
        [...names].sort((a, b) => b.length - a.length).reduce((rest, one) => rest.replaceAll(one, ''), text.replaceAll(KEPT, ''));
    await new Walk(person, PSEUDO, async (place, { plain, cut }) => {
        expect
            .soft(
                plain.filter(text => /[A-Za-z]{2}/.test(withoutNames(text))),
                `${place}: plain English`,
            )
            .toEqual([]);
        expect.soft(cut, `${place}: cut`).toEqual([]);
        await page.screenshot({ path: `${SHOTS}pseudo-${name}-${place.replaceAll(' ', '-')}.png` });
    }).all();
    await person.leave();
});
