// SPDX-License-Identifier: MIT
// Another robot is chosen, or the page is hidden, while something for the robot is under way: nothing of it reaches the next robot, and
// nobody holds a key of a hidden page. The session is real; both robots answer from a script.
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { RobotSession } from '../app/robot-session.ts';
import { ServosSource } from '../app/servos-source.ts';
import { SimulatedSource } from '../app/simulated-source.ts';
import type { FormatsWorker } from '../model/file-formats.ts';
import { wallClock } from '../robot/clock.ts';
import { Connection } from '../robot/connection.ts';
import { remotePacket } from '../robot/remote.ts';
import type { RemoteButton } from '../robot/remote.ts';
import { BytePort } from '../sim/byte-port.ts';
import { PassingStorage } from '../view/document-storage.ts';
import { TEXTS } from '../view/texts/texts.ts';
import { BODY, libraryDocument, makeFormat, makeMotion } from './motion-bench.ts';

vi.mock('../app/assets.ts', () => ({}));

const { format } = await makeFormat();
const library = await libraryDocument();
const open: Connection[] = [];
const tab = {
    hidden: false,
    looks: [] as (() => void)[],
    addEventListener: (_: string, look: () => void) => void tab.looks.push(look),
};

/** A robot whose flash has no motions. sent: the words of all requests, and `remote` for a packet of the remote, which packets has. aim,
 *  state: as in `@where`. */
function scripted(image: 'play' | 'edit', aim = '00000000', state = 'idle') {
    const sent: string[] = [];
    const packets: string[] = [];
    const crc = format.crc(format.empty).toString(16).padStart(4, '0');
    const answers: Record<string, string> = {
        '@ver': `image=${image} version=1.0.0 board=cm5 protocol=1 can=list,page${image === 'edit' ? ',save' : ''}`,
        '@where': `state=${state} page=0 step=0 repetition=0 code=0 dv=96 faulty=0 aim=${aim}`,
        '@crc': crc,
        '@list': '20:4:"walk"',
    };
    const port = new BytePort('a robot', bytes => {
        const text = String.fromCharCode(...bytes);
        const word = /@\w+/.exec(text)?.[0] ?? 'remote';
        const [, first, last] = /@crcs (\d+) (\d+)/.exec(text) ?? [];
        const words = word === '@crcs' ? crc.repeat(Number(last) - Number(first) + 1) : (answers[word] ?? '');
        sent.push(word);
        const answer = new TextEncoder().encode(`\x1e${word} ${words}${words && ' '}OK\r\n`);
        if (word === 'remote') packets.push(bytes.join());
        else setTimeout(() => port.push(answer), 5);
    });
    return { port, sent, packets, answers };
}

beforeEach(() => {
    Object.assign(tab, { hidden: false, looks: [] });
    vi.stubGlobal('document', tab);
    vi.stubGlobal('requestAnimationFrame', () => 0);
});
afterEach(async () => {
    for (const connection of open.splice(0)) await connection.close();
    vi.restoreAllMocks();
    vi.unstubAllGlobals();
});

/** The page with its own robot, which runs Play and answers. Yours runs `image`. */
async function page(image: 'play' | 'edit', aim?: string) {
    const inPage = scripted('play');
    const yours = scripted(image, aim);
    const port = Object.assign(yours.port, { getInfo: () => ({}) });
    vi.stubGlobal('navigator', { serial: { getPorts: () => Promise.resolve([port]), addEventListener: () => undefined } });
    vi.spyOn(SimulatedSource.prototype, 'start').mockImplementation(async function (this: SimulatedSource) {
        const connection = new Connection(inPage.port, wallClock, {
            state: state =>
                session.state.get().source === 'simulated' && session.state.set({ connection: state, version: connection.version }),
            text: () => undefined,
        });
        open.push(connection);
        this.connection = connection;
        connection.connect();
    });
    let stand = (): void => undefined;
    vi.spyOn(SimulatedSource.prototype, 'prepare').mockReturnValue(new Promise(resolve => (stand = resolve)));
    vi.spyOn(SimulatedSource.prototype, 'restart').mockReturnValue(Promise.resolve());
    const parts = { format, player: await makeMotion(), document: library };
    const formats = { cancel: () => undefined } as unknown as FormatsWorker;
    const session = new RobotSession(BODY, parts, formats, { storage: new PassingStorage(), isKept: true });
    await session.documents.start(library);
    await session.start();
    session.state.set({ physics: 'on' });
    await vi.waitFor(() => expect(session.state.get().connection).toBe('ready'));
    const connect = async (): Promise<void> => {
        await session.connectYours();
        await vi.waitFor(() => expect(session.state.get()).toMatchObject({ source: 'yours', connection: 'ready' }));
    };
    return { session, yours, inPage, connect, stand: () => stand() };
}

