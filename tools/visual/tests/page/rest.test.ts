// SPDX-License-Identifier: MIT
// The picture of a robot that stands still asks the browser for no frame and draws nothing. Every change that can be seen is drawn.
import { expect, test } from 'vitest';
import type { Visitor } from './page-bench.ts';
import { pageSuite } from './page-suite.ts';

const suite = pageSuite();

interface Count {
    frames: number;
    draws: number;
}

type Counting = { picture: Count };

/** In the browser: counts the frames that are asked for, and what WebGL draws. */
function count(): void {
    const picture = { frames: 0, draws: 0 };
    Object.assign(window, { picture });
    const ask = window.requestAnimationFrame.bind(window);
    window.requestAnimationFrame = call => {
        picture.frames++;
        return ask(call);
    };
    const { prototype } = WebGL2RenderingContext;
    const draw = prototype.drawElements as (this: WebGL2RenderingContext, ...values: [number, number, number, number]) => void;
    prototype.drawElements = function (this: WebGL2RenderingContext, ...values) {
        picture.draws++;
        draw.apply(this, values);
    };
}

const counted = (person: Visitor): Promise<Count> => person.page.evaluate(() => ({ ...(window as unknown as Counting).picture }));

/** What a second of a robot that stands still costs. */
async function inASecond(person: Visitor): Promise<Count> {
    await person.untilStill();
    const before = await counted(person);
    await person.robotSeconds(1);
    const after = await counted(person);
    return { frames: after.frames - before.frames, draws: after.draws - before.draws };
}

/** Does it, and waits for a picture. */
async function drawnBy(person: Visitor, action: () => Promise<unknown>): Promise<void> {
    await person.untilStill();
    const { draws } = await counted(person);
    await action();
    await expect.poll(async () => (await counted(person)).draws, { timeout: 60_000 }).toBeGreaterThan(draws);
}

const NOTHING: Count = { frames: 0, draws: 0 };

test('a robot that stands still costs nothing; what changes is drawn; the LEDs on its back blink where the camera sees them', async () => {
    const person = await suite.come({ hasPicture: 'drawn', before: page => page.addInitScript(count) });
    const { page } = person;
    await person.untilStanding();
    expect(await inASecond(person)).toEqual(NOTHING);
    const canvas = page.locator('robot-view canvas');
    const box = await canvas.boundingBox();
    const corner = { x: (box?.x ?? 0) + 30, y: (box?.y ?? 0) + (box?.height ?? 0) * 0.4 };

    const hand = await person.placeOf('right_hand');
    await drawnBy(person, () => page.mouse.move(hand.x, hand.y));
    await drawnBy(person, () => page.mouse.move(corner.x, corner.y));
    await drawnBy(person, async () => {
        await page.mouse.down();
        await page.mouse.move(corner.x + 5, corner.y + 40, { steps: 3 });
        await page.mouse.up();
    });
    await drawnBy(person, () => page.mouse.wheel(0, 120));
    await drawnBy(person, () => canvas.press('PageUp')); // the camera stays before the robot, so that its LEDs are hidden
    await drawnBy(person, () => page.emulateMedia({ colorScheme: 'dark' }));
    await drawnBy(person, () => page.setViewportSize({ width: 1180, height: 760 }));
    await drawnBy(person, () =>
        page.locator('robot-view').evaluate(view => (view as unknown as { tilt(front: number, left: number): void }).tilt(0.05, 0)),
    );
    for (const change of ['forceContextLoss', 'forceContextRestore'] as const) {
        const force = (): Promise<void> =>
            page.locator('robot-view').evaluate((view, name) => {
                type View = { scene: { renderer: Record<'forceContextLoss' | 'forceContextRestore', () => void> } };
                (view as unknown as View).scene.renderer[name]();
            }, change);
        if (change === 'forceContextLoss') await force();
        else await drawnBy(person, force);
    }
    await drawnBy(person, async () => {
        await person.open('Steps');
        await page.getByRole('combobox', { name: 'Motion', exact: true }).selectOption('3');
    });
    await drawnBy(person, () => canvas.press('ArrowRight'));
    await drawnBy(person, () => canvas.press('ArrowUp'));
    await drawnBy(person, () => page.getByRole('button', { name: 'Step 3', exact: true }).click());
    await drawnBy(person, () => person.open('Remote'));
    expect(await inASecond(person)).toEqual(NOTHING);
    for (let i = 0; i < 26; i++) await canvas.press('Shift+ArrowRight'); // half round it
    await drawnBy(person, () => Promise.resolve()); // the page asks the robot three times a second
    await drawnBy(person, () => person.button('Walk').click());
    person.faults.splice(0); // the lost context is told
    await person.leave();
});
