// SPDX-License-Identifier: MIT
// Stop while a hand stands the robot in the page up, and a crash while somebody waits for it. The session is real; the worker is a script.
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { RobotSession } from '../app/robot-session.ts';
import type { FormatsWorker } from '../model/file-formats.ts';
import { remotePacket } from '../robot/remote.ts';
import type { FromSim, ToSim } from '../sim/messages.ts';
import { PassingStorage } from '../view/document-storage.ts';
import { TEXTS } from '../view/texts/texts.ts';
import { BODY, libraryDocument, makeFormat, makeMotion } from './motion-bench.ts';

vi.mock('../app/assets.ts', () => ({
    boardModule: () => Promise.resolve(null),
    robotImages: (image: string) => Promise.resolve({ boot: '', application: image, motions: new Uint8Array(65_536) }),
    physics: () => Promise.reject(new Error('not here')),
}));
vi.mock('../view/robot-store.ts', () => ({
    loadRobot: () => Promise.resolve(null),
    saveRobot: () => Promise.resolve(),
    forgetRobot: () => Promise.resolve(),
}));

const { format } = await makeFormat();
const library = await libraryDocument();
const WALK = 20;
const FRAME_MS = 5;
const SOON = { timeout: 20_000, interval: 5 };

const MEMORIES = { flash: new Uint8Array(0x20000), eeprom: new Uint8Array(), servos: new Uint8Array() };

/** How many pages a request for checksums is about. */
function pages(text: string): number {
    const [, first = 0, last = -1] = /@crcs (\d+) (\d+)/.exec(text) ?? [];
    return Number(last) - Number(first) + 1;
}

const isRelease = (packet: Uint8Array): boolean => packet.join() === remotePacket([]).join();

/** The worker of a robot that a hand holds while it walks in the air. A play of page 1 lasts for three questions. */
class Worker {
    static last: Worker;
    onmessage: ((event: { data: FromSim }) => void) | null = null;
    /** The requests that all workers got. */
    static readonly all: string[] = [];
    /** The next one does not answer before it is told to. */
    static startsSilent = false;
    readonly sent: string[] = [];
    isSilent = Worker.startsSilent;
    private image = '';
    private isHeld = true;
    private isPowered = true;
    private page = WALK;
    private asked = 0;
    private ticks = 0;
    private readonly timer = setInterval(() => this.sendFrame(), FRAME_MS);

    constructor() {
        Worker.last = this;
    }

    postMessage(message: ToSim): void {
        if (message.kind === 'start') this.image = message.images.application;
        if (message.kind === 'memories') setTimeout(() => this.tell({ kind: 'memories', memories: MEMORIES, id: message.id }));
        if (message.kind === 'bytes' && message.sender === 'remote') Worker.all.push(isRelease(message.bytes) ? 'release' : 'remote');
        else if (message.kind === 'hold') this.isHeld = message.held;
        else if (message.kind === 'bytes' && !this.isSilent) setTimeout(() => this.answer(String.fromCharCode(...message.bytes)));
    }

    terminate(): void {
        clearInterval(this.timer);
    }

    crash(): void {
        this.stand();
        this.tell({ kind: 'crashed', text: 'out of memory' });
    }

    /** Its time stands still. */
    stand(): void {
        this.isSilent = true;
        clearInterval(this.timer);
    }

    switchOff(): void {
        this.isPowered = false;
        this.isSilent = true;
        this.sendFrame();
    }

    print(line: string): void {
        this.tell({ kind: 'bytes', bytes: new TextEncoder().encode(`${line}\r\n`) });
    }

    /** Edit has saved a page. */
    save(): void {
        this.tell({ kind: 'memories', memories: MEMORIES, id: null });
    }