/** Enough for all answers of a script. */
const soon = (): Promise<void> => new Promise(resolve => setTimeout(resolve, 400));

test('a motion that waited for the robot in the page to stand up does not play on yours', async () => {
    const { session, yours, connect, stand } = await page('play');
    void session.play(2);
    await connect();
    stand();
    await soon();
    expect(yours.sent).not.toContain('@play');
});

test('the terminal of another robot begins empty', async () => {
    const { session, connect } = await page('play');
    let text = '';
    session.onText(bytes => (text += new TextDecoder().decode(bytes)));
    await connect();
    expect(text.startsWith('\x1bc')).toBe(true);
    text = '';
    session.useSimulated();
    expect(text).toBe('\x1bc');
});

test('My servos become the robot in use while the page asks whether its robot is to forget everything: neither forgets', async () => {
    const { session } = await page('play');
    const forget = vi.spyOn(SimulatedSource.prototype, 'forget').mockResolvedValue();
    session.state.set({ source: 'servos', connection: 'closed' });
    await session.forget();
    expect(forget).not.toHaveBeenCalled();
    expect(session.state.get().message?.text).toBe(TEXTS.robotPane.onlyInPage);
    session.state.set({ source: 'simulated' });
    await session.forget();
    expect(forget).toHaveBeenCalledTimes(1);
});

test('who leaves the page is asked if a robot of the page would lose something', async () => {
    const { session } = await page('play');
    expect(session.losesWork).toBe(false);
    for (const unkept of ['hasUnkept', 'hasUnkeptServos'] as const) {
        session.state.set({ [unkept]: true });
        expect(session.losesWork).toBe(true);
        session.state.set({ [unkept]: false });
    }
    const { version } = session.state.get();
    session.state.set({ image: 'edit', version: version && { ...version, image: 'edit' } });
    session.type(new TextEncoder().encode('n'));
    expect(session.losesWork).toBe(true);
    await vi.waitFor(() => expect(session.losesWork).toBe(false), { timeout: 10_000 }); // its page is empty
});

test('a key that waited for the robot in the page does not move yours', async () => {
    const { session, yours, connect, stand } = await page('play');
    session.state.set({ connection: 'asking' });
    session.remote(new Set(['up']));
    session.remote(new Set());
    await connect();
    stand();
    await soon();
    expect(yours.sent).not.toContain('remote');
});

test('pages on their way into the robot in the page are not written into yours, which is read and backed up', async () => {
    const { session, yours, connect, stand } = await page('edit');
    void session.playEdited(2);
    await vi.waitFor(() => expect(session.transfer.state.get().phase).toBe('writing')); // Edit starts
    await connect();
    stand();
    await soon();
    for (const word of ['@open', '@data', '@save', '@play']) expect(yours.sent).not.toContain(word);
    expect(session.documents.state.get().backups.map(({ robot }) => robot)).toHaveLength(1);
    await session.transfer.tryAgain();
    expect(yours.sent).not.toContain('@open');
});

test('who follows live is told to stop', async () => {
    const { session, connect } = await page('edit');
    const stopped = vi.fn();
    session.onStop(stopped);
    await connect();
    expect(stopped).toHaveBeenCalledTimes(1);
    session.useSimulated();
    expect(stopped).toHaveBeenCalledTimes(2);
});

