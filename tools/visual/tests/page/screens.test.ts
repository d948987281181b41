// SPDX-License-Identifier: MIT
// The page on every screen: a phone in portrait and landscape, a tablet, a desktop, a desktop at 200 %. Measures what a stranger sees: a
// head of one row, a picture that stays, readable letters, no clipped word, few sizes, one blue button.
import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import DE from '../../view/texts/de.ts';
import { LANGUAGES } from '../../view/texts/languages.ts';
import { misnamed } from './accessible.ts';
import type { Screen, Visitor } from './page-bench.ts';
import { pageSuite } from './page-suite.ts';

const PHONE = { width: 390, height: 844, hasTouch: true };
const LYING = { width: 844, height: 390, hasTouch: true };
const TABLET = { width: 1024, height: 768, hasTouch: true };
const DESKTOP = { width: 1440, height: 900 };
const DESKTOP_AT_200 = { width: 720, height: 450 };
/** The picture beside the areas: the narrowest such screen, a tablet and a desktop. */
const BESIDE = [{ width: 1000, height: 700 }, TABLET, { width: 1280, height: 800 }, DESKTOP] as const;
const AREAS = ['Remote', 'Steps', 'Curves', 'Motions', 'Links', 'Checks', 'Terminal', 'Robot'] as const;
/** A row of 40 px buttons for fingers, including its margins. */
const ROW_PX = 64;
const TOUR_PX = 64;
/** From the middle of a foot to its tip in a phone's picture. */
const FOOT_PX = 10;
/** A short word in a list to choose from. */
const WORD_PX = 60;
const LEAST_TYPE_PX = 12;
const suite = pageSuite();

interface Look {
    readonly cut: readonly string[];
    readonly blue: readonly string[];
    readonly type: readonly number[];
}

/** In the browser: what is visible of the page now. */
function look(): Look {
    const seen = [...document.querySelectorAll<HTMLElement>('app-shell *')].filter(
        element => element.checkVisibility({ visibilityProperty: true }) && !element.closest('.xterm, svg, .visually-hidden, .skip'),
    );
    const hasText = (element: HTMLElement): boolean =>
        [...element.childNodes].some(node => node.nodeType === Node.TEXT_NODE && node.textContent?.trim());
    const pressed = seen.filter(element => element.matches('button, [role="tab"], summary'));
    const blue = getComputedStyle(document.documentElement).getPropertyValue('--accent').trim();
    const probe = Object.assign(document.createElement('i'), { className: 'probe' });
    document.body.append(probe);
    probe.style.setProperty('background-color', blue);
    const colour = getComputedStyle(probe).backgroundColor;
    probe.remove();
    const { innerWidth } = window;
    const isCut = (element: HTMLElement): boolean => {
        const box = element.getBoundingClientRect();
        return element.scrollWidth > element.clientWidth + 1 || box.left < -1 || box.right > innerWidth + 1;
    };
    return {
        cut: pressed.filter(element => element.clientWidth > 0 && isCut(element)).map(element => element.textContent),
        blue: pressed
            .filter(element => element.matches('button') && getComputedStyle(element).backgroundColor === colour)
            .map(element => element.textContent),
        type: [...new Set(seen.filter(hasText).map(element => parseFloat(getComputedStyle(element).fontSize)))].sort((a, b) => a - b),
    };
}

async function box(page: Page, what: string): Promise<{ x: number; y: number; width: number; height: number }> {
    const found = await page.locator(what).first().boundingBox();
    if (!found) throw new Error(`${what} is not on the screen`);
    return found;
}

/** What covers the picture at this place: text, or an element with its own background. */
function textsOver(page: Page, place: { x: number; y: number }): Promise<string[]> {
    return page.evaluate(
        point =>
            [...document.querySelectorAll<HTMLElement>('.stage > :not(robot-view) *, .joint-label')]
                .filter(element => {
                    const { left, right, top, bottom } = element.getBoundingClientRect();
                    return (
                        element.checkVisibility({ visibilityProperty: true }) &&
                        element.textContent !== '' &&
                        ([...element.childNodes].some(node => node.nodeType === Node.TEXT_NODE) ||
                            getComputedStyle(element).backgroundColor !== 'rgba(0, 0, 0, 0)') &&
                        point.x >= left &&
                        point.x <= right &&
                        point.y >= top &&
                        point.y <= bottom
                    );
                })
                .map(element => element.textContent),
        place,
    );
}

