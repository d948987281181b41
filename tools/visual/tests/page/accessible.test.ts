// SPDX-License-Identifier: MIT
// axe-core finds nothing serious in any area, light and dark; and a motion is made by keyboard alone.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { expect, test } from 'vitest';
import { Visitor } from './page-bench.ts';
import { pageSuite } from './page-suite.ts';

const WIDE = { width: 1280, height: 800 };
const PATIENT = { timeout: 240_000 };
const AREAS = ['Remote', 'Steps', 'Curves', 'Pages', 'Links', 'Checks', 'Terminal', 'Lab'] as const;
const suite = pageSuite();
/** Serious and critical findings: "rule: element". contrast: of contrast alone. */
async function findings(visitor: Visitor, contrast: boolean): Promise<string[]> {
  return visitor.page.evaluate(async (onlyContrast) => {
    type Found = { id: string; impact: string; nodes: { target: string[]; failureSummary: string }[] };
    const { axe } = globalThis as unknown as { axe: { run(options: object): Promise<{ violations: Found[] }> } };
    const { violations } = await axe.run(onlyContrast ? { runOnly: ['color-contrast'] } : {});
    return violations.filter(({ impact }) => impact === 'serious' || impact === 'critical')
      .flatMap(({ id, nodes }) => nodes.map(({ target, failureSummary }) => `${id}: ${target.join(' ')} ${failureSummary}`));
  }, contrast);
}

test('no serious finding in any area; in the dark the contrast holds too', async () => {
  const source = await readFile(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
  const person = await Visitor.come(suite.browser, suite.address, 'light', 1, WIDE);
  await person.untilStanding();
  await person.page.evaluate(source);
  const found: string[] = [];
  for (const isDark of [false, true]) {
    for (const area of isDark ? AREAS.slice(1, 4) : AREAS) {
      await person.open(area);
      found.push(...(await findings(person, isDark)).map((what) => `${area}${isDark ? ', dark' : ''}: ${what}`));
    }
    await person.button('Light or dark').click();
  }
  await person.button('Tour').click();
  await person.page.getByRole('button', { name: 'Keys' }).click();
  found.push(...(await findings(person, false)).map((what) => `Tour and keys: ${what}`));
  expect(found).toEqual([]);
  await person.leave();
}, 600_000);

test('by keyboard alone: a page of two steps, a joint turned, one moved, mirrored, undone', async () => {
  const person = await Visitor.come(suite.browser, suite.address, 'light', 1, WIDE);
  const { keyboard } = person.page;
  const focused = (): Promise<string> => person.page.evaluate(() => document.activeElement?.getAttribute('aria-label') ?? document.activeElement?.textContent ?? '');
  const tabTo = async (name: string): Promise<void> => {
    for (let i = 0; i < 120 && (await focused()) !== name; i++) await keyboard.press('Tab');
    expect(await focused()).toBe(name);
  };
  const steps = person.page.getByRole('button', { name: /^Step \d$/ });
  await person.untilStanding();
  await tabTo('Remote');
  await keyboard.press('ArrowRight');
  await expect.poll(focused).toBe('Steps');
  await tabTo('New page');
  await keyboard.press('Enter');
  await expect.poll(focused).toBe('Name of the page');
  await keyboard.type('nod');
  await keyboard.press('Enter');
  await tabTo('Add step from the robot');
  await keyboard.press('Enter');
  await expect.poll(() => steps.count(), PATIENT).toBe(1);
  await tabTo('Step 1');
  await keyboard.press('d');
  await expect.poll(() => steps.count()).toBe(2);
  await tabTo('The robot');
  for (const key of ['ArrowRight', 'ArrowRight', 'ArrowRight', 'Shift+ArrowUp', 'Shift+ArrowUp']) await keyboard.press(key);
  const chosen = person.page.getByRole('group', { name: 'Chosen joints' }).getByRole('spinbutton');
  await expect.poll(() => chosen.count()).toBe(1);
  const turned = Number(await chosen.inputValue());
  await keyboard.press('Control+z');
  await expect.poll(async () => Number(await chosen.inputValue())).toBe(turned - 10);
  await keyboard.press('Control+y');
  await expect.poll(async () => Number(await chosen.inputValue())).toBe(turned);
  await tabTo('Step 2');
  await keyboard.press('Alt+ArrowLeft');
  await expect.poll(focused).toBe('Step 1');
  await keyboard.press('x');
  await keyboard.press('ArrowRight');
  await expect.poll(focused).toBe('Step 2');
  await keyboard.press('Delete');
  await expect.poll(() => steps.count()).toBe(1);
  await keyboard.press('?');
  await person.page.getByRole('dialog', { name: 'Keys' }).waitFor();
  await keyboard.press('Escape');
  await person.leave();
}, 600_000);