    private answer(text: string): void {
        const [request = '', word = '', page = ''] = /(@\w+) ?(\d*)/.exec(text) ?? [];
        this.sent.push(request.trim());
        Worker.all.push(request.trim());
        if (word === '@stop' || word === '@break') this.page = 0;
        if (word === '@play') [this.page, this.asked] = [Number(page), 0];
        if (word === '@where' && this.page === 1 && ++this.asked > 3) this.page = 0;
        const words: Record<string, string> = {
            '@ver': `image=${this.image} version=1.0.0 board=cm5 protocol=1 can=list,page `,
            '@crcs': `${'0000'.repeat(pages(text))} `, // none of the document's
            '@where': `state=${this.page ? 'playing' : 'idle'} page=${this.page} step=1 repetition=1 code=0 dv=96 faulty=0 `,
        };
        this.tell({ kind: 'bytes', bytes: new TextEncoder().encode(`\x1e${word} ${words[word] ?? ''}OK\r\n`) });
    }

    private sendFrame(): void {
        this.ticks += 4;
        const trunk = { pos: [0, 0, 0.3], quat: [1, 0, 0, 0] } as const;
        const { ticks, isHeld, isPowered } = this;
        const state = {
            ticks,
            servos: [],
            trunk,
            leds: 0,
            isPowered,
            isHeld,
            hasFallen: false,
            lateMs: 0,
            trace: new Float32Array(),
        };
        this.tell({ kind: 'state', state });
    }

    private tell(data: FromSim): void {
        this.onmessage?.({ data });
    }
}

beforeEach(() => {
    Worker.all.length = 0;
    Worker.startsSilent = false;
    vi.stubGlobal('Worker', Worker);
    vi.stubGlobal('navigator', {});
    vi.stubGlobal('document', { hidden: false, addEventListener: () => undefined });
    vi.stubGlobal('requestAnimationFrame', () => 0);
});
afterEach(() => {
    Worker.last.terminate();
    vi.unstubAllGlobals();
});

async function page() {
    const parts = { format, player: await makeMotion(), document: library };
    const formats = { cancel: () => undefined } as unknown as FormatsWorker;
    const session = new RobotSession(BODY, parts, formats, { storage: new PassingStorage(), isKept: true });
    const said: string[] = []; // here physics never comes, which each new robot says
    session.state.watch(({ message }) => message && !/^Physics/.test(message.text) && said.push(message.text));
    await session.documents.start(library);
    await session.start();
    return { session, said, worker: Worker.last, plays: () => Worker.last.sent.filter(text => text.startsWith('@play')) };
}

/** What the promise resolves to, or that it did not in time. */
const within = (ms: number, promise: Promise<unknown>): Promise<unknown> =>
    Promise.race([promise, new Promise(resolve => setTimeout(() => resolve(`nothing came within ${ms} ms`), ms))]);

test('what the robot did in the air goes on when it stands', async () => {
    const { plays } = await page();
    await vi.waitFor(() => expect(plays()).toEqual(['@play 1', `@play ${WALK}`]), SOON);
});

const typed =
    (text: string) =>
    (session: RobotSession): void =>
        session.type(new TextEncoder().encode(text));

/** By these a person takes the robot over. */
const TAKEN: readonly (readonly [string, (session: RobotSession) => unknown])[] = [
    ['Stop', session => session.command('stop')],
    ['a typed line', typed('break\r')],
    ["Edit's space bar", typed(' ')],
    ["the panel's Start", session => session.sim.press('start', true)],
];

test.each(TAKEN)('%s: neither that nor a motion that waits begins afterwards, and nobody follows', async (_, take) => {
    const { session, worker, plays, said } = await page();
    await vi.waitFor(() => expect(plays()).toEqual(['@play 1']), SOON);
    const waits = session.play(2);
    const stopped = vi.fn();
    session.onStop(stopped);
    await take(session);
    const asked = worker.sent.length;
    await vi.waitFor(() => expect(worker.sent.length).toBeGreaterThan(asked + 4), SOON);
    expect(plays()).toEqual(['@play 1']);
    expect(await waits).toBe(false);
    expect(said).toContain('Stopped.');
    expect(stopped).toHaveBeenCalledTimes(1);
});