/** Beside each other, or on end the area as a sheet that folds. */
async function checkArrangement(person: Visitor, screen: Screen): Promise<void> {
    const { page } = person;
    if (screen === LYING || screen === DESKTOP_AT_200) {
        const [stage, areas] = [await box(page, '.stage'), await box(page, '.areas')];
        expect(areas.x).toBeGreaterThanOrEqual(stage.x + stage.width - 1);
        expect(areas.y).toBe(stage.y);
    }
    if (screen !== PHONE) return;
    await person.open('Steps');
    // The status bar below may meanwhile have one line or two. Only the sheet folds.
    const height = async (): Promise<number> => (await box(page, '.areas')).height;
    const before = await height();
    await person.button('Areas').click();
    expect(await height()).toBeLessThan(before - 100);
    await person.open('Steps');
    expect(await height()).toBe(before);
    await person.button('Menu').click();
    await person.button('Send as link').waitFor();
    await page.keyboard.press('Escape');
    await person.button('Send as link').waitFor({ state: 'hidden' });
}

/** Turns a screen for fingers to each of these sizes, and checks on each that no text covers these parts of the robot. */
async function checkInSight(person: Visitor, screens: readonly Screen[], shapes: readonly string[]): Promise<void> {
    const { page } = person;
    for (const { width, height } of screens) {
        await page.setViewportSize({ width, height });
        await person.untilSeen();
        for (const shape of shapes)
            await expect
                .poll(async () => textsOver(page, await person.placeOf(shape)), { message: `${shape}, ${width} x ${height}` })
                .toEqual([]);
    }
}

/** In an area: nothing is cut, at most one button is blue, and the picture stays when the area is scrolled. Returns its sizes of type. */
async function checkArea(person: Visitor, screen: Screen, place: string): Promise<readonly number[]> {
    const { page } = person;
    const picture = await box(page, '.stage');
    const found = await page.evaluate(look);
    expect.soft(found.cut, `${place}: cut`).toEqual([]);
    expect.soft(found.blue.length, `${place}: blue ${found.blue.join()}`).toBeLessThanOrEqual(1);
    await page.mouse.move(screen.width - 60, screen.height - 90);
    await page.mouse.wheel(0, 600);
    await person.untilSeen();
    expect.soft((await box(page, '.stage')).y, `${place}: the picture stays`).toBe(picture.y);
    return found.type;
}

/** In Links: the list can be scrolled to, and shows where each link leads. */
async function checkLinkList(person: Visitor): Promise<void> {
    const links = person.page.locator('links-pane .fields select');
    for (const link of [links.first(), links.last()]) await link.click({ trial: true });
    expect.soft((await box(person.page, 'links-pane .fields select')).width, 'link').toBeGreaterThan(WORD_PX);
}

/** On a screen as low as a phone that lies under its browser's bars, or a page at 400 %: nothing is out of reach. */
async function checkLow(person: Visitor): Promise<void> {
    const { page } = person;
    for (const area of ['Steps', 'Links'] as const) {
        await person.open(area);
        for (const [width, height] of [
            [640, 290],
            [480, 270],
            [320, 256],
        ] as const) {
            await page.setViewportSize({ width, height });
            expect.soft((await box(page, '.area:not([hidden])')).height, `${area}, ${width} x ${height}`).toBeGreaterThan(ROW_PX);
            await page.locator('action-bar').getByRole('button', { name: 'Stop' }).click({ trial: true });
        }
    }
}

/** Forced colours take grounds away. What differs by its ground alone differs all the same. */
async function checkForcedColours(person: Visitor): Promise<void> {
    const { page } = person;
    await page.emulateMedia({ forcedColors: 'active' });
    for (const [area, ...kinds] of [
        ['Steps', '.sources button', 'step-row .pick', 'time-line .way'],
        ['Curves', '.joint-chips button', 'curves-pane .legend li'],
        ['Motions', 'page-card:not(.empty)'],
    ] as const) {
        await person.open(area);
        for (const kind of kinds) {
            await page.locator(kind).first().waitFor();
            const grounds = await page
                .locator(kind)
                .evaluateAll(all => all.map(one => [null, '::before'].map(part => getComputedStyle(one, part).backgroundColor).join()));
            expect.soft(new Set(grounds).size, `forced colours: ${kind}`).toBeGreaterThan(1);
        }
    }
}

