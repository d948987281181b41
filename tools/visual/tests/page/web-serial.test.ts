// SPDX-License-Identifier: MIT
// Your robot: Web Serial in the real browser, to Play on `cm5sim --pty`. Chromium lists no pseudo-terminals, but it lists /dev/ttyS0. The
// browser runs in its own mount namespace with the pty in that place, and with a policy that lets this page use it without the chooser.
// This needs root, /dev/ttyS0 and unshare; without them the test reports that it was skipped.
import { execFileSync, spawn, spawnSync } from 'node:child_process';
import type { ChildProcess } from 'node:child_process';
import { chmodSync, existsSync, mkdirSync, mkdtempSync, readFileSync, realpathSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { chromium } from 'playwright-core';
import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import type { TestContext } from 'vitest';
import { nameAndSave } from './edit-session.ts';
import { Keyboard } from './keyboard.ts';
import { distinct, goalsOfBoard, posesOf } from '../board-goals.ts';
import { BROWSER, FLAGS, PageServer, Visitor } from './page-bench.ts';

const BUILD = new URL('../../../../build/', import.meta.url).pathname;
const SIMULATOR = new URL('../../../sim/cm5sim', import.meta.url).pathname;
const POLICIES = '/etc/chromium/policies/managed';
const PATIENT_MS = 240_000;

function reasonToLeaveOut(): string | null {
    if (process.getuid?.() !== 0) return 'it needs root';
    if (!existsSync('/dev/ttyS0')) return 'there is no /dev/ttyS0';
    if (!existsSync(join(BUILD, 'host/tools/sim/libcm5sim.so'))) return 'cm5sim is not built';
    if (spawnSync('unshare', ['-m', 'mount', '--bind', '/dev/null', '/dev/ttyS0']).status !== 0) return 'mounts are not allowed here';
    return null;
}

const why = reasonToLeaveOut();
if (why) console.warn(`left out: Web Serial to cm5sim: ${why}`);

/** A robot in cm5sim. Its flash is written to `flash` when its cable is pulled. */
class Robot {
    readonly flash: string;
    private readonly folder: string;
    private readonly options: readonly string[];
    private process: ChildProcess | null = null;

    constructor(folder: string, image: 'play' | 'edit', hand: string) {
        this.folder = folder;
        this.flash = join(folder, 'flash');
        writeFileSync(join(folder, 'hand'), hand);
        writeFileSync(join(folder, 'eeprom'), Buffer.concat([Buffer.alloc(4095, 0xff), Buffer.of(0x11)])); // makes the loader start the image silently
        this.options = [
            'boot-cm5.hex',
            `${image}-cm5.hex`,
            '--motions',
            join(BUILD, 'motions/motions.bin'),
            '--servos',
            '1-18',
            '--eeprom',
            join(folder, 'eeprom'),
            '--no-stdio',
            '--realtime',
            '--allow=uart-overrun', // bytes sent while the controller restarts are lost
            ...(hand ? [`--script=${join(folder, 'hand')}`] : ['--time=3000s']),
        ];
    }

    /** Starts the robot and returns its serial port. */
    async plugIn(): Promise<string> {
        const link = join(this.folder, 'robot');
        this.process = spawn(SIMULATOR, [...this.options, '--flash', this.flash, `--pty=${link}`], {
            stdio: ['ignore', 'ignore', 'inherit'],
            cwd: join(BUILD, '..'),
        });
        await expect.poll(() => existsSync(link), { timeout: PATIENT_MS }).toBe(true);
        return realpathSync(link);
    }

    /** Pulls the cable: the robot's end of the line disappears. */
    pull(): Promise<void> {
        const { process } = this;
        this.process = null;
        return new Promise(resolve => {
            if (!process || process.exitCode !== null || process.signalCode !== null) return resolve();
            process.once('exit', () => resolve());
            process.kill('SIGINT');
        });
    }
}

/** A script that starts a browser with the pty as /dev/ttyS0, allowed for this origin. It writes the process ID into `folder`. */
function wrapper(folder: string, pty: string, origin: string): string {
    const policies = join(folder, 'policies');
    mkdirSync(policies);
    writeFileSync(join(policies, 'serial.json'), JSON.stringify({ SerialAllowAllPortsForUrls: [origin] }));
    mkdirSync(POLICIES, { recursive: true });
    const script = join(folder, 'browser');
    const mounts = `mount --bind ${pty} /dev/ttyS0 && mount --bind ${policies} ${POLICIES}`;
    writeFileSync(script, `#!/bin/sh\nexec unshare -m sh -c 'echo $$ > ${folder}/pid && ${mounts} && exec ${BROWSER} "$@"' sh "$@"\n`);
    chmodSync(script, 0o755);
    return script;
}

/** Replaces the port that the browser sees. */
function plugInto(folder: string, pty: string): void {
    const browser = readFileSync(join(folder, 'pid'), 'utf8').trim();
    const change = `umount -l /dev/ttyS0 && mount --bind ${pty} /dev/ttyS0`; // the old one is gone
    execFileSync('nsenter', ['--target', browser, '--mount', '--root', 'sh', '-c', change]); // --root: the tests may run in another root
}

interface Bench {
    readonly person: Visitor;
    readonly robot: Robot;
    readonly folder: string;
}

/** Runs an action with a robot on the port of this computer. */
async function atTheRobot(image: 'play' | 'edit', action: (bench: Bench) => Promise<void>, hand = ''): Promise<void> {
    const folder = mkdtempSync(join(tmpdir(), 'm512-serial-'));
    const server = await PageServer.start();
    const robot = new Robot(folder, image, hand);
    const browser = await chromium.launch({
        executablePath: wrapper(folder, await robot.plugIn(), new URL(server.address).origin),
        headless: true,
        args: FLAGS,
    });
    try {
        const person = await Visitor.come(browser, server.address);
        await person.untilStanding();
        await new Keyboard(person).enter('Menu');
        await new Keyboard(person).enter('Your robot …'); // the policy allows the port, so no chooser opens
        await person.button('serial port').waitFor();
        await person.closeMenu();
        await action({ person, robot, folder });
        await person.leave();
    } finally {
        await browser.close();
        await robot.pull();
        await server.stop();
        rmSync(folder, { recursive: true });
    }
}

/** Waits until a servo of the picture is beyond this position. Prints the poses per second of wall-clock time that the picture got; in
 *  robot time it gets more than 20 (live.test.ts). */
async function untilBeyond(person: Visitor, servo: number, position: number): Promise<void> {
    const rate = await person.inPage(
        (session, [id, beyond, limitMs]) =>
            new Promise<number>(resolve => {
                const startMs = performance.now();
                let poses = 0;
                const end = (result: number): void => {
                    stop();
                    resolve(result);
                };
                const stop = session.onFrame(state => {
                    poses++;
                    if ((state.servos.find(one => one.id === id)?.position ?? 0) > beyond)
                        end((1000 * poses) / (performance.now() - startMs));
                });
                setTimeout(() => end(-1), limitMs);
            }),
        [servo, position, PATIENT_MS] as const,
    );
    if (rate < 0)
        throw new Error(
            `servo ${servo} never came beyond ${position}; the page says: ${await person.page.locator('status-bar').innerText()}`,
        );
    console.log(`the picture got ${rate.toFixed(1)} poses a second over Web Serial`);
}

test.skipIf(why !== null)(
    'a hobbyist: connects, walks by keyboard, plays a bow, the picture follows; after a reset and a pulled cable the page reconnects by itself',
    async () => {
        await atTheRobot('play', async ({ person, robot, folder }) => {
            await person.untilStanding();
            await person.page.keyboard.press('ArrowUp');
            await person.untilDoing(/Playing motion 2[12] \(walk_/);
            await person.page.keyboard.press('Space');
            await person.untilStanding();
            await person.button('Bow').click();
            await untilBeyond(person, 11, 700); // a bow: the right hip
            await person.untilStanding();
            await person.open('Terminal');
            await person.type('@reset\r');
            await person.untilScreenSays(/last reset: (?!power-on)/);
            await person.untilStanding();
            await person.button('Wave').click();
            await person.untilDoing('Playing motion 3 (wave)');

            await robot.pull();
            await person.untilDoing('The cable is unplugged.');
            plugInto(folder, await robot.plugIn());
            await person.untilStanding(); // without pressing anything
            await person.button('Bow').click();
            await person.untilDoing('Playing motion 2 (bow)');
            await robot.pull();
            await person.untilDoing('The cable is unplugged.');
            await person.press('Robot in this page');
            await person.untilStanding();
        });
    },
    900_000,
);

/** A hand of the simulator: when the right arm is released, it turns two of its servos and stays there. */
const HAND = 'torque 1 == 1 within 3000s\ntorque 1 == 0 within 3000s\npush 1 400\npush 3 700\nwait 3000s\n';

test.skipIf(why !== null)(
    'a hobbyist with Edit: all pages read and kept, a step taught by hand, what will change, written; a page saved in the terminal; nothing else is',
    async () => {
        await atTheRobot(
            'edit',
            async ({ person, robot }) => {
                const { page } = person;
                await page.getByText('All motions of your robot are read, and saved in this browser as a backup.').waitFor();
                await person.open('Steps');
                await person.button('New motion').click();
                await person.button('Add step from the robot').click();
                await person.button('Hold').click();
                await page.getByRole('status', { name: 'Teaching' }).filter({ hasText: 'All joints hold.' }).waitFor();
                const seen = untilBeyond(person, 3, 690);
                await person.button('Right arm').click();
                await seen;
                await person.button('Add step from the robot').click();
                await page.getByRole('button', { name: 'Step 2', exact: true }).waitFor();
                const name = page.getByRole('textbox', { name: 'Name of the motion' });
                await name.fill('hello');
                await name.press('Enter');
                await person.button('To the robot (1) …').click();
                const rows = page.getByRole('list', { name: 'Motions that differ' });
                await rows.getByText(/^motion \d+ \(hello\)$/).waitFor();
                const number = Number.parseInt((await rows.getByText(/^motion \d+ \(hello\)$/).innerText()).slice(7), 10);
                await person.button('Write 1 motion into the robot').click();
                await page.getByRole('status', { name: 'Transfer' }).filter({ hasText: 'Written and verified: 1 motion.' }).waitFor();
                await rows.getByText('Nothing differs.').waitFor();
                await person.button('Close').click();
                await person.open('Terminal');
                await nameAndSave(person, 'salute');
                await robot.pull();
                await person.untilDoing('The cable is unplugged.');
                const [before, after] = [readFileSync(join(BUILD, 'motions/motions.bin')), readFileSync(robot.flash).subarray(0xe000)];
                const pageIn = (image: Buffer, at: number): Buffer => image.subarray(512 * at, 512 * at + 512);
                const differ = Array.from({ length: 128 }, (_, at) => at).filter(at => !pageIn(before, at).equals(pageIn(after, at)));
                expect(differ).toEqual([number, 100]);
                expect(pageIn(after, 100).toString('latin1')).toContain('salute');
            },
            HAND,
        );
    },
    900_000,
);

/** Other work on this computer may delay the browser longer than servos wait. Such a run proves nothing and is repeated. If even the last
 *  run was delayed, the test is skipped. */
const HELD_UP = { timeout: 900_000, retry: 4 };
const HELD_UP_MS = 50; // lateness of a 10 ms timer
const PATIENT_WITH_SERVOS_MS = 60_000;

/** A process with real-time priority, where allowed, so that it is as punctual as hardware. */
function punctual(command: string, ...words: string[]): ChildProcess {
    const script = 'chrt --rr --pid 2 $$ 2> /dev/null; exec "$@"';
    return spawn('sh', ['-c', script, 'sh', command, ...words], { stdio: ['ignore', 'ignore', 'inherit'] });
}

/** Servos behind an adapter that can be unplugged (tests/host/bad_adapter.py). */
class Servos {
    private readonly log: string;
    private readonly link: string;
    private readonly busLink: string;
    private readonly bus: ChildProcess;
    private adapter: ChildProcess | null = null;

    constructor(folder: string, ids: string) {
        this.log = join(folder, 'packets');
        this.link = join(folder, 'adapter');
        this.busLink = join(folder, 'bus');
        this.bus = punctual(SIMULATOR, `--bus-pty=${this.busLink}`, '--servos', ids);
    }

    async start(): Promise<string> {
        await expect.poll(() => existsSync(this.busLink)).toBe(true);
        const script = new URL('../../../../tests/host/bad_adapter.py', import.meta.url).pathname;
        this.adapter = punctual('python3', script, this.busLink, this.link, '--log', this.log);
        return this.port();
    }

    /** Its serial port, once it exists. */
    private async port(): Promise<string> {
        await expect.poll(() => existsSync(this.link)).toBe(true);
        return realpathSync(this.link);
    }

    async pull(): Promise<void> {
        this.adapter?.kill('SIGUSR1');
        await expect.poll(() => existsSync(this.link)).toBe(false);
    }

    plugIn(): Promise<string> {
        this.adapter?.kill('SIGUSR2');
        return this.port();
    }

    /** Goals sent so far: servo units by ID. */
    frames(): ReadonlyMap<number, number>[] {
        const lines = readFileSync(this.log, 'latin1').split('\n');
        const sent = lines.filter(line => line.startsWith('> ')).map(line => Buffer.from(line.slice(2), 'hex'));
        return sent
            .filter(packet => packet[4] === 0x83 && packet[5] === 30)
            .map(packet => {
                const data = packet.subarray(7, -1);
                return new Map(Array.from({ length: data.length / 3 }, (_, i) => [data[3 * i] ?? 0, data.readUInt16LE(3 * i + 1)]));
            });
    }

    end(): void {
        this.adapter?.kill('SIGKILL');
        this.bus.kill('SIGKILL');
    }
}

/** In the browser: the chooser returns the port that a person would choose. */
function chooseFirst(): void {
    const { serial } = navigator as unknown as { serial: { getPorts(): Promise<unknown[]> } };
    Object.assign(serial, { requestPort: async () => (await serial.getPorts())[0] });
}

/** Waits until the page reports these servos. On a busy computer some may not be found; a person then chooses the adapter again. */
async function untilFound(person: Visitor, wanted: string): Promise<void> {
    const found = person.page.getByRole('log', { name: 'Last message' }).filter({ hasText: /servos? answers?\./ });
    for (let times = 0; times < 5; times++) {
        await found.waitFor();
        if ((await found.innerText()).startsWith(wanted)) return;
        await person.press('My servos …');
        await found.waitFor({ state: 'detached' });
    }
    throw new Error(`the page never said: ${wanted}`);
}

/** In the browser: hides or shows the page. */
function hide(isHidden: boolean): void {
    Object.defineProperty(document, 'hidden', { configurable: true, value: isHidden });
    document.dispatchEvent(new Event('visibilitychange'));
}

async function atTheServos(
    { task, skip }: TestContext,
    ids: string,
    action: (bench: { person: Visitor; servos: Servos; folder: string }) => Promise<void>,
): Promise<void> {
    let [lastMs, wasHeldUp] = [performance.now(), false];
    const watch = setInterval(() => {
        wasHeldUp ||= performance.now() - lastMs > HELD_UP_MS;
        lastMs = performance.now();
    }, 10);
    const folder = mkdtempSync(join(tmpdir(), 'm512-servos-'));
    const server = await PageServer.start();
    const servos = new Servos(folder, ids);
    const browser = await chromium.launch({
        executablePath: wrapper(folder, await servos.start(), new URL(server.address).origin),
        headless: true,
        args: FLAGS,
    });
    try {
        const before = (page: Page): Promise<unknown> => page.addInitScript(chooseFirst);
        const person = await Visitor.come(browser, server.address, { before });
        await person.untilStanding();
        person.page.setDefaultTimeout(PATIENT_WITH_SERVOS_MS);
        await person.press('My servos …');
        await action({ person, servos, folder }).catch(async (error: unknown) => {
            console.log(`the page says: ${await person.page.locator('status-bar').innerText()}`);
            await person.open('Terminal');
            console.log(await person.screen());
            if (wasHeldUp && (task.result?.retryCount ?? 0) >= HELD_UP.retry) skip('programs were held up');
            throw error;
        });
        await person.leave();
    } finally {
        clearInterval(watch);
        await browser.close();
        servos.end();
        await server.stop();
        rmSync(folder, { recursive: true });
    }
}

test.skipIf(why !== null)(
    'somebody with servos and an adapter: connects, waves as the board does, pulls the plug, goes on after "on"',
    HELD_UP,
    async context => {
        await atTheServos(context, '1-18', async ({ person, servos, folder }) => {
            const startMs = performance.now();
            await untilFound(person, '18 servos answer. Nothing moves before you say so.');
            expect(servos.frames()).toEqual([]);
            await person.button('Wave').click();
            await person.untilDoing('Playing motion 3 (wave)');
            console.log(`the first wave began ${((performance.now() - startMs) / 1000).toFixed(1)} s after the button`);
            await person.untilStanding();
            const ours = distinct(posesOf(servos.frames()));
            const board = await goalsOfBoard('wave');
            expect(ours).toEqual(board.slice(board.indexOf(ours[0] ?? '')));
            await person.button('Tour').click();
            await person.page.getByRole('region', { name: 'Tour' }).getByText('This is about the robot in the page').waitFor();
            await person.button('End the tour').click();

            await person.button('Walk').click();
            await person.untilDoing(/Playing motion 2[0-9]/);
            await servos.pull();
            await person.untilDoing('The servo adapter is unplugged');
            const sent = servos.frames().length;
            plugInto(folder, await servos.plugIn());
            await person.untilDoing('The servo adapter is back');
            await person.button('Wave').click();
            await person.untilSaid(/refused/);
            expect(servos.frames().length).toBe(sent);
            await person.open('Terminal');
            await person.type('on\r');
            await person.untilStanding();
            await person.button('Wave').click();
            await person.untilDoing('Playing motion 3 (wave)');
            await person.untilStanding();

            await person.button('Walk').click();
            await person.untilDoing(/Playing motion 2[0-9]/);
            await person.page.evaluate(hide, true);
            await person.untilStanding();
            await person.page.evaluate(hide, false);
            await person.untilSaid('This page was hidden, so the motion was ended softly');
            await person.press('Robot in this page');
            await person.untilStanding();
        });
    },
);
