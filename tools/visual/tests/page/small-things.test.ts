// SPDX-License-Identifier: MIT
// What people expect of a page: Ctrl+A selects all, irreversible actions are confirmed, and there is no warning when nothing can be lost.
import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import type { Visitor } from './page-bench.ts';
import { pageSuite } from './page-suite.ts';

const suite = pageSuite();

/** Ctrl+Z or Escape while a step is dragged before the first one: nothing is moved, and what was undone can be redone. */
async function endDragsOfStep(page: Page): Promise<void> {
    const times = (): Promise<string[]> =>
        page.getByLabel(/^Time of step \d$/).evaluateAll(fields => fields.map(field => (field as HTMLInputElement).value));
    await page.getByRole('button', { name: 'Step 2', exact: true }).click(); // it alone
    const time = page.getByLabel('Time of step 2', { exact: true });
    await time.fill('0.50');
    await time.press('Enter');
    const before = await times();
    const redo = page.getByRole('button', { name: /^Redo: / });
    for (const key of ['Control+z', 'Escape']) {
        await page.getByRole('button', { name: 'Step 2', exact: true }).hover();
        await page.mouse.down();
        await page.getByRole('button', { name: 'Step 1', exact: true }).hover({ position: { x: 2, y: 20 } });
        await page.locator('.drop-before').waitFor();
        await page.keyboard.press(key);
        await page.mouse.up();
        if (key === 'Control+z') await redo.click();
        expect(await times()).toEqual(before);
    }
}

/** In the browser: a port to choose, whose robot never answers. */
function withSilentPort(): void {
    const port = { getInfo: () => ({}), open: () => new Promise(() => undefined) };
    Object.assign((navigator as unknown as { serial: object }).serial, { requestPort: () => Promise.resolve(port) });
}

/** Another robot, which has not answered yet: neither the floor nor the pose of the one before is taken for its own. */
async function chooseSilentRobot(person: Visitor): Promise<void> {
    const { page } = person;
    const tilts = page.locator('robot-view');
    await tilts.evaluate(view => Object.assign(view, { tilt: (front: number) => (view.dataset.tilt = front.toFixed(2)) })); // no picture
    await person.open('Robot');
    await page.getByLabel('Slope to the front').fill('12');
    expect(await tilts.getAttribute('data-tilt')).toBe('0.21');
    await page.evaluate(withSilentPort);
    await person.press('Your robot …');
    await expect.poll(() => tilts.getAttribute('data-tilt')).toBe('0.00');
    await person.open('Steps');
    await person.button('New motion').click();
    await person.open('Curves');
    await person.button('Right arm').click();
    const elbow = page.getByRole('spinbutton', { name: /right elbow/ });
    await elbow.fill('300');
    await elbow.press('Enter');
    const steps = await person.inPage(({ editor }) => editor.page(editor.state.get().page).steps);
    expect(steps.map(({ positions }) => positions.filter(position => position !== null))).toEqual([[300]]);
}

