// SPDX-License-Identifier: MIT
// Requests to the real firmware on the simulated board, in simulated time. The bytes are split at random.
import { afterEach, expect, test } from 'vitest';
import type { Shape } from '../model/motion.ts';
import { Connection } from '../robot/connection.ts';
import type { ConnectionState } from '../robot/connection-table.ts';
import { Line } from '../robot/line.ts';
import {
    aim,
    askDensePage,
    askList,
    askPage,
    askPose,
    askVersion,
    askWhere,
    command,
    drive,
    free,
    movePose,
    play,
    resetShape,
    setAmplitude,
    setBlend,
    setLayer,
    setRate,
    setTorque,
    swing,
} from '../robot/protocol.ts';
import { remotePacket } from '../robot/remote.ts';
import { RobotError } from '../robot/robot-error.ts';
import { Requests } from '../robot/requests.ts';
import type { RequestOptions } from '../robot/requests.ts';
import { BytePort } from '../sim/byte-port.ts';
import { makeFormat } from './motion-bench.ts';
import { RobotBench, SimulatedClock, robotImages, settle } from './robot-bench.ts';

const { format } = await makeFormat();
const crcOf = (bytes: Uint8Array): number => format.crc(bytes);
const open: Connection[] = [];
afterEach(async () => {
    for (const connection of open.splice(0)) await connection.close();
});

async function connect(bench: RobotBench) {
    const states: ConnectionState[] = [];
    const versions: (string | undefined)[] = [];
    const heard: number[] = [];
    const connection: Connection = new Connection(bench.port, bench.clock, {
        state: state => {
            states.push(state);
            versions.push(connection.version?.image);
        },
        text: bytes => heard.push(...bytes),
    });
    open.push(connection);
    connection.connect();
    return { connection, states, versions, text: () => String.fromCharCode(...heard) };
}

async function ready(image: 'play' | 'edit', seed: number) {
    const bench = await RobotBench.make(image, seed);
    const link = await connect(bench);
    for (let i = 0; i < 200 && link.connection.state !== 'ready'; i++) await bench.run(50);
    expect(link.connection.state, `seed ${seed}`).toBe('ready');
    return { bench, ...link };
}

test.each([
    ['play', 11],
    ['edit', 12],
] as const)('%s: the questions of the protocol', async (image, seed) => {
    const { bench, connection } = await ready(image, seed);
    const requests = connection.requests;
    await bench.run(2000); // the firmware reads the voltage after the start
    expect(connection.version).toMatchObject({ image, board: 'cm5', protocol: 1 });
    expect(connection.version?.can.has('save')).toBe(image === 'edit');
    expect(await bench.until(askWhere(requests))).toMatchObject({ state: 'idle', batteryVolts: 9.6, faulty: 0 });
    const pose = await bench.until(askPose(requests));
    expect(pose.map(joint => joint.id)).toEqual(Array.from({ length: 18 }, (_, i) => i + 1));
    expect(pose[0]).toEqual({ id: 1, position: 512, torque: false });
    const list = await bench.until(askList(requests));
    expect(list).toContainEqual({ page: 2, name: 'bow', steps: expect.any(Number), fault: '' });
    const { motions } = await robotImages('play');
    for (const page of [2, 100]) {
        expect(await bench.until(askPage(requests, page, crcOf))).toEqual(motions.slice(page * 512, page * 512 + 512));
        expect(await bench.until(askDensePage(requests, page, crcOf))).toEqual(motions.slice(page * 512, page * 512 + 512));
    }
});

test('many questions at once are answered in their order', async () => {
    const { bench, connection } = await ready('play', 13);
    const answers = await bench.until(
        Promise.all([
            askWhere(connection.requests),
            askPose(connection.requests),
            askVersion(connection.requests),
            askWhere(connection.requests),
        ]),
    );
    expect(answers[1]).toHaveLength(18);
    expect(answers[2].image).toBe('play');
    expect(answers[3].state).toBe('idle');
});

test('a refusal carries the number and the words of the board', async () => {
    const { bench, connection } = await ready('play', 14);
    const refused = bench.until(play(connection.requests, 300));
    await expect(refused).rejects.toMatchObject({ code: 'refused', number: 3, words: expect.stringContaining('Page') });
});

