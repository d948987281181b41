// SPDX-License-Identifier: MIT
// Every script of the specification's first table once, by keyboard alone. Not by keyboard: moving a limp limb by hand (the keyboard sets
// poses by the joints' arrows and numbers), and the browser's own choosers for ports and files. A received link: files.test.ts; your robot:
// web-serial.test.ts.
import { expect, test } from 'vitest';
import { Keyboard } from './keyboard.ts';
import type { Visitor } from './page-bench.ts';
import { pageSuite } from './page-suite.ts';

const LIBRARY = new URL('../../../../build/motions/motions.bin', import.meta.url).pathname;
const WIDE = { width: 1440, height: 800 };
const suite = pageSuite();
const chosen = (person: Visitor) => person.page.getByRole('group', { name: 'Chosen joints' }).getByRole('spinbutton');
const steps = (person: Visitor) => person.page.getByRole('button', { name: /^Step \d$/ });
const place = async (person: Visitor): Promise<string> => {
    const { x, y } = await person.placeOf('right_hand');
    return `${Math.round(x)} ${Math.round(y)}`;
};

/** In Steps, on an empty page: a joint begins where the robot has it; the last step is deleted, and brought back. */
async function emptyMotion(person: Visitor, keys: Keyboard): Promise<void> {
    await keys.press('F6', 'ArrowRight');
    const position = Number(await chosen(person).inputValue());
    await keys.press('ArrowUp');
    await expect.poll(async () => Number(await chosen(person).inputValue())).toBe(position + 1);
    await keys.press('Control+z', 'F6');
    await keys.enter('Add step from the robot');
    await keys.to('Step 1', 'Shift+Tab');
    await keys.press('Delete');
    await keys.at(/^No step yet/);
    await keys.press('Control+z');
    await keys.at('Step 1'); // ready for the next key
    await keys.press('Control+z');
    await keys.at(/^No step yet/);
    await keys.enter('Add step from the robot');
    await keys.enter('Delete', 'Shift+Tab');
    await keys.at('Paste'); // there is nothing more to delete
    await keys.enter(/^Undo/, 'Shift+Tab');
    await keys.at(/^Undo: new step/);
    await keys.press('Enter');
    await keys.at('Document'); // nor to undo
}

