// SPDX-License-Identifier: MIT
// The page in Chromium: start, weight, and whether it holds real time with picture, physics and terminal.
import { gzipSync } from 'node:zlib';
import { readFileSync, readdirSync } from 'node:fs';
import { PageServer, Visitor, startBrowser } from '../page/page-bench.ts';

const seconds = Number(process.argv[2] ?? 60);
const PHYSICS = /mujoco|physical-body|body-.*\.xml|edit-cm5/;
const PYTHON = /pyodide|python/;

interface Sample {
  readonly wallMs: number;
  readonly ticks: number;
  readonly lateMs: number;
}

function weight(): void {
  const folder = new URL('../../../../build/visual/', import.meta.url);
  const sizes = (names: readonly string[]): number => names.reduce((sum, name) => sum + gzipSync(readFileSync(new URL(name, folder)), { level: 9 }).length, 0);
  const assets = readdirSync(new URL('assets/', folder)).map((name) => `assets/${name}`);
  /** Python, and the worker that runs it, come when a file is opened or m512 is asked. */
  const isPython = (name: string): boolean => PYTHON.test(name) || (/worker-.*\.js$/.test(name) && readFileSync(new URL(name, folder), 'utf8').includes('pyodide'));
  const first = ['index.html', ...assets.filter((name) => !PHYSICS.test(name) && !isPython(name))];
  console.log(`first load, compressed                    ${(sizes(first) / 1024).toFixed(0).padStart(6)} KB`);
  console.log(`when m512 is asked (Python)               ${(sizes(assets.filter(isPython)) / 1024).toFixed(0).padStart(6)} KB`);
  console.log(`after it (physics, Edit)                  ${(sizes(assets.filter((name) => PHYSICS.test(name))) / 1024).toFixed(0).padStart(6)} KB`);
}

/** Time, lateness and how far time has come, told by the page itself. */
async function watch(visitor: Visitor, ms: number): Promise<Sample[]> {
  return visitor.page.evaluate((limit) => new Promise<Sample[]>((resolve) => {
    const samples: Sample[] = [];
    const desk = (document.querySelector('app-shell') as unknown as { desk: { onFrame(l: (s: { ticks: number; lateMs: number }) => void): () => void } }).desk;
    const start = performance.now();
    const stop = desk.onFrame((state) => {
      samples.push({ wallMs: performance.now() - start, ticks: state.ticks, lateMs: state.lateMs });
      if (performance.now() - start < limit) return;
      stop();
      resolve(samples);
    });
  }), ms);
}

function report(name: string, samples: readonly Sample[]): void {
  const [first, last] = [samples[0], samples.at(-1)];
  if (!first || !last) return;
  const wall = (last.wallMs - first.wallMs) / 1000;
  const robot = (last.ticks - first.ticks) / 128;
  const late = Math.max(...samples.filter((sample) => sample.wallMs > 1000).map((sample) => sample.lateMs));
  console.log(`${name.padEnd(42)}${robot.toFixed(1)} s of the robot in ${wall.toFixed(1)} s (${(robot / wall).toFixed(2)} x), late by ${late.toFixed(0)} ms at most, ${(samples.length / wall).toFixed(0)} states a second`);
}

async function standing(visitor: Visitor): Promise<number> {
  return visitor.page.evaluate(() => new Promise<number>((resolve) => {
    const look = (): void => {
      const shell = document.querySelector('app-shell') as unknown as { desk?: { onFrame(l: () => void): void } } | null;
      if (shell?.desk) shell.desk.onFrame(() => resolve(performance.now()));
      else requestAnimationFrame(look);
    };
    look();
  }));
}

weight();
const [browser, server] = await Promise.all([startBrowser(), PageServer.start()]);
const visitor = await Visitor.come(browser, server.address);
console.log(`cold start to a standing robot            ${(await standing(visitor) / 1000).toFixed(2).padStart(6)} s`);
await visitor.untilStanding();
await visitor.page.evaluate(() => navigator.serviceWorker.ready.then(() => undefined));
await visitor.page.reload();
console.log(`warm start to a standing robot            ${(await standing(visitor) / 1000).toFixed(2).padStart(6)} s`);
await visitor.untilStanding();
await visitor.button('Walk').click();
await visitor.open('Terminal');
report('walking, physics, picture, terminal', await watch(visitor, seconds * 1000));
await visitor.page.evaluate(() => (document.querySelector('app-shell') as unknown as { desk: { setSpeed(s: number): void } }).desk.setSpeed(Infinity));
report('the same, unthrottled', await watch(visitor, 10_000));
await visitor.leave();
await browser.close();
await server.stop();