test('a line that was typed just before may have begun what the robot does in the air: that goes on when it stands', async () => {
    const { session, plays } = await page();
    await new Promise<void>(resolve => session.state.watch(({ connection }) => connection === 'ready' && resolve()));
    typed('play walk\r')(session); // the hand has begun to stand it up, and has asked nothing yet
    await vi.waitFor(() => expect(plays()).toEqual(['@play 1', `@play ${WALK}`]), SOON);
});

test('half a line, and what the terminal answers by itself, take nothing over; a key of the remote ends what follows', async () => {
    const { session, plays } = await page();
    await vi.waitFor(() => expect(plays()).toEqual(['@play 1']), SOON);
    const stopped = vi.fn();
    session.onStop(stopped);
    typed('pla\x1b[35;80R')(session);
    session.sim.press('start', false);
    session.remote(new Set());
    expect(stopped).not.toHaveBeenCalled();
    await vi.waitFor(() => expect(plays()).toEqual(['@play 1', `@play ${WALK}`]), SOON);
    session.remote(new Set(['up']));
    session.remote(new Set());
    expect(stopped).toHaveBeenCalledTimes(1);
});

test('a robot that crashes ends what is asked of it', async () => {
    const { session, worker, plays } = await page();
    await vi.waitFor(() => expect(plays()).toHaveLength(2), SOON);
    worker.isSilent = true; // it does not answer any more
    const waiting = Promise.all([session.play(2), session.transfer.read()]);
    worker.crash();
    expect(await within(3000, waiting)).toMatchObject([false, { isDone: false }]);
    expect(session.state.get().message?.text).not.toMatch(/No robot is connected/);
    expect(await within(3000, session.play(2))).toBe(false);
});

test('a robot that crashes as it starts: the motion of a link does not loop for ever', async () => {
    const { session, worker } = await page();
    worker.isSilent = true;
    const ran = session.run(2);
    worker.crash();
    expect(await within(3000, ran)).toBeUndefined();
    expect(session.preview.state.get().isLooping).toBe(false);
});

test('a motion of a link on a robot that is off: it is said, and the motion does not loop', async () => {
    const { session, worker } = await page();
    worker.isSilent = true;
    session.state.set({ isPowered: false });
    expect(await within(3000, session.run(2))).toBeUndefined();
    expect(session.preview.state.get().isLooping).toBe(false);
    expect(session.state.get().message?.text).toMatch(/switched off/);
});

test('a reading of a robot whose time stands still can be stopped', async () => {
    const { session, worker, plays } = await page();
    await vi.waitFor(() => expect(plays()).toHaveLength(2), SOON);
    worker.stand();
    const reading = session.transfer.read();
    session.transfer.cancel();
    expect(await within(3000, reading)).toMatchObject({ isDone: false, error: { code: 'cancelled' } });
});

test('a motion that is saved in Edit of the robot in the page: the list of its motions is asked for again', async () => {
    const { worker, plays } = await page();
    await vi.waitFor(() => expect(plays()).toHaveLength(2), SOON);
    const lists = (): number => worker.sent.filter(text => text.startsWith('@list')).length;
    const before = lists();
    worker.save();
    await vi.waitFor(() => expect(lists()).toBe(before + 1), SOON);
});

test.each([
    ['', () => undefined],
    [', its time stands still', (worker: Worker) => worker.stand()],
])('switched off while it walks%s: nothing says any more what it does or that it does not answer', async (_, stand) => {
    const { session, worker, plays, said } = await page();
    await vi.waitFor(() => expect(plays()).toHaveLength(2), SOON);
    await vi.waitFor(() => expect(session.state.get().where?.state).toBe('playing'), SOON);
    worker.print('Paused');
    await vi.waitFor(() => expect(session.state.get().message?.text).toBe('Paused'), SOON);
    worker.isSilent = true;
    void session.transfer.read(); // is under way
    const shown = new Set<string>(); // a screen reader is told each
    session.state.watch(({ isPowered, doing }) => isPowered || shown.add(doing.text));
    worker.switchOff();
    stand(worker);
    const isOff = { where: null, version: null, message: null, doing: { text: TEXTS.status.isOff } };
    expect(session.state.get()).toMatchObject(isOff);
    await new Promise(resolve => setTimeout(resolve, 2000)); // more than ten seconds of the robot
    expect(session.state.get()).toMatchObject(isOff);
    expect(said).toEqual(['Paused']);
    expect([...shown]).toEqual([TEXTS.status.isOff]);
});