test('Ctrl+A, double clicks on "Add step" and Play, a library page, a question before "Factory fresh"', async () => {
    const person = await suite.come({ screen: { width: 1280, height: 800 } });
    const { page } = person;
    await person.untilStanding();
    await person.open('Steps');
    expect(await page.getByRole('button', { name: /^Step \d$/ }).count()).toBe(0); // a new page

    const add = person.button('Add step from the robot');
    const before = await add.boundingBox();
    await add.dblclick();
    await expect.poll(() => page.getByRole('button', { name: /^Step \d$/ }).count()).toBe(2); // two steps added, none deleted
    expect(await add.boundingBox()).toEqual(before);

    const time = page.getByLabel('Time of step 1', { exact: true });
    const message = page.getByRole('log', { name: 'Last message' });
    const seconds = await time.inputValue();
    await time.fill('300');
    await time.press('Enter');
    await message.filter({ hasText: 'Nothing was changed: from 0.01 to 1.99 seconds are possible here.' }).waitFor();
    expect(await time.inputValue()).toBe(seconds);

    await person.button('▶ Play').dblclick(); // plays once, and nothing is refused
    await person.untilDoing(/^(Plays|Going slowly|Playing)/);
    await person.untilDoing(/^Edit runs/);
    expect(await page.locator('status-bar').textContent()).not.toContain('refused');

    await page.keyboard.press('Control+a');
    expect(await page.locator('step-row .pick[aria-pressed="true"]').count()).toBe(2);
    await endDragsOfStep(page);

    const last = await page.getByRole('combobox', { name: 'Motion', exact: true }).inputValue();
    const name = page.getByRole('textbox', { name: 'Name of the motion' });
    await name.fill('  nod  ');
    await name.press('Enter');
    expect(await name.inputValue()).toBe('nod'); // as saved
    await name.fill('');
    await page.keyboard.type('unfinished'); // without Enter or leaving the field
    await page.reload();
    await person.untilStanding();
    await person.open('Steps');
    expect(await name.inputValue()).toBe('unfinished');
    expect(await page.getByRole('combobox', { name: 'Motion', exact: true }).inputValue()).toBe(last);
    await page.getByRole('combobox', { name: 'Motion', exact: true }).selectOption('3');
    await person.button('Edit a copy').click();
    expect(await name.inputValue()).toBe('wave 2');

    await person.open('Robot');
    await person.button('Push ahead').click();
    await message.filter({ hasText: 'Physics could not be loaded, so the robot cannot be pushed.' }).waitFor();
    await person.button('Factory fresh').click();
    await page.getByRole('dialog', { name: 'Factory fresh?' }).getByRole('button', { name: 'Cancel' }).click();
    await person.open('Remote');
    const speed = page.getByRole('slider', { name: 'Speed' });
    await speed.fill('150');
    await person.open('Robot');
    await person.button('Power off').click();
    await person.untilDoing(/^The robot is switched off/);
    // A request to a robot that is off is dropped, or the robot would walk when it is switched on.
    await person.button('Walk').click();
    await message.filter({ hasText: 'The robot is switched off' }).waitFor();
    await person.button('Power on').click();
    await person.untilStanding();
    await person.open('Remote');
    await expect.poll(() => speed.inputValue()).toBe('100'); // the robot's own value again

    await person.open('Terminal');
    await person.type('rate 130\r');
    await person.open('Remote');
    await expect.poll(() => speed.inputValue()).toBe('130');
    await page.getByRole('slider', { name: 'Size' }).fill('80');
    await person.robotSeconds(1); // four reports
    expect(await speed.inputValue()).toBe('130');
    await chooseSilentRobot(person);
    await person.leave();
});

/** In the browser: keeps the database of the documents busy until the page is left, as a slow disk does. */
function keepDiskBusy(): Promise<void> {
    return new Promise(resolve => {
        const opened = indexedDB.open('motion512-editor');
        opened.onsuccess = () => {
            const store = opened.result.transaction(['documents', 'steps'], 'readwrite').objectStore('documents');
            const goOn = (): void => store.count().addEventListener('success', goOn);
            goOn();
            resolve();
        };
    });
}

test('edits that still wait for the disk when the page is left are there the next time, and can be undone', async () => {
    const person = await suite.come();
    const { page } = person;
    await person.open('Steps');
    const name = page.getByRole('textbox', { name: 'Name of the motion' });
    const rename = async (to: string): Promise<void> => {
        await name.fill(to);
        await name.press('Enter');
    };
    await rename('stored');
    const saving = page.getByRole('status', { name: 'Autosave' });
    await saving.filter({ hasText: /saved$/ }).waitFor();
    await page.evaluate(keepDiskBusy);
    await rename('waits');
    await saving.filter({ hasText: /^saving/ }).waitFor();
    await name.fill('unfinished'); // without Enter or leaving the field
    for (let visit = 0; visit < 2; visit++) {
        await page.reload();
        await person.open('Steps');
        expect(await name.inputValue()).toBe('unfinished');
    }
    for (const before of ['waits', 'stored', '']) {
        await page.getByRole('button', { name: /^Undo: name/ }).click();
        expect(await name.inputValue()).toBe(before);
    }
    await rename('later');
    await saving.filter({ hasText: /saved$/ }).waitFor();
    await page.reload();
    await person.open('Steps');
    expect(await name.inputValue()).toBe('later');
    await person.leave();
});