test.each([
    ['another area is opened', (session: RobotSession) => session.show('pages'), 1],
    ['the other area of steps is opened', (session: RobotSession) => session.show('curves'), 0],
    ['a motion is played', (session: RobotSession) => session.play(2), 1],
    ['the edited motion is played', (session: RobotSession) => session.playEdited(2), 1],
    ['another document is opened', (session: RobotSession) => session.documents.create('other', library), 1],
] as const)('who follows live is told when %s: nothing moves the robot when the steps are seen again', async (_, leave, times) => {
    const { session } = await page('play');
    session.show('steps');
    const ended = vi.fn();
    session.follow(null, ended); // a motion without steps
    void leave(session);
    await soon();
    expect(ended).toHaveBeenCalledTimes(times);
});

test('yours chosen again, and twice at once: its port is opened anew', async () => {
    const { session, connect } = await page('play');
    await connect();
    await connect();
    await Promise.all([connect(), connect()]);
    await soon();
    expect(session.state.get().connection).toBe('ready');
});

test('a page that is hidden lets go of the stick and of the keys', async () => {
    const { session, yours, connect } = await page('play');
    await connect();
    await vi.waitFor(() => expect(session.state.get().pages).toHaveLength(1));
    session.drive({ x: 0, y: 1 });
    session.remote(new Set(['up']));
    await vi.waitFor(() => expect(yours.sent).toContain('@drive'));
    tab.hidden = true;
    for (const look of tab.looks) look();
    await vi.waitFor(() => expect(yours.sent).toContain('@stop'));
    const before = yours.sent.length;
    await soon();
    expect(yours.sent.slice(before)).not.toContain('@drive');
    expect(yours.sent.slice(before)).not.toContain('remote');
});

test.each([
    ['swings by code', '00000004', true],
    ['stands', '00000000', false],
])('your robot that is left for the one in the page while it %s: it is said that it goes on', async (_, aim, isSaid) => {
    const { session, connect } = await page('play', aim);
    await connect();
    await vi.waitFor(() => expect(session.state.get().where).toMatchObject({ aimed: Number.parseInt(aim, 16) }));
    session.useSimulated();
    expect(session.state.get().message?.text === TEXTS.robot.errors['goes-on']).toBe(isSaid);
});

/** The page drives servos. */
async function servos(aim?: string, state?: string) {
    const { session } = await page('play');
    const { port, sent, answers } = scripted('play', aim, state);
    vi.spyOn(ServosSource.prototype, 'choose').mockResolvedValue(true);
    vi.spyOn(ServosSource.prototype, 'start').mockResolvedValue();
    vi.spyOn(ServosSource.prototype, 'close').mockResolvedValue();
    vi.spyOn(ServosSource.prototype, 'connect').mockReturnValue();
    const connection = new Connection(port, wallClock, { state: () => undefined, text: () => undefined });
    open.push(connection);
    vi.spyOn(ServosSource.prototype, 'connection', 'get').mockReturnValue(connection);
    connection.connect();
    await session.connectServos();
    await vi.waitFor(() => expect(connection.state).toBe('ready'));
    const hide = (isHidden: boolean): void => {
        tab.hidden = isHidden;
        for (const look of tab.looks) look();
    };
    return { session, sent, answers, hide };
}

test.each([
    ['swing by code', '00000004', 'idle', true],
    ['get ready for a play', '00000000', 'ready', true],
    ['stand in a play that is paused', '00000000', 'paused', false],
    ['stand', '00000000', 'idle', false],
])('a hidden page ends what My servos do: they %s', async (_, aim, state, ends) => {
    const { session, sent, hide } = await servos(aim, state);
    hide(true);
    await soon();
    expect(sent.includes('@break')).toBe(ends);
    hide(false);
    expect(session.state.get().message?.text).toBe(ends ? TEXTS.robot.errors['was-hidden'] : undefined);
});