/** What switches the robot off, resets it, or makes another one of it. */
const RESTARTS: readonly (readonly [string, (session: RobotSession) => unknown])[] = [
    ['Power off', session => session.sim.setPower(false)],
    ['MODE', session => session.sim.press('mode', true)],
    ['a restart', session => session.runImage('play')],
    ['Factory fresh', session => session.forget()],
];

/** Until the robot that runs now has answered often. */
async function untilQuiet(): Promise<void> {
    await vi.waitFor(() => expect(Worker.last.sent.filter(text => text.startsWith('@where')).length).toBeGreaterThan(12), SOON);
}

test.each(RESTARTS)('%s while a motion waits for the robot to stand: it never plays, and it is said', async (_, restart) => {
    const { session, plays, said } = await page();
    await vi.waitFor(() => expect(plays()).toEqual(['@play 1']), SOON);
    const asked = session.play(2);
    void restart(session);
    expect(await within(3000, asked)).toBe(false);
    await untilQuiet();
    expect(Worker.all).not.toContain('@play 2');
    expect(said.at(-1)).toMatch(/^Not done: the robot was switched off/);
});

const STOPS: typeof RESTARTS = [
    ['Stop', session => session.command('stop')],
    ['B6', session => [['b6'] as const, []].map(held => session.remote(new Set(held)))],
    ["the panel's Start", session => session.sim.press('start', true)],
    ...RESTARTS,
];

test.each(STOPS)('%s while a pasted text is being sent: the rest of it is not, and it is said', async (_, stop) => {
    const { session, said } = await page();
    await vi.waitFor(() => expect(session.state.get().connection).toBe('ready'), SOON);
    session.type(new TextEncoder().encode('walk\r'.repeat(1000)));
    const sent = (): number => Worker.all.filter(text => text === '').length; // no request
    await vi.waitFor(() => expect(sent()).toBeGreaterThan(2), SOON);
    void stop(session);
    await vi.waitFor(() => expect(said.join()).toContain('the rest of the pasted text was not sent'), SOON);
    const before = sent();
    await new Promise(resolve => setTimeout(resolve, 200));
    expect(sent() - before).toBeLessThan(2);
});

test.each(RESTARTS)('%s while a key and the motion of a link wait: neither moves it, and it is said', async (_, restart) => {
    const { session, plays, said } = await page();
    await vi.waitFor(() => expect(plays()).toEqual(['@play 1']), SOON);
    session.state.set({ physics: 'loading' });
    const ran = session.run(2);
    session.remote(new Set(['up']));
    session.remote(new Set());
    void restart(session);
    session.state.set({ physics: 'off' });
    expect(await within(3000, ran)).toBeUndefined();
    await untilQuiet();
    expect(Worker.all).not.toContain('@play 2');
    expect(Worker.all).not.toContain('remote');
    expect(said.at(-1)).toMatch(/^Not done: the robot was switched off/);
});

test.each(RESTARTS)('%s while Edit starts to take a motion that is to be played: it is neither written nor played', async (_, restart) => {
    const { session, worker, plays } = await page();
    await vi.waitFor(() => expect(plays()).toHaveLength(2), SOON);
    Worker.startsSilent = true;
    const asked = session.playEdited(2);
    await vi.waitFor(() => expect(Worker.last).not.toBe(worker), SOON); // it restarts with Edit
    Worker.startsSilent = false;
    void restart(session);
    expect(await within(3000, asked)).toBeUndefined();
    Worker.last.isSilent = false;
    await untilQuiet();
    expect(session.transfer.isWriting).toBe(false);
    expect(Worker.all.filter(text => /^@(open|data|save|play 2$)/.test(text))).toEqual([]);
});