test('one row of head, no word cut, at most five sizes of type and one blue button in every area, letters of 12 px or more in the terminal, which fills the screen', async () => {
    const person = await suite.come({ screen: DESKTOP, hasPython: true });
    const { page } = person;
    const tools = await page.context().newCDPSession(page);
    await person.untilStanding();
    for (const [name, screen] of Object.entries<Screen>({ DESKTOP, DESKTOP_AT_200, PHONE, LYING, TABLET })) {
        await tools.send('Emulation.setTouchEmulationEnabled', { enabled: screen.hasTouch === true });
        await page.setViewportSize(screen);
        await person.untilSeen();
        expect(await page.evaluate(() => matchMedia('(pointer: coarse)').matches)).toBe(screen.hasTouch === true);
        expect((await box(page, 'app-shell > header')).height, name).toBeLessThanOrEqual(ROW_PX);
        if (screen === DESKTOP) expect((await box(page, 'action-bar')).height, 'the bar of motions').toBeLessThanOrEqual(ROW_PX);
        await checkArrangement(person, screen);
        const type = new Set<number>();
        for (const area of AREAS) {
            await person.open(area);
            for (const px of await checkArea(person, screen, `${name}, ${area}`)) type.add(px);
            if (area === 'Links') await checkLinkList(person);
            if (screen === DESKTOP) expect.soft(await misnamed(page), area).toEqual([]);
        }
        expect([...type].length, `${name}: ${[...type].join()}`).toBeLessThanOrEqual(5);
        expect(Math.min(...type), name).toBeGreaterThanOrEqual(LEAST_TYPE_PX);
        await person.open('Terminal');
        const letters = page.locator('terminal-pane .xterm-rows');
        await expect
            .poll(() => letters.evaluate(rows => parseFloat(getComputedStyle(rows).fontSize)))
            .toBeGreaterThanOrEqual(LEAST_TYPE_PX);
        await person.button('Full screen').click();
        await expect.poll(() => box(page, 'terminal-pane')).toEqual({ x: 0, y: 0, width: screen.width, height: screen.height });
        await page.evaluate(() => document.exitFullscreen());
        if (screen === DESKTOP_AT_200) await checkLow(person);
    }
    await person.leave();
});

test('in every language the head is one row, as are the tabs of all areas, none cut, beside the picture; on a phone Stop stands beside Play in Steps', async () => {
    const person = await suite.come({
        screen: PHONE,
        before: page => page.addInitScript(() => localStorage.setItem('motion512.all-areas', '1')),
    });
    const { page } = person;
    for (const language of Object.keys(LANGUAGES)) {
        await page.goto(`${suite.address}?lang=${language}`);
        await page.locator('#tab-steps').click();
        for (const { width, height } of BESIDE) {
            await page.setViewportSize({ width, height });
            await person.untilSeen();
            const { height: head } = await box(page, 'app-shell > header');
            expect.soft(head, `${language}, ${width} x ${height}: head`).toBeLessThanOrEqual(ROW_PX);
            const tops = await page.getByRole('tab').evaluateAll(tabs => tabs.map(tab => tab.getBoundingClientRect().top));
            expect.soft([tops.length, new Set(tops).size], `${language}, ${width} x ${height}`).toEqual([AREAS.length, 1]);
            expect.soft((await page.evaluate(look)).cut, `${language}, ${width} x ${height}: cut`).toEqual([]);
        }
        await page.setViewportSize(PHONE);
        const [, play, stop] = await page
            .locator('#area-steps page-head button')
            .evaluateAll(all => all.map(one => one.getBoundingClientRect().top));
        expect.soft(stop, `${language}: Stop`).toBe(play);
    }
    await person.leave();
});

