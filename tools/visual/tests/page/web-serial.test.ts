// SPDX-License-Identifier: MIT
// Your robot: Web Serial in the real browser, to Play on `cm5sim --pty`. Chromium lists no pseudo-terminals, but it lists
// /dev/ttyS0: in a mount namespace of its own the browser finds the pty there, and a policy that allows this page to use it
// without the chooser. That needs root, /dev/ttyS0 and unshare; where they are missing the test says that it was left out.
import { spawn, spawnSync } from 'node:child_process';
import type { ChildProcess } from 'node:child_process';
import { chmodSync, existsSync, mkdirSync, mkdtempSync, readFileSync, realpathSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { chromium } from 'playwright-core';
import { expect, test } from 'vitest';
import { BROWSER, FLAGS, PageServer, Visitor } from './page-bench.ts';

const BUILD = new URL('../../../../build/', import.meta.url).pathname;
const SIMULATOR = join(BUILD, 'host/tools/sim/cm5sim');
const POLICIES = '/etc/chromium/policies/managed';

function reasonToLeaveOut(): string | null {
  if (process.getuid?.() !== 0) return 'it needs root';
  if (!existsSync('/dev/ttyS0')) return 'there is no /dev/ttyS0';
  if (!existsSync(SIMULATOR)) return 'cm5sim is not built';
  if (spawnSync('unshare', ['-m', 'mount', '--bind', '/dev/null', '/dev/ttyS0']).status !== 0) return 'mounts are not allowed here';
  return null;
}

const why = reasonToLeaveOut();
if (why) console.warn(`left out: Web Serial to cm5sim: ${why}`);

/** A robot in cm5sim; its flash is written to `flash` when it ends. */
class Robot {
  readonly pty: string;
  readonly flash: string;
  private readonly process: ChildProcess;

  private constructor(process: ChildProcess, pty: string, flash: string) {
    this.process = process;
    this.pty = pty;
    this.flash = flash;
  }

  static async start(folder: string, image: 'play' | 'edit', hand: string): Promise<Robot> {
    writeFileSync(join(folder, 'hand'), hand);
    const [link, eeprom, flash] = ['robot', 'eeprom', 'flash'].map((name) => join(folder, name)) as [string, string, string];
    writeFileSync(eeprom, Buffer.concat([Buffer.alloc(4095, 0xff), Buffer.of(0x11)])); // the loader starts the image without a word
    const robot = spawn(SIMULATOR, ['boot-cm5.hex', `${image}-cm5.hex`, '--motions', join(BUILD, 'motions/motions.bin'), '--servos', '1-18', '--eeprom', eeprom,
      '--flash', flash, `--pty=${link}`, '--no-stdio', ...(hand ? ['--realtime', `--script=${join(folder, 'hand')}`] : [])], { stdio: ['ignore', 'ignore', 'inherit'], cwd: join(BUILD, '..') });
    for (let i = 0; i < 600 && !existsSync(link); i++) await new Promise((resolve) => setTimeout(resolve, 100));
    return new Robot(robot, realpathSync(link), flash);
  }

  /** Pulls its cable: its end of the line is gone. */
  stop(): Promise<void> {
    return new Promise((resolve) => {
      if (this.process.exitCode !== null || this.process.signalCode !== null) return resolve();
      this.process.once('exit', () => resolve());
      this.process.kill('SIGINT');
    });
  }
}

/** A browser that sees the pty as /dev/ttyS0 and may use it on this origin. */
function wrapper(folder: string, pty: string, origin: string): string {
  const policies = join(folder, 'policies');
  mkdirSync(policies);
  writeFileSync(join(policies, 'serial.json'), JSON.stringify({ SerialAllowAllPortsForUrls: [origin] }));
  mkdirSync(POLICIES, { recursive: true });
  const script = join(folder, 'browser');
  writeFileSync(script, `#!/bin/sh\nexec unshare -m sh -c 'mount --bind ${pty} /dev/ttyS0 && mount --bind ${policies} ${POLICIES} && exec ${BROWSER} "$@"' sh "$@"\n`);
  chmodSync(script, 0o755);
  return script;
}

/** What somebody does with a robot on the port of this computer. */
async function atTheRobot(image: 'play' | 'edit', deed: (person: Visitor, robot: Robot) => Promise<void>, hand = ''): Promise<void> {
  const folder = mkdtempSync(join(tmpdir(), 'm512-serial-'));
  const server = await PageServer.start();
  const robot = await Robot.start(folder, image, hand);
  const browser = await chromium.launch({ executablePath: wrapper(folder, robot.pty, new URL(server.address).origin), headless: true, args: FLAGS });
  try {
    const person = await Visitor.come(browser, server.address);
    await person.untilStanding();
    await person.button('Your robot …').click();
    await person.button('serial port').waitFor();
    await deed(person, robot);
    await person.leave();
  } finally {
    await browser.close();
    await robot.stop();
    await server.stop();
  }
}

/** Waits until a servo of the picture is beyond this position; how many poses a second the picture got meanwhile. */
function untilBeyond(person: Visitor, servo: number, position: number): Promise<number> {
  return person.page.evaluate(([id, beyond]) => new Promise<number>((resolve) => {
    type Frame = { servos: { id: number; position: number }[] };
    const { desk } = document.querySelector('app-shell') as unknown as { desk: { onFrame(l: (s: Frame) => void): () => void } };
    const startMs = performance.now();
    let poses = 0;
    const stop = desk.onFrame((state) => {
      poses++;
      if ((state.servos.find((one) => one.id === id)?.position ?? 0) <= beyond) return;
      stop();
      resolve((1000 * poses) / (performance.now() - startMs));
    });
  }), [servo, position] as const);
}

test.skipIf(why !== null)('a hobbyist: connects, walks by keyboard, plays a bow, the picture follows; the cable is pulled', async () => {
  await atTheRobot('play', async (person, robot) => {
    await person.untilStanding();
    await person.page.keyboard.press('ArrowUp');
    await person.doing.filter({ hasText: /Playing page 2[12] \(walk_/ }).waitFor();
    await person.page.keyboard.press('Space');
    await person.untilStanding();
    await person.button('Bow').click();
    console.log(`the picture got ${(await untilBeyond(person, 11, 700)).toFixed(1)} poses a second over Web Serial`); // a bow: the right hip
    await robot.stop();
    await person.doing.filter({ hasText: 'The cable is out.' }).waitFor();
    await person.button('Robot in this page').click();
    await person.untilStanding();
  });
});

test.skipIf(why !== null)('a hobbyist with Edit: a page named and saved in the terminal is in the flash of the robot', async () => {
  await atTheRobot('edit', async (person, robot) => {
    await person.page.getByRole('log', { name: 'Last message' }).filter({ hasText: 'All pages of your robot are read' }).waitFor();
    await person.open('Terminal');
    await person.type('\r'); // draws the screen: it was put away by the page's questions
    await person.untilScreenSays('PageNumber');
    await person.type('page 100\r');
    await person.untilScreenSays('PageNumber:0100');
    await person.type('name salute\r');
    await person.untilScreenSays(/\* unsaved/);
    await person.type('save\r');
    await expect.poll(async () => (await person.screen()).includes('* unsaved')).toBe(false);
    await robot.stop();
    await person.doing.filter({ hasText: 'The cable is out.' }).waitFor();
    expect(readFileSync(robot.flash).toString('latin1')).toContain('salute');
    expect(readFileSync(join(BUILD, 'motions/motions.bin')).toString('latin1')).not.toContain('salute');
  });
});

/** A hand of the simulator: when the right arm is let go, it turns two of its servos and stays there. */
const HAND = 'torque 1 == 1 within 3000s\ntorque 1 == 0 within 3000s\npush 1 400\npush 3 700\nwait 3000s\n';
/** The robot runs in real time here: asked for by hand, on a machine that does nothing else. */
const isAsked = process.env['SERIAL'] === 'all';
if (!isAsked) console.warn('left out: teaching over Web Serial: SERIAL=all tools/visual/test page web-serial');

test.skipIf(why !== null || !isAsked)('a hobbyist: all pages read and kept, a step taught by hand, what will change, written; nothing else is', async () => {
  await atTheRobot('edit', async (person, robot) => {
    const { page } = person;
    await page.getByText('All pages of your robot are read, and kept in this browser as a backup.').waitFor();
    await person.open('Steps');
    await person.button('New page').click();
    await person.button('Add step from the robot').click();
    await person.button('Hold').click();
    await page.getByRole('status', { name: 'Teaching' }).filter({ hasText: 'All joints hold.' }).waitFor();
    const seen = untilBeyond(person, 3, 690);
    await person.button('Right arm').click();
    await seen;
    await person.button('Add step from the robot').click();
    await page.getByRole('button', { name: 'Step 2', exact: true }).waitFor();
    const name = page.getByRole('textbox', { name: 'Name of the page' });
    await name.fill('hello');
    await name.press('Enter');
    await person.button('To the robot (1) …').click();
    const rows = page.getByRole('list', { name: 'Pages that differ' });
    await rows.getByText(/^page \d+ \(hello\)$/).waitFor();
    const number = Number.parseInt((await rows.getByText(/^page \d+ \(hello\)$/).innerText()).slice(5), 10);
    await person.button('Write 1 page into the robot').click();
    await page.getByRole('status', { name: 'Transfer' }).filter({ hasText: 'Written and verified: 1 page.' }).waitFor();
    await rows.getByText('Nothing differs.').waitFor();
    await robot.stop();
    const [before, after] = [readFileSync(join(BUILD, 'motions/motions.bin')), readFileSync(robot.flash).subarray(0xe000)];
    const differ = Array.from({ length: 128 }, (_, at) => at).filter((at) => !before.subarray(512 * at, 512 * at + 512).equals(after.subarray(512 * at, 512 * at + 512)));
    expect(differ).toEqual([number]);
  }, HAND);
}, 900_000);
