// SPDX-License-Identifier: MIT
// Files and links as a person uses them.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Page } from 'playwright-core';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { imageOf, withChanges } from '../../model/document.ts';
import { readPage } from '../../model/page.ts';
import { libraryDocument, makeFormat, must } from '../motion-bench.ts';
import { Keyboard } from './keyboard.ts';
import { pageSuite } from './page-suite.ts';

const ROOT = new URL('../../../../', import.meta.url).pathname;
const suite = pageSuite();
let folder: string;

beforeAll(() => {
    folder = mkdtempSync(join(tmpdir(), 'm512-page-'));
});
afterAll(() => rmSync(folder, { recursive: true }));

function convert(from: string, to: string): Buffer {
    execFileSync(join(ROOT, 'build/venv/bin/python'), ['-m', 'm512', 'convert', from, join(folder, to), '--force'], { stdio: 'ignore' });
    return readFileSync(join(folder, to));
}

const PAGE = 100;
const at = (page: number, step: number, byte: number): number => 512 * page + 64 + 64 * step + byte;
const EASY = 192; // ticks: 1.5 s

/** The library with a motion in page 60 that leans too far, too fast, as a RoboPlus file. */
async function foundOnTheNet(): Promise<void> {
    const { format, edits } = await makeFormat();
    const library = await libraryDocument();
    const [stand] = readPage(format, library.pages[7] ?? new Uint8Array(512)).steps;
    if (!stand) throw new Error('page 7 of the library has no step');
    const lean = {
        ...stand,
        positions: stand.positions.map((position, id) => ({ 3: (stand.positions[3] ?? 512) + 60, 15: 530, 16: 494 })[id] ?? position),
        time: 15,
        pause: 40,
    };
    const filled = withChanges(library, must(edits.insertSteps(library, PAGE, 0, [{ ...stand, time: 60 }, lean])).changes);
    writeFileSync(join(folder, 'library.bin'), imageOf(withChanges(filled, must(edits.rename(filled, PAGE, 'topple')).changes)));
    convert(join(folder, 'library.bin'), 'found.mtn');
}

/** What the person does in the page, done to the bytes: step 2 takes 1.5 s, and its left side mirrors the right. */
function changed(image: Buffer): Buffer {
    const bytes = Buffer.from(image);
    bytes[at(PAGE, 1, 63)] = EASY;
    for (let right = 1; right <= 17; right += 2) {
        bytes.writeUInt16LE(Math.min(1024 - bytes.readUInt16LE(at(PAGE, 1, 2 * right)), 1023), at(PAGE, 1, 2 * right + 2));
    }
    bytes[512 * PAGE + 31] = 0;
    bytes[512 * PAGE + 31] = 0xff - (bytes.subarray(512 * PAGE, 512 * (PAGE + 1)).reduce((sum, byte) => sum + byte, 0) & 0xff);
    return bytes;
}

/** Pixels of the curves in the colour of faults. */
function redPixels(page: Page): Promise<number> {
    return page.locator('curve-canvas canvas').evaluate(canvas => {
        const { width, height } = canvas as HTMLCanvasElement;
        const sample = document.createElement('canvas').getContext('2d');
        const context = (canvas as HTMLCanvasElement).getContext('2d');
        if (!sample || !context) return -1;
        sample.fillStyle = getComputedStyle(canvas).getPropertyValue('--bad').trim();
        sample.fillRect(0, 0, 1, 1);
        const [r = 0, g = 0, b = 0] = sample.getImageData(0, 0, 1, 1).data;
        const { data } = context.getImageData(0, 0, width, height);
        let count = 0;
        for (let i = 0; i < data.length; i += 4)
            count += Number(Math.abs((data[i] ?? 0) - r) + Math.abs((data[i + 1] ?? 0) - g) + Math.abs((data[i + 2] ?? 0) - b) < 24);
        return count;
    });
}

