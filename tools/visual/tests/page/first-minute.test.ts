// SPDX-License-Identifier: MIT
// A first visit: one sentence and three buttons that do what they say, however early they are pressed; two areas and "More".
import { expect, test } from 'vitest';
import type { Visitor } from './page-bench.ts';
import { pageSuite } from './page-suite.ts';

const suite = pageSuite();
const first = (person: Visitor) => person.page.getByRole('region', { name: 'What to do first' });
const tabs = (person: Visitor) =>
    person.page.getByRole('tab').evaluateAll(all => all.filter(one => one.checkVisibility()).map(one => one.textContent));

test('"Walk it" before the robot stands makes it walk; the buttons do not come back; "More" brings all areas for good', async () => {
    const person = await suite.come({ isNew: true });
    await first(person).getByText('A humanoid with real firmware, in your browser').waitFor();
    expect(await tabs(person)).toEqual(['Remote', 'Steps']);
    await person.button('Walk it').click();
    await first(person).waitFor({ state: 'hidden' });
    await person.untilDoing(/Playing motion 2[0-2] \(walk/);
    await person.button('More').click();
    expect(await tabs(person)).toEqual(['Remote', 'Steps', 'Curves', 'Motions', 'Links', 'Checks', 'Terminal', 'Robot']);
    await person.page.reload();
    await person.untilStanding();
    expect(await first(person).isVisible()).toBe(false);
    expect(await tabs(person)).toHaveLength(8);
    await person.leave();
});

test('"Push it" pushes the robot over as soon as the hand has let go of it', async () => {
    const person = await suite.come({ hasPhysics: true, isNew: true });
    await person.button('Push it').click();
    await person.page.getByText('It is pushed as soon as it stands by itself.', { exact: true }).waitFor();
    await person.page.getByText('When it lies, press Get up.', { exact: true }).waitFor(); // now that it was pushed
    await person.untilDoing(/^The robot lies on the floor/);
    await person.leave();
});

test('a game pad that drives puts the buttons away, so that Stop is there', async () => {
    const person = await suite.come({ isNew: true });
    await first(person).waitFor();
    await person.page.evaluate(() => {
        const pad = { index: 0, axes: [0, 0], buttons: Array.from({ length: 16 }, (_, i) => ({ pressed: i === 12 })) };
        navigator.getGamepads = () => [pad as unknown as Gamepad];
        window.dispatchEvent(new Event('gamepadconnected'));
    });
    await first(person).waitFor({ state: 'hidden' });
    await person.untilDoing(/^Playing motion 2[12] \(walk/);
    await person.button('Stop').click();
    await person.untilStanding();
    await person.leave();
});

test('"Teach it to wave" opens Steps and the Tour where the teaching begins; any click elsewhere puts the buttons away', async () => {
    const person = await suite.come({ isNew: true });
    await person.button('Teach it to wave').click();
    await person.page.getByRole('status', { name: 'Tour' }).filter({ hasText: 'Press "Right arm"' }).waitFor();
    expect(await person.page.getByRole('tab', { selected: true }).textContent()).toBe('Steps');
    await person.page.evaluate(() => localStorage.clear());
    await person.page.reload(); // as for the first time
    await first(person).waitFor();
    await person.open('Steps');
    expect(await first(person).isVisible()).toBe(false);
    await person.leave();
});

test('the start page has ten motions with moving pictures, and each of its links is the motion itself, running', async () => {
    const person = await suite.come({ isNew: true }, `${suite.address}motions.html`);
    const { page } = person;
    const cards = page.getByRole('listitem');
    expect(await cards.count()).toBe(10);
    const pictures = await page.locator('img').evaluateAll(all => all.map(one => (one as HTMLImageElement).src));
    expect(new Set(pictures).size).toBe(10);
    for (const address of pictures) {
        const moving = await (await page.request.get(address)).text();
        expect(moving, address).toContain('<animate ');
        expect(await (await page.request.get(address.replace('.svg', '-still.svg'))).text()).not.toContain('<animate ');
    }
    const bow = await page.getByRole('link', { name: /^Bow/ }).getAttribute('href');
    await page.getByRole('link', { name: /^Wave/ }).click();
    await page.getByRole('region', { name: 'A motion for you' }).getByText('“wave”, a motion for you').waitFor();
    await person.untilDoing(/motion 3 \(wave\)/); // the robot already has it, so it is not added
    await person.untilDoing(/^Playing motion 3 \(wave\)/);
    await person.untilStanding();
    // The browser keeps the open page for this link, because only the part after the # changes.
    await page.evaluate(hash => window.location.replace(hash), new URL(bow ?? '', page.url()).hash);
    await page.getByText('“bow”, a motion for you').waitFor();
    await person.untilDoing(/^Playing motion 2 \(bow\)/);
    await person.leave();
});

/** In the software-drawn picture: the brightness of the darkest quarter of its lines (0 to 255), and the number of robot-blue pixels. */
function lookAt(person: Visitor): Promise<{ width: number; darkest: number; blue: number }> {
    return person.page.locator('robot-view canvas').evaluate(canvas => {
        const { width, height } = canvas as HTMLCanvasElement;
        const data = (canvas as HTMLCanvasElement).getContext('2d')?.getImageData(0, 0, width, height).data ?? [];
        const quarters = [0, 0, 0, 0];
        let blue = 0;
        for (let i = 0; i + 3 < data.length; i += 4) {
            const [r = 0, g = 0, b = 0] = [data[i], data[i + 1], data[i + 2]];
            const quarter = Math.floor((4 * i) / data.length);
            quarters[quarter] = (quarters[quarter] ?? 0) + (16 * (r + g + b)) / (3 * data.length);
            if (b > r + 60) blue++;
        }
        return { width, darkest: Math.min(...quarters), blue };
    });
}

test('before the robot is there the picture is an empty room in the light: not black, and nothing sunk into the floor', async () => {
    let go = (): void => undefined;
    const person = await suite.come({
        hasPicture: 'drawn',
        isNew: true,
        before: page =>
            page.route(/board-[^/]*\.wasm/, async route => {
                await new Promise<void>(resolve => (go = resolve));
                await route.continue();
            }),
    });
    await person.page.locator('robot-view canvas').waitFor();
    const { width: unborn, darkest } = await lookAt(person);
    expect(darkest).toBeGreaterThan(150);
    await expect.poll(async () => (await lookAt(person)).width).not.toBe(unborn);
    const room = await lookAt(person);
    expect(room.darkest).toBeGreaterThan(150);
    expect(room.blue).toBe(0);
    go();
    await person.untilStanding();
    expect((await lookAt(person)).blue).toBeGreaterThan(100);
    await person.leave();
});
