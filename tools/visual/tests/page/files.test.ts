// SPDX-License-Identifier: MIT
// Files and links, as a person uses them.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { Keyboard } from './keyboard.ts';
import { Visitor } from './page-bench.ts';
import { SHOTS, pageSuite } from './page-suite.ts';

const ROOT = new URL('../../../../', import.meta.url).pathname;
const suite = pageSuite();
let folder: string;

beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'm512-page-'));
});
afterAll(() => rmSync(folder, { recursive: true }));

function convert(from: string, to: string): Buffer {
  const env = { ...process.env, PYTHONPATH: join(ROOT, 'tools/m512/src') };
  execFileSync(join(ROOT, 'build/venv/bin/python'), ['-m', 'm512', 'convert', from, join(folder, to), '--force'], { env, stdio: 'ignore' });
  return readFileSync(join(folder, to));
}

test('a RoboPlus file is opened, looked at, taken over, and saved in every form as m512 does; a damaged one is refused', async () => {
  const person = await Visitor.come(suite.browser, suite.address);
  convert(join(ROOT, 'build/motions/motions.bin'), 'found.mtn');
  const chooser = person.page.getByLabel('Motion file');
  writeFileSync(join(folder, 'torn.mtn'), readFileSync(join(folder, 'found.mtn')).subarray(0, 5000));
  await chooser.setInputFiles(join(folder, 'torn.mtn'));
  await person.page.getByRole('dialog', { name: 'That did not work' }).getByText(/torn\.mtn/).waitFor();
  await person.button('Close').click();

  await chooser.setInputFiles(join(folder, 'found.mtn'));
  const dialog = person.page.getByRole('dialog', { name: 'found.mtn' });
  await dialog.getByText(/^[1-9]\d motion pages/).waitFor();
  await person.page.screenshot({ path: `${SHOTS}opened.png` });
  await dialog.getByRole('button', { name: 'Take them over' }).click();
  await dialog.waitFor({ state: 'hidden' });

  convert(join(folder, 'found.mtn'), 'found.bin');
  for (const suffix of ['.mtn', '.m512', '.bin', '.hex']) {
    const [download] = await Promise.all([person.page.waitForEvent('download'), person.page.getByLabel('Save as a file').selectOption(suffix)]);
    const saved = readFileSync(await download.path());
    if (suffix === '.mtn') await person.button('Understood').click(); // it says what the form cannot hold: unused bytes at least
    expect(download.suggestedFilename()).toBe(`My motions${suffix}`);
    const wanted = convert(join(folder, 'found.bin'), `wanted${suffix}`);
    // Page 0 is this robot's own trim; the file brought none.
    if (suffix === '.bin') expect(saved.subarray(512).equals(wanted.subarray(512)), suffix).toBe(true);
    else expect(saved.length, suffix).toBeGreaterThan(1000);
    writeFileSync(join(folder, `again${suffix}`), saved);
  }
  expect(readFileSync(join(folder, 'again.mtn')).equals(convert(join(folder, 'again.bin'), 'again2.mtn'))).toBe(true);
  expect(readFileSync(join(folder, 'again.m512')).equals(convert(join(folder, 'again.bin'), 'again2.m512'))).toBe(true);
  expect(readFileSync(join(folder, 'again.hex')).equals(convert(join(folder, 'again.bin'), 'again2.hex'))).toBe(true);
  await person.leave();
});

test('a teacher sends a motion as a link; a pupil adds it by keyboard', async () => {
  const teacher = await Visitor.come(suite.browser, suite.address);
  await teacher.open('Pages');
  await teacher.page.getByRole('option', { name: /^page 2 bow/ }).click();
  await teacher.button('Send as link').click();
  const link = await teacher.page.getByRole('textbox', { name: 'Link' }).inputValue();
  expect(link.length).toBeLessThan(2000);
  await teacher.leave();

  const pupil = await Visitor.come(suite.browser, link);
  await pupil.page.getByRole('dialog', { name: 'A motion for you' }).waitFor();
  await pupil.untilStanding();
  const keys = new Keyboard(pupil);
  await keys.at('Add it and play');
  await keys.press('Enter');
  await keys.at('Steps');
  await pupil.doing.filter({ hasText: /Playing page \d+ \(bow\)/ }).waitFor();
  expect(new URL(pupil.page.url()).hash).toBe('');
  await pupil.leave();
});