test('a hobbyist opens a RoboPlus file found on the net, sees where it is too fast and where it falls, stretches, mirrors, saves it in every form as m512 does', async () => {
    await foundOnTheNet();
    const person = await suite.come({ hasPhysics: 'later', hasPython: true });
    const { page } = person;
    const chooser = page.getByLabel('Motion file');
    const torn = `${'torn'.repeat(40)}.mtn`; // wider than the dialog
    writeFileSync(join(folder, torn), readFileSync(join(folder, 'found.mtn')).subarray(0, 5000));
    await chooser.setInputFiles(join(folder, torn));
    const failed = page.getByRole('dialog', { name: 'That did not work' });
    await failed.getByText(torn).waitFor();
    expect(await failed.evaluate(dialog => dialog.scrollWidth - dialog.clientWidth)).toBe(0);
    await person.button('Close').click();

    await chooser.setInputFiles(join(folder, 'found.mtn'));
    const dialog = page.getByRole('dialog', { name: 'found.mtn' });
    await dialog.getByText(/^[1-9]\d motions/).waitFor();
    const isInside = await dialog.evaluate(box => {
        const left = box.getBoundingClientRect().left;
        return [...box.querySelectorAll('button')].every(button => button.getBoundingClientRect().left > left);
    });
    expect(isInside).toBe(true); // four buttons would be wider than the dialog
    await dialog.getByRole('button', { name: 'Replace all motions' }).click();
    await dialog.waitFor({ state: 'hidden' });

    await person.open('Checks');
    const findings = page.getByRole('list', { name: 'Findings' }).getByRole('listitem').filter({ hasText: 'topple' });
    const fast = findings.filter({ hasText: /Step 2: the [a-z ]+ is asked for \d+\.\d\d times the speed/ });
    await fast.getByRole('button', { name: `Show motion ${PAGE} (topple), step 2` }).click();
    expect(await person.button('Step 2').getAttribute('aria-current')).toBe('true');
    await person.open('Checks');
    await person.button(`Try motion ${PAGE} (topple)`).click();
    await findings.filter({ hasText: /Falls in step 2 after \d\.\d s, and stays on the floor/ }).waitFor();
    await person.open('Curves');
    const tooFast = page.getByRole('status', { name: 'Too fast' });
    await tooFast.and(page.locator('[data-tone=bad]')).waitFor();
    await expect.poll(() => redPixels(page), { timeout: 240_000 }).toBeGreaterThan(50);

    await person.open('Steps');
    await page.getByRole('spinbutton', { name: 'Time of step 2' }).fill('1.5');
    await page.keyboard.press('Enter');
    await person.button('Mirror ◂').click();
    await person.button(`Undo: mirror (motion ${PAGE})`).waitFor();
    await person.open('Curves');
    await tooFast.and(page.locator('[data-tone=calm]')).waitFor();
    await expect.poll(() => redPixels(page), { timeout: 240_000 }).toBe(0);

    const wanted = changed(convert(join(folder, 'found.mtn'), 'found.bin'));
    await person.openMenu();
    for (const suffix of ['.bin', '.mtn', '.m512', '.hex']) {
        const [download] = await Promise.all([page.waitForEvent('download'), page.getByLabel('Save as a file').selectOption(suffix)]);
        const saved = readFileSync(await download.path());
        expect(download.suggestedFilename()).toBe(`My motions${suffix}`);
        if (suffix === '.bin') {
            expect(saved.subarray(512).equals(wanted.subarray(512))).toBe(true); // page 0 is this robot's own trim; the file has none
            writeFileSync(join(folder, 'saved.bin'), saved);
        } else {
            expect(saved.equals(convert(join(folder, 'saved.bin'), `wanted${suffix}`)), suffix).toBe(true);
        }
    }
    await person.leave();
});

/** In the browser, before the page loads: records every status text of the robot, however briefly shown. */
function noteDoing(): void {
    const said: string[] = [];
    Object.assign(window, { said });
    new MutationObserver(() => {
        const text = document.querySelector('status-bar .doing')?.textContent ?? '';
        if (said.at(-1) !== text) said.push(text);
    }).observe(document, { subtree: true, childList: true, characterData: true });
}

const doings = (page: Page): Promise<string[]> => page.evaluate(() => (window as unknown as { said: string[] }).said);

test('a teacher sends a motion as a link; for the pupil it opens running, is told as an edit, and is played again by keyboard', async () => {
    const teacher = await suite.come();
    await teacher.open('Motions');
    await teacher.page.getByRole('option', { name: /^motion 2 bow/ }).click();
    await teacher.open('Steps');
    await teacher.page.getByRole('spinbutton', { name: 'Time of step 1' }).fill('1.5'); // makes the bow differ from the pupil's
    await teacher.page.keyboard.press('Enter');
    await teacher.openMenu();
    await teacher.button('Send as link').click();
    const link = await teacher.page.getByRole('textbox', { name: 'Link' }).inputValue();
    expect(link.length).toBeLessThan(2000);
    await teacher.leave();

    const pupil = await suite.come({ isNew: true, before: page => page.addInitScript(noteDoing) }, link);
    const card = pupil.page.getByRole('region', { name: 'A motion for you' });
    await card.getByText('“bow”, a motion for you').waitFor();
    expect(await pupil.button('Walk it').isVisible()).toBe(false);
    expect(new URL(pupil.page.url()).hash).toBe('');
    const plays = async (): Promise<number> => {
        const isPlaying = (await doings(pupil.page)).map(text => /^Playing motion \d+ \(bow\)/.test(text));
        return isPlaying.filter((plays, i) => plays && !isPlaying[i - 1]).length;
    };
    await expect.poll(plays).toBe(1);
    const [first] = (await doings(pupil.page)).filter(text => text.includes('(bow)'));
    expect(first).toMatch(/^In the picture only: motion \d+ \(bow\)/); // before the robot can play it
    await pupil.untilStanding();
    const keys = new Keyboard(pupil);
    await keys.enter('▶ Play it again');
    await expect.poll(plays).toBe(2);
    await keys.enter('Look at its steps');
    await pupil.page.getByRole('button', { name: /^Undo: .* \(motion \d+\)/ }).waitFor();
    await pupil.leave();
});
