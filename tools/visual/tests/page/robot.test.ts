// SPDX-License-Identifier: MIT
// What people do with the robot in the page, by mouse and keyboard, with elements found by their labels. Long motions are watched at four
// times the speed.
import { expect, test } from 'vitest';
import type { Visitor } from './page-bench.ts';
import { pageSuite } from './page-suite.ts';

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

test('a pupil: it stands, walks while the keys light up, is pushed over, gets up; a game pad drives it, a hand puts it on its feet, too; a steep floor', async () => {
    const pupil = await suite.come({ hasPhysics: true });
    const { page } = pupil;
    await pupil.untilStanding();
    expect(await pupil.button('Get up').isDisabled()).toBe(true); // it is standing
    await page.keyboard.down('ArrowUp');
    await pupil.untilDoing(/Playing motion 2[12] \(walk_/);
    await page.keyboard.up('ArrowUp');
    await page.getByText(/walk_[rl] plays/).waitFor();
    await pupil.button('Stop').click();
    await pupil.untilStanding();
    await gamePad(pupil, 12);
    await pupil.untilDoing(/Playing motion 2[12] \(walk_/);
    await gamePad(pupil, null); // unplugged while pressed
    await expect.poll(() => pupil.button('U: ahead').getAttribute('aria-pressed')).toBe('false');
    await pupil.button('Stop').click();
    await pupil.untilStanding();
    await pupil.open('Robot');
    await pupil.button('Push ahead').click();
    await pupil.untilDoing(LIES);
    await pupil.button('4×').click();
    await pupil.button('Get up').press('Enter');
    await pupil.untilStanding();
    const focus = page.locator(':focus');
    expect(await focus.textContent()).toBe(await pupil.button('Stop').textContent()); // a standing robot cannot get up
    await pupil.button('Push back').click();
    await pupil.untilDoing(LIES);
    await pupil.button('Put on its feet').click();
    await pupil.untilDoing('A hand holds the robot.');
    await pupil.doing.filter({ hasNotText: 'lies' }).waitFor();
    await pupil.button('Let go').click();
    await pupil.untilStanding();
    await page.getByLabel('Slope to the front').fill('15');
    await pupil.untilDoing(LIES);
    await pupil.leave();
});

test('somebody leaves the terminal while Edit waits for a name: the robot plays all the same, the name goes on; Stop answers no question, and a key of the remote throws nothing away', async () => {
    const person = await suite.come();
    const runs = person.doing.filter({ hasText: /^Edit runs/ });
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
    await person.untilDoing(/^Playing motion/);
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
    await person.untilSaid(/^The motion in Edit's memory has edits that are not saved/);
    await person.open('Terminal');
    await person.untilScreenSays('salute');
    await person.type('save\r');
    await expect.poll(async () => (await person.screen()).includes('* unsaved')).toBe(false);
    await person.open('Remote');
    await person.page.keyboard.press('ArrowUp'); // it starts Play, which then carries it out
    await person.untilDoing(/^Playing motion 2[012] \(walk/);
    await person.leave();
});

/** Sum of the distances of the right arm's three joints from 512. */
async function rightArm(visitor: Visitor): Promise<number> {
    return (await visitor.positions([1, 3, 5])).reduce((sum, position) => sum + Math.abs(position - 512), 0);
}

test('a lamp that blinks moves nothing in the area of the robot', async () => {
    const person = await suite.come({ screen: { width: 1000, height: 700 } });
    await person.untilStanding();
    await person.open('Robot');
    const places = await person.page.evaluate(async () => {
        const lamps = document.querySelector<HTMLElement>('robot-pane .leds');
        const seen = { lamps: new Set<string>(), heights: new Set<number>() };
        for (const endMs = performance.now() + 4000; lamps && performance.now() < endMs; await new Promise(requestAnimationFrame)) {
            seen.lamps.add(lamps.dataset.bits ?? '');
            seen.heights.add(lamps.offsetHeight);
        }
        return [seen.lamps.size, seen.heights.size];
    });
    expect(places[0]).toBeGreaterThan(1); // they do blink
    expect(places[1]).toBe(1);
    await person.leave();
});

test('a hand pulls a stiff arm and lets it go back', async () => {
    const person = await suite.come({ hasPicture: true, hasPhysics: true });
    await person.untilStanding();
    const arm = await person.placeOf('right_forearm');
    const rest = await rightArm(person);
    await person.page.mouse.move(arm.x, arm.y);
    await person.page
        .locator('robot-view .joint-label')
        .filter({ hasText: /right elbow/ })
        .waitFor();
    await person.page.mouse.down();
    await person.page.mouse.move(arm.x - 90, arm.y - 60, { steps: 8 });
    await expect.poll(async () => Math.abs((await rightArm(person)) - rest), PATIENT).toBeGreaterThan(4);
    await person.page.mouse.up();
    await expect.poll(async () => Math.abs((await rightArm(person)) - rest), PATIENT).toBeLessThan(4);
    await person.leave();
});

/** In Robot: time slow, paused, tick by tick. */
async function timeControl(person: Visitor): Promise<void> {
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
}

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

test('somebody who debugs breaks servos, lowers the battery, slows time: the firmware names each, goals stand beside positions', async () => {
    const person = await suite.come();
    const { page } = person;
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
        await person.untilSaid(says);
        await expect.poll(async () => (await servo(person, id)).state, PATIENT).toBe(state); // the table is updated ten times a second
        await fault(id, 'none');
    }
    await person.untilSaid('Servo 5 answers again');
    await person.button('Bow').click();
    await person.untilDoing('Playing motion 2 (bow)');
    await person.untilStanding(); // in working order again

    await page.getByLabel('Battery').fill('6.5');
    await person.untilSaid('Battery is low: 6.5 V');
    await page.locator('status-bar .facts').filter({ hasText: '6.5 V' }).waitFor();
    await timeControl(person);
    await person.leave();
});
