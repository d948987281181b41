// SPDX-License-Identifier: MIT
// Your robot: Web Serial in the real browser, to Play on `cm5sim --pty`. Chromium lists no pseudo-terminals, but it lists
// /dev/ttyS0: in a mount namespace of its own the browser finds the pty there, and a policy that allows this page to use it
// without the chooser. That needs root, /dev/ttyS0 and unshare; where they are missing the test says that it was left out.
import { spawn, spawnSync } from 'node:child_process';
import type { ChildProcess } from 'node:child_process';
import { chmodSync, existsSync, mkdirSync, mkdtempSync, realpathSync, writeFileSync } from 'node:fs';
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

async function robotOnPty(folder: string): Promise<{ process: ChildProcess; pty: string }> {
  const link = join(folder, 'robot');
  const eeprom = join(folder, 'eeprom');
  writeFileSync(eeprom, Buffer.concat([Buffer.alloc(4095, 0xff), Buffer.of(0x11)])); // the loader starts Play without a word
  const robot = spawn(SIMULATOR, ['boot-cm5.hex', 'play-cm5.hex', '--motions', join(BUILD, 'motions/motions.bin'), '--servos', '1-18', '--eeprom', eeprom,
    `--pty=${link}`, '--no-stdio'], { stdio: ['ignore', 'ignore', 'inherit'], cwd: join(BUILD, '..') });
  for (let i = 0; i < 100 && !existsSync(link); i++) await new Promise((resolve) => setTimeout(resolve, 100));
  return { process: robot, pty: realpathSync(link) };
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

test.skipIf(why !== null)('a hobbyist: connects, the page knows the robot, plays a bow, the picture follows; the cable is pulled', async () => {
  const folder = mkdtempSync(join(tmpdir(), 'm512-serial-'));
  const server = await PageServer.start();
  const robot = await robotOnPty(folder);
  const browser = await chromium.launch({ executablePath: wrapper(folder, robot.pty, new URL(server.address).origin), headless: true, args: FLAGS });
  try {
    const person = await Visitor.come(browser, server.address);
    await person.untilStanding();
    await person.button('Your robot …').click();
    await person.button('serial port').waitFor();
    await person.untilStanding();
    await person.button('Bow').click();
    await person.doing.filter({ hasText: 'Playing page 2 (bow)' }).waitFor({ timeout: 30_000 });
    const hip = await person.page.evaluate(() => new Promise<number>((resolve) => {
      type Frame = { servos: { id: number; position: number }[] };
      const { desk } = document.querySelector('app-shell') as unknown as { desk: { onFrame(l: (s: Frame) => void): () => void } };
      const stop = desk.onFrame((state) => {
        const position = state.servos.find((servo) => servo.id === 11)?.position ?? 0;
        if (position > 700) resolve((stop(), position));
      });
    }));
    expect(hip).toBeGreaterThan(700);
    robot.process.kill(); // the other end is gone
    await person.doing.filter({ hasText: 'The cable is out.' }).waitFor({ timeout: 30_000 });
    await person.button('Robot in this page').click();
    await person.untilStanding();
    await person.leave();
  } finally {
    await browser.close();
    robot.process.kill();
    await server.stop();
  }
});
