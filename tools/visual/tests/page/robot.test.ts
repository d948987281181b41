// SPDX-License-Identifier: MIT
// What people do with the robot in the page, by mouse and keyboard, with elements found by their labels. Long motions are watched at four
// times the speed.
import { expect, test } from 'vitest';
import { Visitor } from './page-bench.ts';
import { SHOTS, pageSuite } from './page-suite.ts';

const LIES = /^The robot lies on the floor\. Press Get up\.$/;
const PATIENT = { timeout: 240_000 };
const suite = pageSuite();

/** A game pad with this button pressed; null: it is unplugged. */
async function gamePad(visitor: Visitor, pressed: number | null): Promise<void> {
    await visitor.page.evaluate(held => {
        const pad = { axes: [0, 0], buttons: Array.from({ length: 16 }, (_, i) => ({ pressed: i === held })) };
        navigator.getGamepads = () => [held === null ? null : (pad as unknown as Gamepad)];
        window.dispatchEvent(new Event(held === null ? 'gamepaddisconnected' : 'gamepadconnected'));
    }, pressed);
}

test('a pupil: it stands, walks while the keys light up, is pushed over, gets up; a game pad drives it, a hand puts it on its feet, too', async () => {
    const pupil = await Visitor.come(suite.browser, suite.address, { sharpness: 2 }); // high resolution for the README
    await pupil.untilStanding();
    expect(await pupil.button('Get up').isDisabled()).toBe(true); // it is standing
    await pupil.page.keyboard.down('ArrowUp');
    await pupil.doing.filter({ hasText: /Playing motion 2[12] \(walk_/ }).waitFor();
    await pupil.page.keyboard.up('ArrowUp');
    await pupil.page.getByText(/walk_[rl] plays/).waitFor();
    await pupil.page.screenshot({ path: `${SHOTS}page.png`, scale: 'css' }); // used in the README
    await pupil.button('Stop').click();
    await pupil.untilStanding();
    await gamePad(pupil, 12);
    await pupil.doing.filter({ hasText: /Playing motion 2[12] \(walk_/ }).waitFor();
    await gamePad(pupil, null); // unplugged while pressed
    await expect.poll(() => pupil.button('U: ahead').getAttribute('aria-pressed')).toBe('false');
    await pupil.button('Stop').click();
    await pupil.untilStanding();
    await pupil.open('Robot');
    await pupil.button('Push ahead').click();
    await pupil.doing.filter({ hasText: LIES }).waitFor();
    await pupil.button('4×').click();
    await pupil.button('Get up').click();
    await pupil.untilStanding();
    await pupil.button('Push back').click();
    await pupil.doing.filter({ hasText: LIES }).waitFor();
    await pupil.button('Put on its feet').click();
    await pupil.doing.filter({ hasText: 'A hand holds the robot.' }).waitFor();
    await pupil.doing.filter({ hasNotText: 'lies' }).waitFor();
    await pupil.button('Let go').click();
    await pupil.untilStanding();
    await pupil.leave();
});

test('somebody leaves the terminal while Edit waits for a name: the robot plays all the same, the name goes on; Stop answers no question, and a key of the remote throws nothing away', async () => {
    const person = await Visitor.come(suite.browser, suite.address, { hasPicture: false, hasPhysics: false });
    const runs = person.doing.filter({ hasText: /^Edit runs/ });
    const said = person.page.getByRole('log', { name: 'Last message' });
    await person.untilStanding();
    await person.open('Robot');
    await person.button('Run Edit').click();
    await runs.waitFor();
    await person.open('Terminal');
    await person.untilScreenSays('PageNumber');
    await person.type('page 100\rname\r');
    await person.untilScreenSays('name name:');
    await person.type('salu');
    await person.open('Remote');
    await person.button('Bow').click();
    await person.doing.filter({ hasText: /^Playing motion/ }).waitFor();
    await runs.waitFor();
    await person.open('Terminal');
    await person.untilScreenSays('name:salu');
    await person.type('te\r');
    await person.untilScreenSays(/\* unsaved/);
    expect(await person.screen()).toContain('salute');
    await person.type('new\r');
    await person.untilScreenSays('Are you sure?');
    await person.open('Remote');
    await person.button('Stop').click();
    await runs.waitFor();
    await person.open('Terminal');
    await person.untilScreenSays('Are you sure?');
    await person.robotSeconds(2); // the page reports the terminal's size again; what arrives with that is no answer
    await person.type('n');
    await expect.poll(() => person.screen()).not.toContain('Are you sure?');
    await person.open('Remote');
    await person.page.keyboard.press('ArrowUp'); // only Play receives it, and Play would start with an empty RAM
    await said.filter({ hasText: /^The motion in Edit's memory has edits that are not saved/ }).waitFor();
    await person.open('Terminal');
    await person.untilScreenSays('salute');
    await person.type('save\r');
    await expect.poll(async () => (await person.screen()).includes('* unsaved')).toBe(false);
    await person.open('Remote');
    await person.page.keyboard.press('ArrowUp'); // it starts Play, which then carries it out
    await person.doing.filter({ hasText: /^Playing motion 2[012] \(walk/ }).waitFor();
    await person.leave();
});

/** Finds a part of the robot in the picture by what lights up under the mouse. */
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

/** Sum of the distances of the right arm's three joints from 512. */
async function rightArm(visitor: Visitor): Promise<number> {
    return (await visitor.positions([1, 3, 5])).reduce((sum, position) => sum + Math.abs(position - 512), 0);
}

test('a hand pulls a stiff arm and lets it go back; time slow, paused, tick by tick', async () => {
    const person = await Visitor.come(suite.browser, suite.address, { theme: 'dark' });
    await person.untilStanding();
    const arm = await find(person, /right elbow/);
    const rest = await rightArm(person);
    await person.page.mouse.down();
    await person.page.mouse.move(arm.x - 90, arm.y - 60, { steps: 8 });
    await expect.poll(async () => Math.abs((await rightArm(person)) - rest), PATIENT).toBeGreaterThan(4);
    await person.page.mouse.up();
    await expect.poll(async () => Math.abs((await rightArm(person)) - rest), PATIENT).toBeLessThan(4);

    await person.open('Robot');
    const clock = person.page.locator('robot-pane .clock');
    const seconds = async (): Promise<number> => Number.parseFloat(await clock.innerText());
    const facts = person.page.locator('status-bar .facts');
    await person.button('Pause').click();
    await person.button('Pause').and(person.page.locator('[aria-pressed="true"]')).waitFor();
    await facts.filter({ hasText: 'time stands still' }).waitFor();
    for (let i = 0; i < 3; i++) await rightArm(person); // each reads a newer state than the one before, so the last is from the pause
    const stands = await seconds();
    for (let i = 0; i < 16; i++) await person.button('One tick').click();
    await expect.poll(seconds, PATIENT).toBeGreaterThan(stands + 0.05); // 16 ticks of 1/128 s, shown in tenths
    expect(await seconds()).toBeLessThan(stands + 0.25);
    await person.button('0.1×').click(); // its exact speed: pacer.test.ts
    await facts.filter({ hasText: '0.1× time' }).waitFor();
    await expect.poll(seconds, PATIENT).toBeGreaterThan(stands + 0.25);
    await person.button('real time').click();
    await expect.poll(seconds, PATIENT).toBeGreaterThan(stands + 1);
    await person.leave();
});

/** A row of the servo table: goal, position, state. */
async function servo(visitor: Visitor, id: number): Promise<{ goal: number; position: number; state: string }> {
    const [goal = '', position = '', state = ''] = await visitor.page
        .locator('servo-table tbody tr')
        .nth(id - 1)
        .locator('td')
        .allInnerTexts()
        .then(cells => cells.slice(1));
    return { goal: Number.parseInt(goal, 10), position: Number.parseInt(position, 10), state };
}

test('somebody who debugs breaks servos, lowers the battery, tilts the floor: the firmware names each, goals stand beside positions', async () => {
    const person = await Visitor.come(suite.browser, suite.address, { theme: 'dark', hasPicture: false });
    const { page } = person;
    const said = page.getByRole('log', { name: 'Last message' });
    const fault = (id: number, what: string) => page.getByLabel(`Fault of servo ${id}`, { exact: true }).selectOption(what);
    await person.untilStanding();
    await person.open('Robot');

    await fault(13, 'blocked'); // a knee
    await expect.poll(async () => (await servo(person, 13)).position).not.toBeNaN();
    const before = (await servo(person, 13)).position;
    await person.button('Bow').click();
    await expect.poll(async () => Math.abs((await servo(person, 13)).goal - before), PATIENT).toBeGreaterThan(12); // the bow bends it more
    expect(Math.abs((await servo(person, 13)).position - before)).toBeLessThan(4); // and it does not follow
    expect((await servo(person, 11)).state).toBe('holds');
    await person.untilStanding();
    await fault(13, 'none');

    for (const [id, what, says, state] of [
        [1, 'overloaded', /servo 1\b/i, 'overload'],
        [3, 'too hot', /servo 3 is hot/i, 'hot'],
        [5, 'does not answer', /servo 5 does not answer/i, 'holds'],
    ] as const) {
        await fault(id, what);
        await said.filter({ hasText: says }).waitFor();
        await expect.poll(async () => (await servo(person, id)).state, PATIENT).toBe(state); // the table is updated ten times a second
        if (id === 5) await page.screenshot({ path: `${SHOTS}robot-dark.png` });
        await fault(id, 'none');
    }
    await said.filter({ hasText: 'Servo 5 answers again' }).waitFor();
    await person.button('Bow').click();
    await person.doing.filter({ hasText: 'Playing motion 2 (bow)' }).waitFor();
    await person.untilStanding(); // in working order again

    await page.getByLabel('Battery').fill('6.5');
    await said.filter({ hasText: 'Battery is low: 6.5 V' }).waitFor();
    await page.locator('status-bar .facts').filter({ hasText: '6.5 V' }).waitFor();
    await page.getByLabel('Slope to the front').fill('15');
    await person.doing.filter({ hasText: LIES }).waitFor();
    await person.leave();
});