test('another robot is not chosen while the Edit of My servos, which would end, has edits', async () => {
    const { session, answers } = await servos();
    const version = { version: '1.0.0', board: 'pc', protocol: 1, can: new Set<string>(), image: 'edit' };
    session.state.set({ connection: 'ready', image: 'edit', version });
    for (const [crc, source] of [
        ['1234', 'servos'], // of no page that is stored
        [answers['@crc'] ?? '', 'simulated'],
    ] as const) {
        answers['@crc'] = crc;
        session.state.set({ message: null });
        await session.connectServos(); // the same adapter once more
        session.useSimulated();
        await soon();
        expect(session.state.get().source).toBe(source);
        expect(session.state.get().message?.text).toBe(source === 'servos' ? TEXTS.robot.errors['page-unsaved'] : undefined);
    }
});

test('a motion that waits until My servos are found does not begin in a hidden page', async () => {
    const { session, sent, hide } = await servos();
    session.state.set({ connection: 'asking' });
    void session.run(2);
    hide(true);
    session.state.set({ connection: 'ready' });
    await soon();
    expect(sent).not.toContain('@crcs'); // which comes before it is played
    hide(false);
    expect(session.state.get().message?.text).toBe(TEXTS.robot.errors['was-hidden']);
});

test('the time of the robot in the page stands still; yours has its own, and the page sees what it does', async () => {
    const { session, yours, connect } = await page('play');
    session.sim.setSpeed(0);
    const pose = Array.from({ length: 31 }, (_, id) => (id === 3 ? 600 : null));
    session.follow(pose); // it never answers
    await connect();
    await soon();
    expect(yours.sent).toContain('@where');
    expect(session.state.get().where).not.toBeNull();
    session.follow(pose);
    await vi.waitFor(() => expect(yours.sent).toContain('@move'));
});

test('Stop right after Play: the picture does not begin to move when the robot has not begun in time', async () => {
    const { session } = await page('play');
    session.editor.setRobot(library.pages); // nothing is to be written: the picture waits a moment for the robot
    void session.playEdited(2);
    await session.command('stop');
    await soon();
    expect(session.preview.state.get().isRunning).toBe(false);
});

test('a board that is not known yet gets no key of the remote, which it might take for typing, but it is told to stop', async () => {
    const { session } = await page('play');
    let got = '';
    const deaf = Object.assign(new BytePort('a board', bytes => (got += String.fromCharCode(...bytes))), { getInfo: () => ({}) });
    vi.stubGlobal('navigator', { serial: { getPorts: () => Promise.resolve([deaf]), addEventListener: () => undefined } });
    await session.connectYours();
    await vi.waitFor(() => expect(session.state.get().connection).toBe('silent'), { timeout: 10_000 });
    session.remote(new Set(['up']));
    session.remote(new Set());
    session.remote(new Set(['b6']));
    session.remote(new Set());
    await vi.waitFor(() => expect(got).toContain('@stop'), { timeout: 10_000 });
    expect(got).not.toContain('\xff\x55');
    expect(await session.transfer.write([2])).toMatchObject({ isDone: false, error: { code: 'no-answer' } }); // nobody knows of a Play
});

test('a port that another program has is said to be busy; one whose cable was pulled is said to be unplugged, also when it was tried again', async () => {
    const { session, yours } = await page('play');
    const refuse = vi.fn(() => Promise.reject(new DOMException('Failed to open serial port.', 'NetworkError')));
    const busy = Object.assign(new BytePort('a board', () => undefined), { getInfo: () => ({}), open: refuse });
    const use = (port: object): void => {
        vi.stubGlobal('navigator', { serial: { getPorts: () => Promise.resolve([port]), addEventListener: () => undefined } });
    };
    const says = (): string => session.state.get().doing.text;
    use(busy);
    await session.connectYours();
    await vi.waitFor(() => expect(session.state.get().connection).toBe('waiting'));
    expect(says()).toMatch(/Close the other program/);
    session.useSimulated();
    use(yours.port);
    await session.connectYours();
    await vi.waitFor(() => expect(session.state.get().connection).toBe('ready'));
    yours.port.open = refuse;
    refuse.mockClear();
    yours.port.unplug();
    await vi.waitFor(() => expect(refuse).toHaveBeenCalled());
    await vi.waitFor(() => expect(session.state.get().connection).toBe('waiting'));
    expect(says()).toMatch(/unplugged/);
    await session.command('stop');
    expect(session.state.get().message?.text).toMatch(/cable was pulled/);
    await session.connectYours(); // its port is the right one: the browser does not ask for another, which it could not here
    expect(session.state.get().message?.text ?? '').not.toMatch(/other program/);
});

