// SPDX-License-Identifier: MIT
// The page in Chromium: weight, start, response times, and whether it keeps real time with picture, physics and terminal.
import { availableParallelism, loadavg } from 'node:os';
import { PageServer, Visitor, startBrowser } from '../page/page-bench.ts';
import { weights } from '../page/weight.ts';

const seconds = Number(process.argv[2] ?? 60);
const LATE_MS = 50;

interface Sample {
    readonly wallMs: number;
    readonly ticks: number;
    readonly lateMs: number;
}

function weight(): void {
    const { first, physics, python, languages } = weights();
    const line = (what: string, bytes: number): void => console.log(`${what.padEnd(42)}${(bytes / 1024).toFixed(0).padStart(6)} KB`);
    line('first load with both images, compressed', first);
    line('physics, after it', physics);
    line('Python, when m512 is asked', python);
    line('a language, when it is chosen (mean)', languages / 4);
}

/** Samples of time, lateness and simulated time, reported by the page. */
async function watch(visitor: Visitor, ms: number): Promise<Sample[]> {
    return visitor.page.evaluate(
        limit =>
            new Promise<Sample[]>(resolve => {
                const samples: Sample[] = [];
                const session = (
                    document.querySelector('app-shell') as unknown as {
                        session: { onFrame(l: (s: { ticks: number; lateMs: number }) => void): () => void };
                    }
                ).session;
                const start = performance.now();
                const stop = session.onFrame(state => {
                    samples.push({ wallMs: performance.now() - start, ticks: state.ticks, lateMs: state.lateMs });
                    if (performance.now() - start < limit) return;
                    stop();
                    resolve(samples);
                });
            }),
        ms,
    );
}

function report(name: string, samples: readonly Sample[]): void {
    const [first, last] = [samples[0], samples.at(-1)];
    if (!first || !last) return;
    const wall = (last.wallMs - first.wallMs) / 1000;
    const robot = (last.ticks - first.ticks) / 128;
    const late = samples
        .filter(sample => sample.wallMs > 1000)
        .map(sample => sample.lateMs)
        .sort((a, b) => a - b);
    const part = (of: number): string => (late[Math.floor(of * (late.length - 1))] ?? 0).toFixed(0);
    console.log(
        `${name.padEnd(42)}${robot.toFixed(1)} s of the robot in ${wall.toFixed(1)} s (${(robot / wall).toFixed(2)} x), ${(samples.length / wall).toFixed(0)} states a second`,
    );
    if (late.some(ms => ms > 0)) {
        console.log(
            `${'late, after the first second'.padEnd(42)}${part(1)} ms at most, 99 of 100 states ${part(0.99)} ms, half ${part(0.5)} ms; ${late.filter(ms => ms > LATE_MS).length} of ${late.length} above ${LATE_MS} ms`,
        );
    }
}

/** The bytes on the wire until the robot stands, compressed as `serve` sends them. */
class Wire {
    private readonly sizes: Promise<number>[] = [];

    constructor(visitor: Visitor) {
        visitor.page.on('requestfinished', request => this.sizes.push(request.sizes().then(({ responseBodySize }) => responseBodySize)));
    }

    async report(): Promise<void> {
        const bytes = (await Promise.all(this.sizes)).reduce((sum, size) => sum + size, 0);
        console.log(
            `${'first load over the wire, with physics'.padEnd(42)}${(bytes / 1024 / 1024).toFixed(2).padStart(6)} MB of 4 MB in ${this.sizes.length} files`,
        );
    }
}

/** Time from Play to the first movement of the picture, for a motion that was just edited and is not in the robot. */
async function playLatency(visitor: Visitor): Promise<void> {
    await visitor.open('Motions');
    await visitor.page.getByRole('option', { name: /^motion 3 wave/ }).dblclick();
    await visitor.page.getByLabel('Time of step 1').fill('0.9');
    await visitor.page.getByLabel('Time of step 1').press('Enter');
    await visitor.untilSeen();
    const took = await visitor.page.evaluate(
        () =>
            new Promise<number>(resolve => {
                type Preview = { state: { watch(l: (s: { tick: number }) => void): () => void } };
                const { session } = document.querySelector('app-shell') as unknown as {
                    session: { preview: Preview; editor: { state: { get(): { page: number } } }; playEdited(page: number): Promise<void> };
                };
                const askedMs = performance.now();
                const stop = session.preview.state.watch(({ tick }) => {
                    if (tick === 0) return;
                    queueMicrotask(() => stop());
                    resolve(performance.now() - askedMs);
                });
                void session.playEdited(session.editor.state.get().page);
            }),
    );
    console.log(`${'Play after an edit to the first movement'.padEnd(42)}${took.toFixed(0).padStart(6)} ms of 300 ms`);
    await visitor.doing.filter({ hasText: 'Playing motion 3' }).waitFor();
    await visitor.untilStanding();
    await visitor.open('Remote');
}