test('a terminal beside the program sees its own text and nothing of the program', async () => {
    const { bench, connection, text } = await ready('play', 15);
    const before = text();
    for (let i = 0; i < 20; i++) await bench.until(askWhere(connection.requests));
    expect(text()).toBe(before);
    expect(text()).not.toContain('@');
    await connection.write(new TextEncoder().encode('version\r'));
    await bench.run(300);
    expect(text().slice(before.length)).toMatch(/^version\r\nMotion512 Play .*\r\n OK\r\n\] $/s);
});

test.each([
    ['play', 'sett', 'ings talk\r', /^settings talk\r\n/],
    ['edit', 'page 9\rname\rsal', 'ute\r', /salute/],
] as const)('%s: what a person has half typed goes on behind questions', async (image, first, rest, shows) => {
    const { bench, connection, text } = await ready(image, 28);
    const type = (keys: string): Promise<void> => connection.write(new TextEncoder().encode(keys));
    await bench.run(1000);
    const before = text().length;
    await type(first);
    await bench.run(500);
    const typed = text().length;
    for (let i = 0; i < 5; i++) await bench.until(askWhere(connection.requests));
    expect(text().length).toBe(typed);
    await type(rest);
    await bench.run(500);
    expect(text().slice(before)).toMatch(shows);
});

test('a walk by remote is heard of by @where, and ends by @stop', async () => {
    const { bench, connection } = await ready('play', 16);
    bench.board.send('remote', remotePacket(['up']));
    await bench.run(5000);
    expect(await bench.until(askWhere(connection.requests))).toMatchObject({ state: 'playing', code: 1 });
    await bench.until(command(connection.requests, 'stop'));
    await bench.run(5000);
    expect((await bench.until(askWhere(connection.requests))).state).toBe('idle');
});

test('what would move the robot and waits behind a long answer is dropped by Stop and Break; the rest is asked', async () => {
    const { bench, connection } = await ready('play', 29);
    const { requests } = connection;
    await bench.until(setTorque(requests, true));
    const codes = async (waiting: readonly Promise<unknown>[]): Promise<string[]> =>
        (await bench.until(Promise.allSettled(waiting))).map(end =>
            end.status === 'fulfilled' ? 'done' : (end.reason as RobotError).code,
        );
    const pose = Array.from({ length: 31 }, (_, id) => (id === 3 ? 600 : null));
    const list = askList(requests);
    const moves = [play(requests, 2), movePose(requests, 60, pose), aim(requests, 3, 600, 60), swing(requests, 3, 512, 40, 2000)];
    const others = [askPose(requests), setRate(requests, 100)];
    const all = [list, ...moves, ...others, command(requests, 'stop')];
    expect(await codes(all)).toEqual(['done', ...moves.map(() => 'cancelled'), 'done', 'done', 'done']);
    expect((await bench.until(askWhere(requests))).state).toBe('idle');
    const late = [askList(requests), play(requests, 2), command(requests, 'break')];
    expect(await codes(late)).toEqual(['done', 'cancelled', 'done']);
});

/** Requests on a line that this test answers. sent: [milliseconds, first word]. */
function scripted() {
    const clock = new SimulatedClock();
    const sent: [number, string][] = [];
    const write = async (bytes: Uint8Array): Promise<void> => {
        sent.push([clock.now(), /@\w+/.exec(String.fromCharCode(...bytes))?.[0] ?? '']);
    };
    const requests = new Requests({ write }, clock);
    const pass = async (ms: number): Promise<void> => {
        for (let i = 0; i < ms / 10; i++) {
            clock.advance(10);
            await settle();
        }
    };
    const ask = (text: string, options?: RequestOptions): Promise<string> =>
        requests.ask(text, options).catch((error: RobotError) => error.code);
    return { requests, sent, pass, ask };
}
const STOP = { stops: true };

test.each([
    [100, 300],
    [1100, 1100],
])('the answer to a question is lost; Stop after %i ms is sent at %i ms, and what was asked behind it later', async (pressed, at) => {
    const { requests, sent, pass, ask } = scripted();
    const [where, next] = [ask('@where'), ask('@pose')];
    await pass(pressed);
    const stop = ask('@stop', STOP);
    await pass(300);
    expect(sent).toEqual([
        [0, '@where'],
        [at, '@stop'],
    ]);
    requests.take('@stop OK');
    expect([await where, await stop]).toEqual(['no-answer', '']);
    await pass(600);
    requests.take('@pose OK');
    expect(await next).toBe('');
});