/** Yours walks by the stick; `stop` ends it. Resolves to the words that it got from then on, but questions. */
async function walked(stop: (session: RobotSession) => unknown): Promise<string[]> {
    const { session, yours, connect } = await page('play');
    await connect();
    await vi.waitFor(() => expect(session.state.get().pages).toHaveLength(1));
    session.drive({ x: 0, y: 1 });
    await vi.waitFor(() => expect(yours.sent).toContain('@drive'));
    const before = yours.sent.length;
    void stop(session);
    await soon();
    return yours.sent.slice(before).filter(word => !['@where', '@pose', '@crcs', '@drive'].includes(word));
}

test.each([
    ['Stop', (session: RobotSession) => session.command('stop'), ['@stop']],
    ['Break', (session: RobotSession) => session.command('break'), ['@break']],
    ['torque off', (session: RobotSession) => session.setTorque(false), ['@torque', '@stop']],
    ['the stick, let go', (session: RobotSession) => session.drive(null), ['@stop']],
] as const)('a walk by the stick, ended by %s: it is stopped once, or it would be broken off in mid step', async (_, stop, words) => {
    expect(await walked(stop)).toEqual(words);
});

test('button 6 for a robot on a line is a Stop that is answered, once; a key that was down with it counts again when it was let go', async () => {
    const { session, yours, connect } = await page('play');
    await connect();
    await soon();
    const stops = (): number => yours.sent.filter(word => word === '@stop').length;
    const presses = (): number => yours.packets.filter(packet => packet !== remotePacket([]).join()).length;
    const hold = async (...held: RemoteButton[]): Promise<void> => {
        session.remote(new Set(held));
        await new Promise(resolve => setTimeout(resolve, 250)); // a key that is held is repeated
    };
    for (const held of [['b6'], ['b6', 'up'], ['up'], []] as const) await hold(...held);
    expect([stops(), presses()]).toEqual([1, 0]);
    await hold('up');
    const pressed = presses();
    expect(pressed).toBeGreaterThan(1);
    for (const held of [['up', 'b6'], ['up']] as const) await hold(...held);
    expect([stops(), presses()]).toEqual([2, pressed]);
    await hold();
    await hold('up');
    expect(presses()).toBeGreaterThan(pressed);
});

test('button 6 held while the robot in the page became ready is let go for all robots; held while the cable was out, it stops behind it', async () => {
    const { session, yours, connect } = await page('play');
    session.state.set({ connection: 'asking' });
    session.remote(new Set(['b6']));
    session.state.set({ connection: 'ready' });
    session.remote(new Set());
    await connect();
    await soon();
    const stops = (): number => yours.sent.filter(word => word === '@stop').length;
    const before = stops();
    session.remote(new Set(['b6']));
    await vi.waitFor(() => expect(stops()).toBe(before + 1));
    await connect(); // anew
    await vi.waitFor(() => expect(stops()).toBe(before + 2));
});

test('motions were written to yours: its list is asked for again', async () => {
    const { session, yours, connect } = await page('edit');
    await connect();
    await vi.waitFor(() => expect(session.state.get().message?.text).toContain('backup'));
    const lists = (): number => yours.sent.filter(word => word === '@list').length;
    const before = lists();
    await session.transfer.write([]);
    await vi.waitFor(() => expect(lists()).toBe(before + 1));
});

