// SPDX-License-Identifier: MIT
// The editor as a pupil uses it: a motion taught by hand, the tour, the curves. Time-outs are long, because a busy computer is slow.
import { expect, test } from 'vitest';
import type { Visitor } from './page-bench.ts';
import { SHOTS, pageSuite } from './page-suite.ts';

const PATIENT = { timeout: 240_000 };
const suite = pageSuite();

/** The servos of the right arm. */
const ARM = [1, 3, 5];

const farthest = (a: readonly number[], b: readonly number[]): number =>
    Math.max(...a.map((position, i) => Math.abs(position - (b[i] ?? 0))));

/** Moves the mouse until the hand lights up under it. */
async function pointAtHand(visitor: Visitor): Promise<{ x: number; y: number }> {
    const label = visitor.page.locator('robot-view .joint-label');
    for (let i = 0; i < 40; i++) {
        const at = await visitor.placeOf('right_hand');
        await visitor.page.mouse.move(at.x, at.y);
        if (/right elbow/.test((await label.textContent()) ?? '') && (await label.isVisible())) return at;
        await visitor.page.waitForTimeout(300);
    }
    throw new Error('the hand never lights up under the mouse');
}

async function dragHand(visitor: Visitor, dx: number, dy: number): Promise<void> {
    const before = await visitor.positions(ARM);
    const from = await pointAtHand(visitor);
    await visitor.page.mouse.down();
    await visitor.page.mouse.move(from.x + dx / 2, from.y + dy / 2);
    await visitor.page.mouse.move(from.x + dx, from.y + dy);
    await expect.poll(async () => farthest(await visitor.positions(ARM), before), PATIENT).toBeGreaterThan(30); // 9 degrees: it followed
    await visitor.page.mouse.up();
    await visitor.page.getByRole('status', { name: 'Teaching' }).filter({ hasText: 'it holds when you let go' }).waitFor();
}

const steps = (visitor: Visitor) => visitor.page.getByRole('button', { name: /^Step \d$/ });
const addStep = (visitor: Visitor) => visitor.button('Add step from the robot').click();

/** Waits until the tour shows this text. */
const said = (visitor: Visitor, text: string | RegExp) =>
    visitor.page.getByRole('status', { name: 'Tour' }).filter({ hasText: text }).waitFor(PATIENT);

/** Robot time in seconds. */
const robotSeconds = async (visitor: Visitor): Promise<number> =>
    Number.parseFloat((await visitor.page.locator('robot-pane .clock').textContent()) ?? '0');

/** The hand up beside the head, out to the side, up again. */
const WAVES = [
    [-60, -190],
    [-70, 80],
    [60, -90],
] as const;

test('a pupil, by the tour: teaches a page by hand, names it, the firmware plays it; undo takes each thing back', async () => {
    const pupil = await suite.come({ hasPicture: 'drawn', hasPhysics: true, screen: { width: 1280, height: 800 } });
    await pupil.untilStanding();
    await pupil.button('Tour').click();
    await said(pupil, 'You will teach the robot to wave.');
    await pupil.button('Start').click();
    await said(pupil, 'Open it.');
    await pupil.open('Steps');
    await said(pupil, 'Press "Right arm"');
    await pupil.button('Right arm').click();
    for (const [i, [dx, dy]] of WAVES.entries()) {
        await said(pupil, /(Take the right|Drag the) hand/);
        await dragHand(pupil, dx, dy);
        await said(pupil, /^(Press "Add step|Add this pose)/);
        if (i === 1) {
            await pupil.page.screenshot({ path: `${SHOTS}tour.png` }); // used in the README
            await pupil.stopDrawing();
        }
        await addStep(pupil);
        await expect.poll(() => steps(pupil).count(), PATIENT).toBe(i + 1);
    }
    await said(pupil, 'Give it a name');
    const name = pupil.page.getByRole('textbox', { name: 'Name of the motion' });
    await name.fill('hello');
    await name.press('Enter');
    await said(pupil, 'One wave is not enough');
    const times = pupil.page.getByRole('spinbutton', { name: 'Times', exact: true });
    await times.fill('2');
    await times.press('Enter');
    await pupil.button('Hold').click();
    await pupil.page.getByRole('status', { name: 'Teaching' }).filter({ hasText: 'All joints hold.' }).waitFor(PATIENT);
    const lifted = await pupil.positions(ARM);
    await said(pupil, 'Press "Play"');
    await pupil.button('▶ Play').click();
    await pupil.doing.filter({ hasText: /Playing motion \d+ \(hello\)/ }).waitFor(PATIENT);
    const begunS = await robotSeconds(pupil);
    await said(pupil, 'That is your first motion');
    await pupil.untilStanding();
    // At most two minutes to the first wave. A person who reads needs 4 s for a click and 8 s for a drag, a name or a number. The rest is
    // robot time since Edit started.
    expect(11 * 4 + 5 * 8 + begunS).toBeLessThan(120);
    expect(farthest(await pupil.positions(ARM), lifted)).toBeLessThan(25); // where the hand had put it
    await pupil.open('Motions');
    await pupil.page.getByRole('option', { name: /^motion 2 bow/ }).click(); // only to look at it
    await pupil.open('Steps');
    await pupil.button('Send it to a friend').click();
    expect(await name.inputValue()).toBe('hello');
    expect(await pupil.page.getByRole('textbox', { name: 'Link' }).inputValue()).toContain('#'); // opened by a friend: files.test.ts
    await pupil.page.keyboard.press('Escape');
    await pupil.button('Done').click();
    for (const left of [3, 3, 2, 1, 0]) {
        await pupil.page.getByRole('button', { name: /^Undo:/ }).click();
        await expect.poll(() => steps(pupil).count()).toBe(left);
    }
    expect(await name.inputValue()).toBe('');
    await pupil.leave();
}, 900_000);