test('a stop without an answer, or whose bytes were lost, is sent three times, but not after a play was asked for', async () => {
    for (const lose of [() => undefined, (requests: Requests) => requests.take('@stop ERR 15 bytes lost')]) {
        const { requests, sent, pass, ask } = scripted();
        const stop = ask('@stop', STOP);
        for (let i = 0; i < 4; i++) {
            lose(requests);
            await pass(1000);
        }
        expect([await stop, sent.length]).toEqual(['no-answer', 3]);
    }
    const { sent, pass, ask } = scripted();
    const stop = ask('@stop', STOP);
    await pass(500);
    void ask('@play 2', { moves: true });
    await pass(1500);
    expect(await stop).toBe('no-answer');
    expect(sent.map(([, word]) => word)).toEqual(['@stop', '@play']);
});

/** What becomes of a press of a key. */
const press = (requests: Requests): Promise<unknown> =>
    requests.packet(remotePacket(['up']), { moves: true }).catch((error: RobotError) => error.code);

test('a press while the robot is silent is not sent', async () => {
    const { requests, sent, pass, ask } = scripted();
    void ask('@where', { timeoutMs: 3000 });
    await pass(1000);
    expect(await press(requests)).toBe('no-answer');
    expect(sent).toEqual([[0, '@where']]);
});

test.each([
    [400, undefined, 1],
    [600, 'no-answer', 0],
])('a press that the board held back by XOFF for %i ms: %s; it is sent %i times', async (heldMs, result, times) => {
    const clock = new SimulatedClock();
    const sent: Uint8Array[] = [];
    const port = new BytePort('robot', bytes => void sent.push(bytes));
    await port.open();
    const line = new Line(port, clock, { text: () => undefined, answer: () => undefined, lost: () => undefined });
    port.push(Uint8Array.of(0x13));
    await settle();
    const pressed = press(new Requests(line, clock));
    clock.advance(heldMs);
    port.push(Uint8Array.of(0x11));
    expect([await pressed, sent.length]).toEqual([result, times]);
    await line.close();
});

test('a board that says nothing: time-out, and the late answer does not answer the next question', async () => {
    const { bench, connection } = await ready('play', 17);
    const hurried = bench.until(connection.requests.ask('@list', { timeoutMs: 5 }));
    await expect(hurried).rejects.toMatchObject({ code: 'no-answer' });
    const list = await bench.until(askList(connection.requests));
    expect(list.length).toBeGreaterThan(30);
    await expect(bench.until(connection.requests.ask('@page 2', { timeoutMs: 5 }))).rejects.toMatchObject({ code: 'no-answer' });
    const { motions } = await robotImages('play');
    expect(await bench.until(askPage(connection.requests, 3, crcOf))).toEqual(motions.slice(3 * 512, 4 * 512));
    bench.board.setPower(false);
    await expect(bench.until(askWhere(connection.requests))).rejects.toMatchObject({ code: 'no-answer' });
});

test('cancelled by the caller, in the queue and under way', async () => {
    const { bench, connection } = await ready('play', 18);
    const first = new AbortController();
    const second = new AbortController();
    const both = Promise.allSettled([
        connection.requests.ask('@list', { signal: first.signal }),
        connection.requests.ask('@pose', { signal: second.signal }),
    ]);
    first.abort();
    second.abort();
    const [one, two] = await bench.until(both);
    expect([one, two].map(r => r.status === 'rejected' && (r.reason as RobotError).code)).toEqual(['cancelled', 'cancelled']);
    expect((await bench.until(askWhere(connection.requests))).state).toBe('idle');
});

