// SPDX-License-Identifier: MIT
// The page on a tablet held next to the robot: everything by finger, in landscape and portrait.
import type { Locator, Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { Fingers } from './fingers.ts';
import type { Point } from './fingers.ts';
import type { Visitor } from './page-bench.ts';
import { pageSuite } from './page-suite.ts';
import { chooseJoints, wayPoint } from './way-point.ts';

const LYING = { width: 1024, height: 768, hasTouch: true };
const ON_END = { width: 800, height: 1280, hasTouch: true };
const AREAS = ['Remote', 'Steps', 'Curves', 'Motions', 'Links', 'Checks', 'Terminal', 'Robot'] as const;
/** Minimum target size of WCAG 2.2. */
const TARGET_PX = 24;
/** From a drag to a tap elsewhere. After 0.1 s Chromium makes no click of it. */
const FINGER_MS = 500;
const suite = pageSuite();

async function untilAt(person: Visitor, shape: string, { x, y }: Point): Promise<void> {
    await expect
        .poll(async () => {
            const at = await person.placeOf(shape);
            return Math.hypot(at.x - x, at.y - y);
        })
        .toBeLessThan(2);
}

async function size(person: Visitor): Promise<number> {
    const [face, sole] = [await person.placeOf('face'), await person.placeOf('right_sole')];
    return Math.hypot(face.x - sole.x, face.y - sole.y);
}

/** Elements that are too small for a finger: name and size. */
function tooSmall(page: Page): Promise<string[]> {
    return page.evaluate(
        least =>
            [...document.querySelectorAll<HTMLElement>('button, select, summary, a, input, [role="option"]')].flatMap(element => {
                const isBox = element instanceof HTMLInputElement && ['checkbox', 'radio'].includes(element.type);
                const target = (isBox ? element.closest('label') : null) ?? element; // a label is part of its box
                const { width, height } = target.getBoundingClientRect();
                if (!element.checkVisibility() || width === 0 || element.closest('.skip, .xterm')) return [];
                return Math.min(width, height) < least
                    ? [`${element.getAttribute('aria-label') ?? element.textContent} ${width.toFixed(0)} x ${height.toFixed(0)}`]
                    : [];
            }),
        TARGET_PX,
    );
}

async function middle(locator: Locator): Promise<Point> {
    const box = await locator.boundingBox();
    if (!box) throw new Error('it is not on the screen');
    return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

const undo = (page: Page) => page.getByRole('button', { name: /^Undo/ });
const takeBack = async (page: Page, what: RegExp): Promise<void> => {
    await page.getByRole('button', { name: what }).waitFor();
    await page.waitForTimeout(FINGER_MS);
    await page.getByRole('button', { name: what }).tap();
    await expect.poll(() => undo(page).isDisabled()).toBe(true); // one drag is one undo step
};
const position = (page: Page) => page.getByRole('group', { name: 'Chosen joints' }).getByRole('spinbutton').first();

test('lying: the camera by one finger and by two, joints, a hand, steps, times and way-points dragged; nothing too small, nothing scrolls', async () => {
    const person = await suite.come({ hasPicture: true, screen: LYING });
    const { page } = person;
    const fingers = await Fingers.on(page);
    await person.untilStanding();
    const found: string[] = [];
    await page.getByRole('button', { name: 'More', exact: true }).tap();
    for (const area of AREAS) {
        await page.getByRole('tab', { name: area, exact: true }).tap();
        found.push(...(await tooSmall(page)).map(what => `${area}: ${what}`));
    }
    expect(found).toEqual([]);

    await page.getByRole('tab', { name: 'Motions', exact: true }).tap();
    await page.getByRole('option', { name: /^motion 2 bow/ }).tap();
    await page.getByRole('tab', { name: 'Steps', exact: true }).tap();
    const ground = { x: 60, y: 560 };
    const before = await person.placeOf('right_hand');
    await fingers.drag(ground, 90, 0); // one finger on the ground orbits
    await expect.poll(async () => Math.abs((await person.placeOf('right_hand')).x - before.x)).toBeGreaterThan(20);
    await fingers.drag(ground, -90, 0);
    const small = await size(person);
    await fingers.pinch(ground, { x: 520, y: 200 }, { x: -40, y: 40 }, { x: 50, y: -60 });
    await expect.poll(() => size(person)).toBeGreaterThan(small * 1.1);
    const large = await size(person);
    await fingers.pinch(await person.placeOf('face'), await person.placeOf('right_thigh'), { x: 0, y: 60 }, { x: 0, y: -60 }); // both on the robot
    await expect.poll(() => size(person)).toBeLessThan(large * 0.95);
    expect(await undo(page).isDisabled()).toBe(true); // viewed, not changed
    await person.untilStill();

    const forearm = await person.placeOf('right_forearm');
    await page.touchscreen.tap(forearm.x, forearm.y);
    await expect.poll(() => position(page).count()).toBe(1);
    const rest = await position(page).inputValue();
    const hand = await person.placeOf('right_hand');
    await fingers.drag(await person.placeOf('right_forearm'), 70, -40);
    await expect.poll(() => position(page).inputValue()).not.toBe(rest);
    await takeBack(page, /^Undo: pose/);
    await untilAt(person, 'right_hand', hand); // the picture follows the undo at the next drawing, later on a busy computer
    await fingers.drag(hand, -50, -90);
    await expect.poll(() => page.getByRole('group', { name: 'Chosen joints' }).getByRole('spinbutton').count()).toBeGreaterThan(2); // a limb
    await takeBack(page, /^Undo: pose/);

    const second = await middle(page.getByRole('button', { name: 'Step 2', exact: true }));
    const third = await middle(page.getByRole('button', { name: 'Step 3', exact: true }));
    await fingers.drag(second, third.x - second.x + 20, 4);
    await takeBack(page, /^Undo: steps moved/);
    const handle = await middle(page.locator('time-line .handle.time').nth(1));
    await fingers.drag({ x: handle.x - 12, y: handle.y }, 50, 0); // a finger's breadth beside the handle
    await takeBack(page, /^Undo: time/);

    await page.getByRole('tab', { name: 'Curves', exact: true }).tap();
    await chooseJoints(page, [15]);
    const canvas = page.getByRole('img', { name: 'Curves of the joints' });
    const at = await wayPoint(page, 15, 1);
    await fingers.drag({ x: at.x + 12, y: at.y + 8 }, 0, -60);
    await takeBack(page, /^Undo: drag/);
    const area = page.getByRole('tabpanel', { name: 'Curves' });
    const { x, y, height } = (await canvas.boundingBox()) ?? { x: 0, y: 0, height: 0 };
    await fingers.drag({ x: x + 8, y: y + height - 4 }, 0, -120); // away from all way-points: the area scrolls
    await expect.poll(() => area.evaluate(element => element.scrollTop)).toBeGreaterThan(30);
    expect(await undo(page).isDisabled()).toBe(true);

    await page.getByRole('tab', { name: 'Links', exact: true }).tap();
    const node = async (number: number): Promise<Point> => middle(page.locator(`links-pane .node[data-page="${number}"]`));
    const bow = await node(2);
    const wave = await node(3);
    await fingers.drag(bow, wave.x - bow.x, wave.y - bow.y);
    await page.getByRole('dialog').getByRole('button', { name: 'Cancel' }).tap();
    const leads = await page.evaluate(() => getComputedStyle(document.documentElement).overscrollBehaviorX);
    expect(leads).toBe('none'); // else a swipe leads to the page before; a headless browser has no such gesture

    await page.getByRole('tab', { name: 'Remote', exact: true }).tap();
    const ahead = await middle(page.getByRole('button', { name: 'U: ahead' }));
    await fingers.down(ahead);
    await person.untilDoing(/Playing motion 2[12] \(walk_/);
    await fingers.up();
    expect(await page.evaluate(() => [scrollX, scrollY, visualViewport?.scale])).toEqual([0, 0, 1]);
    await person.leave();
}, 900_000);

test('on end: a hand is taught by finger, the area scrolls, page and picture stay', async () => {
    const person = await suite.come({ hasPicture: true, hasPhysics: true, theme: 'dark', screen: ON_END });
    const { page } = person;
    const fingers = await Fingers.on(page);
    await person.untilStanding();
    await page.getByRole('tab', { name: 'Steps', exact: true }).tap();
    await page.getByRole('button', { name: 'New motion' }).tap();
    await page.getByRole('button', { name: 'Right arm' }).tap();
    await page.getByRole('status', { name: 'Teaching' }).filter({ hasText: 'Drag the limb' }).waitFor();
    const before = await person.placeOf('right_hand');
    await fingers.down(before);
    await fingers.to({ x: before.x - 30, y: before.y - 60 });
    await fingers.to({ x: before.x - 60, y: before.y - 120 });
    await expect.poll(async () => before.y - (await person.placeOf('right_hand')).y).toBeGreaterThan(40);
    await fingers.up();
    expect(await page.evaluate(() => scrollY)).toBe(0);
    await page.getByRole('button', { name: 'Add step from the robot' }).tap();
    await page.getByRole('button', { name: 'Step 1', exact: true }).waitFor();
    expect(await tooSmall(page)).toEqual([]);
    const area = page.getByRole('tabpanel', { name: 'Steps' });
    await area.evaluate(element => element.scrollTo(0, 0));
    await fingers.drag({ x: 780, y: 1150 }, 0, -200);
    await expect.poll(() => area.evaluate(element => element.scrollTop)).toBeGreaterThan(20);
    expect(await page.evaluate(() => scrollY)).toBe(0);
    expect(await page.evaluate(() => visualViewport?.scale)).toBe(1);
    await person.leave();
}, 900_000);
