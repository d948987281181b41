// SPDX-License-Identifier: MIT
// Play: the picture moves at once and shows the robot as soon as it plays. Scrubber and loop move only the picture.
import { expect, test } from 'vitest';
import type { Visitor } from './page-bench.ts';
import { pageSuite } from './page-suite.ts';

const suite = pageSuite();

interface View extends HTMLElement {
    readonly hasGhost: boolean;
    placeOf(name: string): { x: number; y: number };
}

const figure = (visitor: Visitor) =>
    visitor.page.locator('robot-view').evaluate(view => {
        const { hasGhost, placeOf } = view as unknown as View;
        return { hasGhost, hand: placeOf.call(view, 'right_hand') };
    });

test('Play after an edit: within 0.3 s the solid figure moves, no ghost is seen while anything plays, and the robot follows by itself', async () => {
    const person = await suite.come({ hasPicture: true });
    await person.untilStanding();
    await person.open('Motions');
    await person.page.getByRole('option', { name: /^motion 3 wave/ }).dblclick();
    await person.page.getByLabel('Time of step 1').fill('0.9');
    await person.page.getByLabel('Time of step 1').press('Enter');
    await person.untilSeen();
    await person.inPage(({ preview }) => {
        const button = [...document.querySelectorAll('steps-pane button')].find(one => one.textContent === '▶ Play');
        button?.addEventListener('click', () => performance.mark('play-asked'), { capture: true });
        preview.state.watch(
            () => preview.state.get().tick > 0 && !performance.getEntriesByName('moved').length && performance.mark('moved'),
        );
    });
    await person.button('▶ Play').click();
    await person.untilDoing(/^In the picture only: motion 3 \(wave\)\./);
    const tookMs = await person.page.evaluate(() => {
        const at = (name: string): number => performance.getEntriesByName(name)[0]?.startTime ?? NaN;
        return at('moved') - at('play-asked');
    });
    console.log(`Play to the first movement of the picture: ${tookMs.toFixed(0)} ms`);
    await expect.poll(async () => (await figure(person)).hasGhost).toBe(false); // in the next picture, which takes a while by software
    await person.untilDoing(/^Playing motion 3 \(wave\)/);
    const ghosts: boolean[] = [];
    for (let i = 0; i < 8; i++) ghosts.push((await figure(person)).hasGhost);
    expect(ghosts).not.toContain(true);
    await person.untilStanding();
    expect((await figure(person)).hasGhost).toBe(false); // until the next edit
    await person.leave();
});

/** In Steps: Escape or a press beside it closes a menu; a key moves the focus to the picture and back; the chosen joint is spoken. */
async function menuAndKeys({ page }: Visitor): Promise<void> {
    const menu = page.locator('pose-bar details');
    const view = menu.locator('summary');
    await view.click();
    await page.keyboard.press('Escape');
    expect(await menu.getAttribute('open')).toBeNull();
    await view.click();
    await page.getByRole('tab', { name: 'Steps' }).click();
    expect(await menu.getAttribute('open')).toBeNull();

    await page.keyboard.press('F6');
    expect(await page.evaluate(() => document.activeElement?.tagName)).toBe('CANVAS');
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('ArrowUp');
    await expect.poll(() => page.getByRole('status', { name: 'Chosen joint' }).textContent()).toMatch(/^right shoulder .*: \d+/);
    await page.keyboard.press('F6');
    expect(await page.evaluate(() => document.activeElement?.getAttribute('role'))).toBe('tab');
}

test('the scrubber, a step and the loop move the picture, and the robot hears nothing', async () => {
    const person = await suite.come({ hasPicture: true });
    await person.untilStanding();
    await person.open('Motions');
    await person.page.getByRole('option', { name: /^motion 3 wave/ }).dblclick();
    const moment = person.page.getByRole('slider', { name: 'Moment of the motion' });
    await moment.focus();
    await person.page.keyboard.press('End');
    await person.untilDoing(/^In the picture only: motion 3 \(wave\)\. The robot stands and waits\./);
    const last = (await figure(person)).hand;
    await person.page.keyboard.press('Home');
    await person.untilSeen();
    await expect.poll(async () => (await figure(person)).hand.y).not.toBe(last.y);
    await person.button('Step 3').click();
    await person.button('From this step').click();
    await expect.poll(() => person.page.locator('step-row li.playing .number').first().textContent()).toMatch(/[34]/);
    await person.page.getByRole('checkbox', { name: 'Loop' }).check();
    await expect.poll(async () => Number(await moment.inputValue())).toBeLessThan(20); // it has started again
    await person.button('❙❙ Pause').click();
    const bar = await person.page.locator('time-line .bar').boundingBox();
    await person.page.mouse.click((bar?.x ?? 0) + (bar?.width ?? 0) * 0.21, (bar?.y ?? 0) + 10);
    expect(await person.page.locator('step-row li.playing .number').first().textContent()).toBe('2');
    expect(await person.page.locator('time-line .head').isVisible()).toBe(true);
    expect(await person.inPage(({ state }) => state.get().where?.state)).toBe('idle');
    await menuAndKeys(person);
    await person.leave();
});