/** Time from the request of the page until the robot is in the picture, and until it stands on its feet. */
async function start(name: string, visitor: Visitor): Promise<void> {
    const drawn = await visitor.untilDrawn();
    await visitor.untilStanding();
    const stands = await visitor.page.evaluate(() => performance.now());
    console.log(
        `${name.padEnd(42)}${(drawn / 1000).toFixed(2).padStart(6)} s in the picture, ${(stands / 1000).toFixed(2)} s on its own feet`,
    );
}

interface Latency {
    /** In robot time. */
    readonly robotMs: number;
    /** In wall-clock time, until the page has been told. */
    readonly pageMs: number;
}

/** Time from a key press to the first goal that moves, on the robot and in the page. Checks every tick: the first movement ends within 60
 *  ms, and a page that draws by software is told of it late. */
async function keyLatency(visitor: Visitor): Promise<void> {
    const taken: Latency[] = [];
    for (const key of ['ArrowUp', 'ArrowLeft', 'ArrowDown', 'ArrowRight', 'ArrowUp']) {
        taken.push(
            await visitor.page.evaluate(
                code =>
                    new Promise<Latency>(resolve => {
                        type Frame = { ticks: number; servos: { goalPos: number }[]; trace: Float32Array };
                        const { session } = document.querySelector('app-shell') as unknown as {
                            session: { onFrame(l: (s: Frame) => void): () => void };
                        };
                        let before: number[] | null = null;
                        let pressed = { ms: 0, tick: 0 };
                        const stop = session.onFrame(({ ticks, servos, trace }) => {
                            if (before === null) {
                                before = servos.map(({ goalPos }) => goalPos);
                                pressed = { ms: performance.now(), tick: ticks };
                                for (const type of ['keydown', 'keyup']) window.dispatchEvent(new KeyboardEvent(type, { code }));
                                return;
                            }
                            const size = 2 * before.length; // goal and position of each servo for each tick
                            const moved = trace.findIndex((value, i) => i % 2 === 0 && value !== before?.[(i % size) / 2]);
                            if (moved < 0) return;
                            stop();
                            const tick = ticks + 1 - trace.length / size + Math.floor(moved / size);
                            resolve({ robotMs: ((tick - pressed.tick) * 1000) / 128, pageMs: performance.now() - pressed.ms });
                        });
                    }),
                key,
            ),
        );
        await visitor.doing.filter({ hasText: 'Playing' }).waitFor();
        await visitor.button('Stop').click();
        await visitor.untilStanding();
    }
    const line = (what: string, of: (one: Latency) => number): void =>
        console.log(`${what.padEnd(42)}${taken.map(one => of(one).toFixed(0)).join(', ')} ms`);
    line('from a key to the first goal that moves', one => one.robotMs);
    line('until the page is told of it', one => one.pageMs);
}

const load = (): string =>
    loadavg()
        .map(value => value.toFixed(1))
        .join(' ');
console.log(`load of the machine ${load()}, ${availableParallelism()} cores`);
weight();
const [browser, server] = await Promise.all([startBrowser(), PageServer.start()]);
const visitor = await Visitor.come(browser, server.address, { keepsPage: true });
const wire = new Wire(visitor);
await start('cold start', visitor);
await wire.report();
await visitor.page.evaluate(() => navigator.serviceWorker.ready.then(() => undefined));
await visitor.page.reload();
await start('warm start', visitor);
await keyLatency(visitor);
await playLatency(visitor);
await visitor.button('Walk').click();
await visitor.open('Terminal');
report('walking, physics, picture, terminal', await watch(visitor, seconds * 1000));
await visitor.page.evaluate(() =>
    (document.querySelector('app-shell') as unknown as { session: { sim: { setSpeed(s: number): void } } }).session.sim.setSpeed(Infinity),
);
report('the same, unthrottled', await watch(visitor, 10_000));
console.log(`load of the machine ${load()}`);
await visitor.leave();
await browser.close();
await server.stop();