test('a pupil: walks, looks round, pushes; begins an empty motion, teaches a page, names it, plays it; sends it as a teacher does', async () => {
    const pupil = await suite.come({ hasPicture: true, screen: { width: 1440, height: 560 }, isNew: true });
    const keys = new Keyboard(pupil);
    const { page } = pupil;
    await page.context().grantPermissions(['clipboard-write']);
    await pupil.untilStanding();
    await keys.enter('Walk it'); // that button disappears
    await keys.at('The robot');
    await page.keyboard.down('ArrowUp');
    await pupil.untilDoing(/Playing motion 2[12] \(walk_/);
    await page.keyboard.up('ArrowUp');
    await keys.press('Space');
    await pupil.untilStanding();
    for (const key of ['Shift+ArrowLeft', 'PageUp', '+']) {
        // The picture turns, the robot does not.
        const before = await place(pupil);
        await keys.press(key);
        await expect.poll(() => place(pupil)).not.toBe(before);
    }
    expect(await pupil.doing.textContent()).toBe('The robot stands and waits.');
    await keys.press('p');
    await pupil.untilSaid('Physics could not be loaded, so the robot cannot be pushed.'); // one that can be: robot.test.ts

    await keys.open('Steps');
    await emptyMotion(pupil, keys);
    await keys.enter('New motion');
    await keys.at('Name of the motion');
    await page.keyboard.type('nod');
    await keys.press('Enter');
    await keys.at('Name of the motion');
    await keys.enter('Right arm');
    const teaching = page.getByRole('status', { name: 'Teaching' });
    await teaching.filter({ hasText: 'Drag the limb' }).waitFor();
    await keys.to('Hold');
    await keys.press('Space'); // presses a button as Enter does
    await teaching.filter({ hasText: 'All joints hold.' }).waitFor(); // nothing more to hold: the button is off
    await keys.at('Add step from the robot');
    await keys.press('Enter');
    await expect.poll(() => steps(pupil).count()).toBe(1);
    await keys.to('Step 1');
    await keys.press('d');
    await expect.poll(() => steps(pupil).count()).toBe(2);
    await keys.at('Step 2');
    await keys.enter('Pose', 'Shift+Tab');
    await keys.to('The robot', 'Shift+Tab');
    await keys.press('ArrowRight', 'ArrowRight', 'ArrowRight', 'Shift+ArrowUp', 'Shift+ArrowUp');
    await expect.poll(() => chosen(pupil).count()).toBe(1);
    const turned = Number(await chosen(pupil).inputValue());
    await keys.press('Control+z');
    await expect.poll(async () => Number(await chosen(pupil).inputValue())).toBe(turned - 10);
    await keys.press('Control+y');
    await expect.poll(async () => Number(await chosen(pupil).inputValue())).toBe(turned);
    await keys.to(/^3 /); // its number field
    await page.keyboard.type(String(turned - 60));
    await keys.press('Enter');
    await keys.to('Step 2');
    await keys.press('Alt+ArrowLeft');
    await keys.at('Step 1');
    await keys.press('x', 'Alt+ArrowRight');
    await keys.at('Step 2');
    await keys.to('Time of step 2');
    await page.keyboard.type('2');
    await keys.press('Enter');
    await keys.enter('▶ Play', 'Shift+Tab');
    await pupil.untilDoing(/Playing motion \d+ \(nod\)/);
    await pupil.untilStanding();

    await keys.to('Light or dark', 'Shift+Tab'); // the page's head comes after the picture
    await keys.enter('Send as link', 'Shift+Tab');
    await keys.at('Link');
    await keys.press('Escape');
    await keys.at('Send as link'); // where it was before
    await pupil.leave();
}, 900_000);

test('a hobbyist: opens a file, goes where it is faulty, renames, copies and clears pages, links them, writes; somebody debugs', async () => {
    const person = await suite.come({ hasPython: true, screen: WIDE });
    const keys = new Keyboard(person);
    const { page } = person;
    const card = (name: RegExp) => page.getByRole('option', { name });
    await person.untilStanding();
    const chooser = page.waitForEvent('filechooser');
    await keys.enter('Open …');
    await (await chooser).setFiles(LIBRARY);
    await page.getByRole('dialog', { name: 'motions.bin' }).waitFor();
    await keys.enter('Replace all motions');
    await keys.at('Open …');

    await keys.open('Motions');
    await keys.to(/^motion \d+, empty/); // a new page is selected
    await keys.press('Home');
    await keys.at(/^motion 1 ready/);
    await keys.press('ArrowRight', 'F2'); // the bow
    await keys.at('Name');
    await page.keyboard.type('curtsy');
    await keys.press('Enter');
    await card(/^motion 2 curtsy/).waitFor();
    await keys.press('Control+c', 'End', 'ArrowLeft', 'Control+v'); // after the last page comes the trim
    await keys.enter('Copy');
    await card(/^motion 127 curtsy/).waitFor();
    await keys.at(/^motion 127 curtsy/);
    await keys.press('Delete');
    await keys.enter('Clear');
    await card(/^motion 127, empty/).waitFor();
    await keys.press('Control+z');
    await card(/^motion 127 curtsy/).waitFor();
    await keys.press('Enter');
    await keys.at('Steps');
    await keys.press('ArrowRight', 'ArrowRight', 'ArrowRight');
    await keys.at('Links');
    await keys.choose('next', /^100 \(empty\)/);
    await page.getByRole('button', { name: /^motion 100, nothing to play here/ }).waitFor();
    await keys.at('next'); // the list is rebuilt, and the focus stays
    await keys.open('Checks');
    const dead = page
        .getByRole('list', { name: 'Findings' })
        .getByRole('listitem')
        .filter({ hasText: 'next leads to page 100, which has no action' });
    await dead.waitFor(); // in m512's words
    await keys.enter('Show motion 127 (curtsy)');
    await keys.at('Links');
    await page.getByRole('heading', { name: 'Links of motion 127 (curtsy)' }).waitFor();

    await keys.press('ArrowLeft');
    await keys.at('Motions');
    await keys.enter(/^To the robot \(2\)/);
    const rows = page.getByRole('list', { name: 'Motions that differ' });
    await rows.getByText('motion 127 (curtsy)').waitFor();
    await keys.enter('Write 2 motions into the robot');
    await page.getByRole('status', { name: 'Transfer' }).filter({ hasText: 'Written and verified: 2 motions.' }).waitFor();
    await keys.at('Close'); // the pressed button has no use any more
    await keys.press('Escape');
    await keys.at(/^To the robot/);
    const saved = page.waitForEvent('download');
    await keys.choose('Save as a file', /\.mtn/);
    expect((await saved).suggestedFilename()).toBe('My motions.mtn');
    await keys.press('Escape'); // the list of what the format cannot hold

    await keys.open('Terminal');
    await keys.to('Terminal of the robot');
    await keys.press('Enter');
    await person.untilScreenSays('PageNumber'); // Edit has written
    await keys.press('Shift+Tab');
    await keys.at('Full screen'); // leave it
    await keys.press('Shift+Tab');
    await keys.at('Terminal');
    await keys.press('ArrowRight');
    await keys.enter('Pause');
    await keys.enter('One tick');
    await keys.enter('0.1×');
    await page.getByRole('button', { name: '0.1×', pressed: true }).waitFor();
    await keys.enter('real time');
    await keys.to('Battery');
    await keys.press('ArrowLeft', 'ArrowLeft');
    await keys.to('Slope to the left');
    await keys.press('ArrowRight');
    await keys.choose('Fault of servo 1', /^does not answer$/);
    await keys.to('Draw servo 13'); // where a letter chooses nothing
    await keys.press('?');
    await page.getByRole('dialog', { name: 'Keys' }).waitFor();
    await keys.press('Escape');
    await keys.at('Draw servo 13');
    await person.leave();
}, 900_000);

test('from the chart of links to the first motion; trying motions, stopping it, and trying the only one', async () => {
    const person = await suite.come({ hasPhysics: 'later', screen: WIDE });
    const keys = new Keyboard(person);
    await person.untilStanding();
    await keys.open('Links');
    await keys.to(/^motion \d+ /);
    await keys.press('ArrowDown');
    await person.page.getByRole('heading', { name: /^Links of motion \d+ \(/ }).waitFor(); // a page with a name
    await person.page.setViewportSize({ width: 1024, height: 576 }); // at 125 %
    await keys.open('Curves');
    await keys.to(/^18 /);
    await keys.to('Name of the motion', 'Shift+Tab');
    await person.page.setViewportSize(WIDE);
    await keys.open('Checks');
    await keys.enter('Try all motions');
    await keys.at('Stop trying');
    await keys.press('Enter');
    await keys.at('Try all motions');
    await keys.choose('Document', /^New document/); // with one motion; once it is tried, nothing is left to try
    await person.page.getByRole('dialog', { name: 'New document' }).waitFor();
    await keys.press('Enter');
    await keys.open('Steps');
    await keys.enter('Add step from the robot');
    await keys.open('Checks');
    await keys.enter('Try all motions');
    await keys.at('What physics says');
    await person.leave();
});