test('the cable is pulled with a question under way, and put back', async () => {
    const { bench, connection, states, versions } = await ready('play', 19);
    const asked = askList(connection.requests);
    asked.catch(() => undefined);
    await bench.run(20);
    bench.port.unplug();
    await expect(bench.until(asked)).rejects.toMatchObject({ code: 'port-lost' });
    expect(connection.state).toBe('waiting');
    const { port } = bench;
    const lost = { code: 'port-lost' }; // also for what is asked meanwhile, before and after the first try to open the port
    await expect(command(connection.requests, 'stop')).rejects.toMatchObject(lost);
    await expect(connection.write(new Uint8Array(1))).rejects.toMatchObject(lost);
    port.open = () => Promise.reject(new DOMException('Failed to open serial port.', 'NetworkError'));
    await bench.run(1000);
    expect(() => connection.requests).toThrow(expect.objectContaining(lost));
    await expect(connection.write(new Uint8Array(1))).rejects.toMatchObject(lost);
    port.open = BytePort.prototype.open;
    await bench.run(3000);
    expect(connection.state).toBe('ready');
    expect(states.slice(-4)).toEqual(['waiting', 'opening', 'asking', 'ready']);
    expect(versions.slice(-4)).toEqual([undefined, undefined, undefined, 'play']); // it may be another board
    expect((await bench.until(askWhere(connection.requests))).state).toBe('idle');
    connection.askAgain(); // an answer was late: a key that is held is sent meanwhile, and let go
    expect([connection.state, connection.version?.image]).toEqual(['asking', 'play']);
    bench.port.unplug();
    await settle();
    await connection.close(); // nobody waits for the cable any more
    expect(() => connection.requests).toThrow(expect.objectContaining({ code: 'not-connected' }));
});

test('a board without power is silent, and found when it is switched on', async () => {
    const bench = await RobotBench.make('play', 20);
    bench.board.setPower(false);
    const { connection, states } = await connect(bench);
    await bench.run(5000);
    expect(states).toContain('silent');
    expect(states).not.toContain('ready');
    bench.board.setPower(true);
    await bench.run(6000);
    expect(connection.state).toBe('ready');
    expect(new Set(states.slice(states.indexOf('silent'), -1))).toEqual(new Set(['silent'])); // what it means can be read meanwhile
});

async function inLoader(seed: number) {
    const bench = await RobotBench.make('play', seed);
    bench.board.setPower(false);
    bench.board.writeEeprom(4095, Uint8Array.of(0xff));
    bench.board.setPower(true);
    const connected = await connect(bench);
    await bench.run(2500);
    return { bench, ...connected };
}

test('a board in its boot loader: what it says is text, and the state says silent', async () => {
    const { states, text } = await inLoader(21);
    expect(states).toContain('silent');
    expect(states).not.toContain('ready');
    expect(text()).toContain('- ');
});

test('a board in its boot loader: GO, typed slowly, starts the firmware, and no question of the page ends the line', async () => {
    const { bench, connection, text } = await inLoader(31);
    expect(connection.state).toBe('silent');
    const before = text().length;
    for (const key of 'GO\r') {
        await connection.write(new TextEncoder().encode(key));
        await bench.run(1500);
    }
    expect(text().slice(before)).not.toContain('Bad Command');
    await bench.run(4000);
    expect(connection.state).toBe('ready');
});

test('closing while something waits rejects it', async () => {
    const { connection } = await ready('play', 22);
    const asked = askWhere(connection.requests);
    asked.catch(() => undefined);
    await connection.close();
    await settle();
    await expect(asked).rejects.toBeInstanceOf(RobotError);
    expect(() => connection.requests).toThrow(RobotError);
});

test('closed while its port is still being opened: the port is free again', async () => {
    const bench = await RobotBench.make('play', 30);
    let opened = (): void => undefined;
    const slow = new Promise<void>(resolve => (opened = resolve));
    const port = {
        name: 'slow',
        get readable() {
            return bench.port.readable;
        },
        get writable() {
            return bench.port.writable;
        },
        open: () => slow.then(() => bench.port.open()),
        close: () => bench.port.close(),
    };
    const connection = new Connection(port, bench.clock, { state: () => undefined, text: () => undefined });
    connection.connect();
    await settle();
    const closed = connection.close();
    opened();
    await closed;
    await settle();
    expect(connection.state).toBe('closed');
    await bench.port.open(); // rejects if it is still open
});