test('on a tablet and a phone: the robot stands as high over the bar of motions when its rows have come as when the screen was turned and back; nothing that is written over the picture covers its face; the Tour leaves the hand free', async () => {
    const person = await suite.come({ hasPicture: true, screen: TABLET, isNew: true });
    const { page } = person;
    await person.untilStanding();
    await page.getByText('A humanoid with real firmware').waitFor();
    await person.untilStill();
    const { y } = await person.placeOf('right_foot_front');
    await page.setViewportSize({ width: TABLET.height, height: TABLET.width });
    await person.untilSeen();
    await page.setViewportSize(TABLET);
    await expect.poll(async () => (await person.placeOf('right_foot_front')).y).toBeCloseTo(y, 0);

    const screens = [TABLET, LYING, PHONE];
    await checkInSight(person, screens, ['face']);
    // Bar and camera keep moving: the sentence about physics comes and goes, which makes the picture lower, and the robot's motions make
    // the bar higher.
    for (const foot of ['right_foot_front', 'left_foot_front']) {
        const aboveBar = async (): Promise<number> => (await box(page, 'action-bar')).y - (await person.placeOf(foot)).y;
        await expect.poll(aboveBar, { message: foot }).toBeGreaterThan(FOOT_PX);
    }
    await person.open('Steps');
    await page.getByText(/^Balance: /).waitFor();
    await checkInSight(person, screens, ['face']);
    await person.open('Curves');
    await person.button('Right arm').click(); // nothing covers this button either
    await page.getByRole('spinbutton', { name: /right elbow/ }).waitFor();
    await checkInSight(person, screens, ['face']);
    await page.setViewportSize({ width: 360, height: 640 });
    await person.button('Right leg').click();
    const fields = page.locator('pose-bar').getByRole('spinbutton');
    expect(await fields.count()).toBe(6);
    for (const field of await fields.all()) await field.click({ trial: true }); // not under the bar of motions
    await page.setViewportSize(PHONE);

    await person.button('Tour').click();
    await person.button('Start').click();
    const card = page.getByRole('region', { name: 'Tour' });
    for (const stop of [3, 4, 5]) {
        await person.button('Next').click();
        await page.getByText(new RegExp(`: ${stop} of`)).waitFor({ state: 'attached' });
    }
    await card.getByText('Take the right hand').waitFor();
    const sheet = await box(page, 'tour-card');
    expect(sheet.height).toBeLessThanOrEqual(TOUR_PX);
    // Not over the bar below, which says what the robot refuses.
    const statusTop = async (): Promise<number> => (await box(page, 'status-bar')).y;
    expect(sheet.y + sheet.height).toBeCloseTo(await statusTop(), 0);
    // The ring moves with the hand, which the camera still follows.
    const ringAboveBar = async (): Promise<number> => {
        const ring = await box(page, '.tour-ring');
        return (await box(page, 'action-bar')).y - ring.y - ring.height;
    };
    await expect.poll(ringAboveBar).toBeGreaterThan(0);
    await person.leave();
});

/** The part of an address that sends the bow. */
async function bowLink(): Promise<string> {
    const page = await suite.browser.newPage();
    await page.goto(`${suite.address}motions.html`);
    const address = await page.getByRole('link', { name: /^Bow/ }).getAttribute('href');
    await page.close();
    return new URL(address ?? '', suite.address).hash;
}

/** In the browser: the buttons below the picture that something else lies on. */
function coveredActions(): (string | null)[] {
    const buttons = [...document.querySelectorAll<HTMLElement>('action-bar > *')].filter(button =>
        button.checkVisibility({ visibilityProperty: true }),
    );
    return buttons
        .filter(button => {
            const { left, top, width, height } = button.getBoundingClientRect();
            return [0.1, 0.5, 0.9].some(part => !button.contains(document.elementFromPoint(left + width / 2, top + height * part)));
        })
        .map(button => button.textContent);
}

/** In the browser: whether a finger reaches the middle of the button Stop below the picture. */
function isStopFree(): boolean {
    const { left, top, width, height } = document.querySelector('action-bar .stop')?.getBoundingClientRect() ?? new DOMRect();
    const there = document.elementFromPoint(left + width / 2, top + height / 2);
    return there !== null && there.closest('action-bar .stop') !== null;
}