test('the data of the page is deleted in the browser while the page is open: it stores and writes the robot as before', async () => {
    const person = await suite.come();
    const { page } = person;
    await person.untilStanding();
    await person.open('Steps');
    const name = page.getByRole('textbox', { name: 'Name of the motion' });
    const saving = page.getByRole('status', { name: 'Autosave' });
    const rename = async (to: string): Promise<void> => {
        await name.fill(to);
        await name.press('Enter');
        await saving.filter({ hasText: /saved$/ }).waitFor();
    };
    await rename('before');
    const tools = await page.context().newCDPSession(page);
    await tools.send('Storage.clearDataForOrigin', { origin: new URL(suite.address).origin, storageTypes: 'all' });

    await person.button('To the robot (1) …').click(); // a backup comes first
    const dialog = page.getByRole('dialog', { name: 'Compare and write' });
    await dialog.getByRole('button', { name: /^Write 1 motion/ }).click();
    await dialog.getByRole('status', { name: 'Transfer' }).filter({ hasText: 'Written and verified' }).waitFor();
    await dialog.getByRole('button', { name: 'Close' }).click();
    await rename('after');
    await page.reload();
    await person.open('Steps');
    expect(await name.inputValue()).toBe('after');
    await person.leave();
});

test('whoever leaves is asked exactly when the browser keeps nothing', async () => {
    const person = await suite.come();
    const { page } = person;
    const isAsked = async (): Promise<boolean> => {
        await page.locator('app-shell').waitFor();
        return page.evaluate(() => !window.dispatchEvent(new Event('beforeunload', { cancelable: true })));
    };
    expect(await isAsked()).toBe(false);
    const refuses = (): void => {
        const get = (): never => {
            throw new DOMException('denied', 'SecurityError');
        };
        Object.defineProperty(window, 'indexedDB', { get });
    };
    const hangs = (): void => {
        IDBFactory.prototype.open = () => ({}) as IDBOpenDBRequest;
    };
    for (const storage of [hangs, refuses]) {
        await page.addInitScript(storage);
        await page.reload();
        expect(await isAsked()).toBe(true);
        // The warning uses the full width, not only the rest of a row.
        await person.open('Steps');
        const warning = await page.getByRole('status', { name: 'Autosave' }).boundingBox();
        const bar = await page.getByRole('toolbar', { name: 'Document' }).boundingBox();
        expect(warning?.width).toBeGreaterThan(0.9 * (bar?.width ?? NaN));
    }
    await person.leave();
});

test('without WebAssembly a sentence says so, and names no other browser', async () => {
    const person = await suite.come({ before: page => page.addInitScript(() => Reflect.deleteProperty(globalThis, 'WebAssembly')) });
    await person.page.getByRole('alert').filter({ hasText: 'This browser lacks WebAssembly, which' }).waitFor();
    await person.leave();
});

/** In the browser: counts reads of element widths in the terminal, each of which forces a new layout. */
function countWidths(): void {
    const { prototype } = HTMLElement;
    const width = Object.getOwnPropertyDescriptor(prototype, 'offsetWidth');
    const counts = { widths: 0 };
    Object.assign(window, { counts });
    Object.defineProperty(prototype, 'offsetWidth', {
        get(this: HTMLElement): unknown {
            if (this.closest('terminal-pane')) counts.widths++;
            return width?.get?.call(this);
        },
    });
}

test('a terminal that nobody has looked at measures no letters while the robot says what it plays, and shows all of it when it is opened', async () => {
    const person = await suite.come({ before: page => page.addInitScript(countWidths) });
    await person.untilStanding();
    await person.button('Walk').click();
    await person.untilScreenSays(/Page 22 step 4.*Page 22 step 4/s);
    expect(await person.page.evaluate(() => (window as unknown as { counts: { widths: number } }).counts.widths)).toBe(0);
    await person.open('Terminal');
    await person.page.locator('terminal-pane .xterm-rows').filter({ hasText: 'walk_' }).waitFor();
    await person.button('Stop').click();
    await person.untilStanding();
    await person.button('Full screen').click();
    await person.page.keyboard.type('play 2'); // not to the button
    await person.page.keyboard.press('Enter');
    await person.untilDoing(/^Playing motion 2 \(bow\)/);
    await person.leave();
});