test('driven by a stick: @drive is in force, and ends with the play when the stick falls silent', async () => {
    const { bench, connection } = await ready('play', 23);
    await bench.until(play(connection.requests, 20));
    await bench.run(4000);
    await bench.until(drive(connection.requests, -30, 100, 80));
    expect((await bench.until(askWhere(connection.requests))).fields.get('blend')).toBe('-30');
    await bench.run(6000); // no further @drive: the firmware's watchdog stops the walk
    expect((await bench.until(askWhere(connection.requests))).state).toBe('idle');
});

test.each([
    ['play', 24],
    ['edit', 25],
] as const)('%s: a pose by @move, some joints let go and held again', async (image, seed) => {
    const { bench, connection } = await ready(image, seed);
    const { requests } = connection;
    await bench.until(setTorque(requests, true));
    const positions = new Array<number | null>(31).fill(null);
    [positions[1], positions[3], positions[18]] = [600, 420, 500];
    await bench.until(movePose(requests, 90, positions));
    await expect(bench.until(movePose(requests, 90, positions))).rejects.toMatchObject({ code: 'refused', number: 4 });
    await bench.run(3000);
    const pose = await bench.until(askPose(requests));
    for (const [id, wanted] of [
        [1, 600],
        [2, 512],
        [3, 420],
        [18, 500],
    ] as const) {
        expect(Math.abs((pose.find(joint => joint.id === id)?.position ?? 0) - wanted), `servo ${id}`).toBeLessThan(4);
    }
    await bench.until(setTorque(requests, false, [1, 3, 5]));
    const limp = async (): Promise<number[]> =>
        (await bench.until(askPose(requests))).filter(joint => !joint.torque).map(joint => joint.id);
    expect(await limp()).toEqual([1, 3, 5]);
    await bench.until(setTorque(requests, true, [1, 3, 5]));
    expect(await limp()).toEqual([]);
    await bench.until(movePose(requests, 90, new Array<null>(31).fill(null))); // no joint: nothing is sent
});

test('a play is shaped, and shaped back', async () => {
    const { bench, connection } = await ready('play', 26);
    const { requests } = connection;
    await bench.until(setRate(requests, 150));
    await bench.until(setBlend(requests, -20));
    await bench.until(setAmplitude(requests, 80));
    const shape = async (): Promise<Shape | null> => (await bench.until(askWhere(requests))).shape;
    expect(await shape()).toEqual({ rate: 150, blend: -20, amplitude: 80 });
    await bench.until(requests.ask('@amplitude 120 1 2'));
    expect(await shape()).toBeNull(); // not one value
    await bench.until(resetShape(requests));
    expect(await shape()).toEqual({ rate: 100, blend: 0, amplitude: 100 });
});

test('beside a play: a page laid over the walk, a joint aimed, one swung, all given back; what cannot be is refused and changes nothing', async () => {
    const { bench, connection } = await ready('play', 27);
    const { requests } = connection;
    const overlay = async (): Promise<(string | undefined)[]> => {
        const { fields } = await bench.until(askWhere(requests));
        return ['layer', 'aim'].map(name => fields.get(name));
    };
    const refused = (request: Promise<void>): Promise<unknown> =>
        bench.until(
            request.then(
                () => 'done',
                (error: unknown) => (error instanceof RobotError ? error.code : error),
            ),
        );
    await bench.until(play(requests, 20));
    for (let i = 0; i < 40 && (await bench.until(askWhere(requests))).state !== 'playing'; i++) await bench.run(250);
    await bench.until(setLayer(requests, 60));
    expect(await overlay()).toEqual(['60', '00000000']);
    await bench.until(setLayer(requests, null));
    await bench.until(aim(requests, 2, 600, 90));
    await bench.until(swing(requests, 6, 512, 40, 2000));
    expect((await overlay())[1]).toBe('00000044'); // bits 2 and 6
    expect(await refused(swing(requests, 6, 1000, 100, 2000))).toBe('refused'); // leaves 0..1023
    expect(await refused(setLayer(requests, 126))).toBe('refused'); // no such page
    expect((await overlay())[1]).toBe('00000044');
    await bench.until(free(requests, [2]));
    await bench.until(free(requests));
    expect((await overlay())[1]).toBe('00000000');
    expect((await bench.until(askWhere(requests))).state).toBe('playing');
});