test('Play pressed twice while the robot stands up: it plays once, and nobody says that it was stopped', async () => {
    const { session, inPage, stand } = await page('play');
    const said: (string | undefined)[] = [];
    session.state.watch(({ message }) => said.push(message?.text));
    void session.play(2);
    void session.play(2);
    stand();
    await vi.waitFor(() => expect(inPage.sent).toContain('@play'));
    await soon();
    expect(inPage.sent.filter(word => word === '@play')).toHaveLength(1);
    expect(said).not.toContain('Stopped.');
});

test('a motion from a link does not begin behind a Stop, nor behind another motion that somebody looks at meanwhile', async () => {
    const { session, inPage } = await page('play');
    session.state.set({ connection: 'asking' });
    void session.run(2);
    await session.command('stop');
    session.preview.start(2); // shown once more
    void session.run(3);
    session.preview.start(2);
    session.state.set({ connection: 'ready' });
    await soon();
    expect(session.preview.state.get().isLooping).toBe(false);
    expect(inPage.sent).not.toContain('@crcs'); // the first question of every play
});

test('yours walks by the stick when the robot in the page is chosen: nobody says that no robot is connected', async () => {
    const { session, yours, connect } = await page('play');
    await connect();
    await vi.waitFor(() => expect(session.state.get().pages).toHaveLength(1));
    session.drive({ x: 0, y: 1 });
    await vi.waitFor(() => expect(yours.sent).toContain('@drive'));
    const said: (string | undefined)[] = [];
    session.state.watch(({ message }) => said.push(message?.text));
    session.useSimulated();
    await soon();
    expect(session.state.get()).toMatchObject({ source: 'simulated', connection: 'ready' });
    expect(said.filter(text => text?.includes('No robot is connected'))).toEqual([]);
});

test('nothing answers at the port: chosen again, the browser lets the person choose another one', async () => {
    const { session, yours } = await page('play');
    const deaf = Object.assign(new BytePort('an adapter without a board', () => undefined), { getInfo: () => ({}) });
    const requestPort = vi.fn(() => Promise.resolve(yours.port));
    const getPorts = () => Promise.resolve([deaf, yours.port]);
    vi.stubGlobal('navigator', { serial: { getPorts, requestPort, addEventListener: () => undefined } });
    await session.connectYours();
    await session.connectYours(); // a double click is no second choice
    await vi.waitFor(() => expect(session.state.get().connection).toBe('silent'), { timeout: 10_000 });
    expect(requestPort).not.toHaveBeenCalled();
    await session.connectYours();
    await vi.waitFor(() => expect(session.state.get().connection).toBe('ready'), { timeout: 10_000 });
    expect(requestPort).toHaveBeenCalledTimes(1);
});

test('Edit cannot be had for the robot in the page, which is known when yours is used already: the page knows that Play runs', async () => {
    const { session, connect } = await page('play');
    let offline = (_: Error): void => undefined;
    vi.mocked(SimulatedSource.prototype.restart).mockReturnValue(new Promise((_, reject) => (offline = reject)));
    session.runImage('edit');
    await connect();
    offline(new TypeError('Failed to fetch'));
    await soon();
    session.useSimulated();
    expect(session.state.get().image).toBe('play'); // otherwise a key would wait for Edit
});

test('the servo adapter is back: that torque is to be switched on is said until the page has done that', async () => {
    const { session, yours, connect } = await page('edit');
    await connect();
    session.state.set({ adapter: 'back' });
    await session.setTorque(false, [3]);
    await vi.waitFor(() => expect(session.state.get().doing.text).toContain('adapter is back'));
    await session.setTorque(true, [3]);
    expect(yours.sent.filter(word => word === '@torque')).toHaveLength(2);
    expect(session.state.get().doing.text).not.toContain('adapter is back');
});

test('a paste of a whole file reaches no robot, and it is said', async () => {
    const { session, inPage } = await page('play');
    const before = inPage.sent.length;
    session.type(new Uint8Array(65_537).fill(0x41));
    await soon();
    expect(inPage.sent.slice(before)).not.toContain('remote');
    expect(session.state.get().message?.text).toMatch(/longer than 64 KB/);
    session.type(new Uint8Array(65_536).fill(0x41));
    await vi.waitFor(() => expect(inPage.sent).toContain('remote'));
});
