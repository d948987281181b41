// SPDX-License-Identifier: MIT
// What people do with the robot in the page, as they do it: mouse and keyboard, found by what stands on things.
import { expect, test } from 'vitest';
import { Visitor } from './page-bench.ts';
import { SHOTS, pageSuite } from './page-suite.ts';

const LIES = 'The robot lies on the floor.';
const suite = pageSuite();

test('a pupil: it stands, walks while the keys light up, is pushed over, gets up and stands again', async () => {
  const pupil = await Visitor.come(suite.browser, suite.address, 'light', 2);
  await pupil.untilStanding();
  await expect(pupil.button('Get up').isDisabled()).resolves.toBe(true); // it stands
  const walk = pupil.page.locator('way-list li').filter({ hasText: /^▲\s*walk$/ });
  await pupil.page.keyboard.down('ArrowUp');
  await walk.and(pupil.page.locator('.lit')).or(pupil.page.locator('way-list.playing')).first().waitFor();
  await pupil.doing.filter({ hasText: /Playing page 2[12] \(walk_/ }).waitFor();
  await pupil.page.keyboard.up('ArrowUp');
  await pupil.page.getByText(/walk_[rl] plays/).waitFor();
  await pupil.page.screenshot({ path: `${SHOTS}page.png`, scale: 'css' }); // stands in the README
  await pupil.button('Stop').click();
  await pupil.untilStanding();
  await pupil.open('Lab');
  await pupil.button('Push ahead').click();
  await pupil.doing.filter({ hasText: /^The robot lies on the floor. Press Get up.$/ }).waitFor();
  await pupil.button('Get up').click();
  await pupil.doing.filter({ hasText: /\((pushups_up|up_to_seat|up_from_seat)\)/ }).waitFor();
  await pupil.untilStanding();
  await pupil.leave();
});

test('what fell is put on its feet by a hand, too', async () => {
  const person = await Visitor.come(suite.browser, suite.address);
  await person.untilStanding();
  await person.open('Lab');
  await person.button('Push back').click();
  await person.doing.filter({ hasText: LIES }).waitFor();
  await person.button('Put on its feet').click();
  await person.doing.filter({ hasText: 'A hand holds the robot.' }).waitFor();
  await person.doing.filter({ hasNotText: 'lies' }).waitFor();
  await person.button('Let go').click();
  await person.untilStanding();
  await person.leave();
});

test('somebody who debugs: Edit in the terminal, a page saved, and the browser keeps it over a reload', async () => {
  const person = await Visitor.come(suite.browser, suite.address);
  await person.untilStanding();
  await person.open('Lab');
  await person.button('Run Edit').click();
  await person.open('Terminal');
  await person.untilScreenSays('PageNumber');
  await person.type('page 100\r');
  await person.untilScreenSays('PageNumber:0100');
  await person.type('name salute\r');
  await person.untilScreenSays('salute');
  await person.untilScreenSays(/\* unsaved/);
  await person.type('save\r');
  await expect.poll(async () => (await person.screen()).includes('* unsaved'), { timeout: 60_000 }).toBe(false);
  await person.page.waitForTimeout(3000); // the page keeps the memory 0.3 s after the last write
  await person.page.reload();
  await person.untilStanding();
  await person.open('Terminal');
  await person.type('list\r');
  await person.untilScreenSays(/100.*salute/);
  await person.leave();
});

test('a broken servo: the firmware says so, the page shows it', async () => {
  const person = await Visitor.come(suite.browser, suite.address, 'dark');
  await person.untilStanding();
  await person.open('Lab');
  await person.page.getByLabel('Fault of servo 5', { exact: true }).selectOption('does not answer');
  await person.button('Bow').click();
  await person.page.getByRole('log', { name: 'Last message' }).filter({ hasText: /servos? 5\b/i }).waitFor();
  await person.page.screenshot({ path: `${SHOTS}lab-dark.png` });
  await person.leave();
});

test('time: slow, paused, tick by tick', async () => {
  const person = await Visitor.come(suite.browser, suite.address);
  await person.untilStanding();
  await person.open('Lab');
  const clock = person.page.locator('lab-pane .clock');
  const seconds = async (): Promise<number> => Number.parseFloat(await clock.innerText());
  await person.button('Pause').click();
  await person.page.waitForTimeout(300);
  const stands = await seconds();
  await person.page.waitForTimeout(700);
  expect(await seconds()).toBe(stands);
  for (let i = 0; i < 8; i++) await person.button('One tick').click();
  await person.page.waitForTimeout(400);
  expect(await seconds()).toBeCloseTo(stands + 8 / 128, 0);
  await person.button('real time').click();
  await expect.poll(seconds, { timeout: 120_000 }).toBeGreaterThan(stands + 1);
  await person.leave();
});

/** Where in the picture a part of the robot is, found as a person does: by looking what lights up under the mouse. */
async function find(visitor: Visitor, title: RegExp): Promise<{ x: number; y: number }> {
  const box = await visitor.page.getByRole('img', { name: 'The robot' }).boundingBox();
  const label = visitor.page.locator('robot-view .joint-label');
  for (let row = 4; box && row < 14; row++) {
    for (let column = 4; column < 16; column++) {
      const at = { x: box.x + (box.width * column) / 20, y: box.y + (box.height * row) / 20 };
      await visitor.page.mouse.move(at.x, at.y);
      if (title.test((await label.textContent()) ?? '') && (await label.isVisible())) return at;
    }
  }
  throw new Error(`nothing in the picture is called ${title}`);
}

test('a hand: the mouse takes an arm and pulls it out of its place; let go, it goes back', async () => {
  const person = await Visitor.come(suite.browser, suite.address);
  await person.untilStanding();
  const elbow = (): Promise<number> => person.page.evaluate(() => new Promise<number>((resolve) => {
    type Frame = { servos: { id: number; position: number }[] };
    const { desk } = document.querySelector('app-shell') as unknown as { desk: { onFrame(l: (s: Frame) => void): () => void } };
    const stop = desk.onFrame((state) => {
      stop();
      const at = (id: number): number => state.servos.find((servo) => servo.id === id)?.position ?? 0;
      resolve(Math.abs(at(1) - 512) + Math.abs(at(3) - 512) + Math.abs(at(5) - 512));
    });
  }));
  const arm = await find(person, /right elbow/);
  const rest = await elbow();
  await person.page.mouse.down();
  await person.page.mouse.move(arm.x - 90, arm.y - 60, { steps: 8 });
  await expect.poll(async () => Math.abs((await elbow()) - rest), { timeout: 120_000 }).toBeGreaterThan(4);
  await person.page.mouse.up();
  await expect.poll(async () => Math.abs((await elbow()) - rest), { timeout: 120_000 }).toBeLessThan(4); // a stiff limb goes back
  await person.leave();
});
