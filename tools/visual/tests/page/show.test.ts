// SPDX-License-Identifier: MIT
// Play: the picture moves at once and shows the robot as soon as it plays. Scrubber and loop move only the picture.
import { expect, test } from 'vitest';
import { Visitor } from './page-bench.ts';
import { SHOTS, pageSuite } from './page-suite.ts';

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
    const person = await Visitor.come(suite.browser, suite.address, { screen: { width: 1280, height: 800 }, hasPhysics: false });
    await person.untilStanding();
    await person.open('Motions');
    await person.page.getByRole('option', { name: /^motion 3 wave/ }).dblclick();
    await person.page.getByLabel('Time of step 1').fill('0.9');
    await person.page.getByLabel('Time of step 1').press('Enter');
    await person.untilSeen();
    await person.page.evaluate(() => {
        const shell = document.querySelector('app-shell') as unknown as {
            session: { preview: { pose(): unknown; state: { watch(l: () => void): void; get(): { tick: number } } } };
        };
        const button = [...document.querySelectorAll('steps-pane button')].find(one => one.textContent === '▶ Play');
        button?.addEventListener('click', () => performance.mark('play-asked'), { capture: true });
        const { preview } = shell.session;
        preview.state.watch(
            () => preview.state.get().tick > 0 && !performance.getEntriesByName('moved').length && performance.mark('moved'),
        );
    });
    await person.button('▶ Play').click();
    await person.doing.filter({ hasText: /^In the picture only: motion 3 \(wave\)\./ }).waitFor();
    const tookMs = await person.page.evaluate(() => {
        const at = (name: string): number => performance.getEntriesByName(name)[0]?.startTime ?? NaN;
        return at('moved') - at('play-asked');
    });
    console.log(`Play to the first movement of the picture: ${tookMs.toFixed(0)} ms`);
    await expect.poll(async () => (await figure(person)).hasGhost).toBe(false); // in the next picture, which takes a while by software
    await person.page.screenshot({ path: `${SHOTS}shown.png` });
    await person.doing.filter({ hasText: /^Playing motion 3 \(wave\)/ }).waitFor();
    const ghosts: boolean[] = [];
    for (let i = 0; i < 8; i++) ghosts.push((await figure(person)).hasGhost);
    expect(ghosts).not.toContain(true);
    await person.page.screenshot({ path: `${SHOTS}played.png` });
    await person.untilStanding();
    expect((await figure(person)).hasGhost).toBe(false); // until the next edit
    await person.leave();
});

test('the scrubber, a step and the loop move the picture, and the robot hears nothing', async () => {
    const person = await Visitor.come(suite.browser, suite.address, { screen: { width: 1280, height: 800 }, hasPhysics: false });
    await person.untilStanding();
    await person.open('Motions');
    await person.page.getByRole('option', { name: /^motion 3 wave/ }).dblclick();
    const moment = person.page.getByRole('slider', { name: 'Moment of the motion' });
    await moment.focus();
    await person.page.keyboard.press('End');
    await person.doing.filter({ hasText: /^In the picture only: motion 3 \(wave\)\. The robot stands and waits\./ }).waitFor();
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
    await person.page.screenshot({ path: `${SHOTS}scrubber.png` });
    expect(
        await person.page.evaluate(
            () =>
                (
                    document.querySelector('app-shell') as unknown as { session: { state: { get(): { where: { state: string } } } } }
                ).session.state.get().where.state,
        ),
    ).toBe('idle');
    await person.leave();
});