/** At each stop of the tour the button Stop is free, and the card is below the head. */
async function checkTourOn(person: Visitor, screen: Screen): Promise<void> {
    const { page } = person;
    await page.setViewportSize(screen);
    await page.getByRole('button', { name: DE.tour.tour, exact: true }).click();
    const next = page.locator('tour-card .row button:not(.back)').nth(1);
    for (let title = ''; title !== DE.tour.title(14, 14); await next.click()) {
        await person.untilSeen();
        title = (await page.locator('tour-card h2').textContent()) ?? '';
        const where = `${title}, ${screen.width} x ${screen.height}`;
        expect.soft(await page.evaluate(isStopFree), where).toBe(true);
        const [head, card] = [await box(page, 'app-shell > header'), await box(page, 'tour-card')];
        expect.soft(card.y, where).toBeGreaterThanOrEqual(head.y + head.height);
    }
}

test('the cards over the picture leave Stop and the other buttons free, in a language with long words and beside narrow areas', async () => {
    const person = await suite.come({ screen: DESKTOP, isNew: true }, `${suite.address}?lang=de${await bowLink()}`);
    const { page } = person;
    const widths = [1920, 1440, 1366, 1280, 1200, 1100, 1024, 920];
    const isFree = async (card: string): Promise<void> => {
        for (const width of widths) {
            await page.setViewportSize({ width, height: 800 });
            await page.locator(card).waitFor();
            expect(await page.evaluate(coveredActions), `${card} at ${width}`).toEqual([]);
            const [stage, areas] = [await box(page, '.stage'), await box(page, '.areas')];
            const cardBox = await box(page, card);
            expect([stage.x + stage.width, cardBox.x + cardBox.width < areas.x], `${card} at ${width}`).toEqual([areas.x, true]);
        }
    };
    await isFree('sent-card');
    await page.getByRole('button', { name: DE.tour.tour, exact: true }).click();
    await page.locator('sent-card').waitFor({ state: 'hidden' });
    await isFree('tour-card');
    for (const screen of [PHONE, LYING]) await checkTourOn(person, screen);
    await person.leave();
});

test('the card of a motion that was sent leaves the robot in sight, on small screens too', async () => {
    const person = await suite.come({ hasPicture: true, screen: PHONE, isNew: true }, `${suite.address}${await bowLink()}`);
    await person.page.getByRole('region', { name: 'A motion for you' }).waitFor();
    await person.untilDoing(/^Playing motion 2 \(bow\)/);
    await person.untilStanding();
    await checkInSight(person, [DESKTOP_AT_200, LYING, PHONE], ['face', 'chest', 'right_knee', 'left_foot_front']);
    await person.leave();
});

test('nothing over the picture covers the hand that is dragged, wherever it goes; no ghost stands before it; forced colours leave what is chosen to be seen', async () => {
    const person = await suite.come({ hasPicture: true, screen: DESKTOP });
    const { page } = person;
    await person.untilStanding();
    await person.open('Motions');
    await page.getByRole('option', { name: /^motion 2 bow/ }).click();
    await person.open('Steps');
    const view = page.locator('robot-view');
    const hand = await person.placeOf('right_hand');
    const stage = await box(page, '.stage');
    await page.mouse.move(hand.x, hand.y);
    await page.mouse.down();
    const covering: string[] = [];
    for (const [x, y] of [
        [0.05, 0.12],
        [0.3, 0.06],
        [0.5, 0.3],
        [0.9, 0.06],
        [0.1, 0.95],
        [0.5, 0.96],
        [0.9, 0.94],
    ] as const) {
        const at = { x: stage.x + x * stage.width, y: stage.y + y * stage.height };
        await page.mouse.move(at.x, at.y);
        await person.untilSeen();
        covering.push(...(await textsOver(page, at)));
        await expect.poll(() => view.evaluate(element => (element as unknown as { hasGhost: boolean }).hasGhost)).toBe(false);
    }
    expect(covering).toEqual([]);
    const elbow = await person.inPage(({ editor }) => editor.page(2).steps[0]?.positions[5]);
    await page.locator('.joint-label').getByText(`5 right elbow: ${elbow}`, { exact: true }).waitFor(); // not the value before the drag
    await page.mouse.up();
    await person.button('Walk').waitFor(); // everything is back
    await checkForcedColours(person);
    await person.leave();
});
