// SPDX-License-Identifier: MIT
// Foreign boards and noise: the input of m512's test_noise.py, given to the page's connection. It must end in a state that has a message,
// answer or refuse every request in bounded time, and throw nothing but a RobotError.
import { execFileSync } from 'node:child_process';
import { expect, test } from 'vitest';
import { Connection } from '../robot/connection.ts';
import type { ConnectionState } from '../robot/connection-table.ts';
import { askDensePage, askList, askPage, askPose, askVersion, askWhere } from '../robot/protocol.ts';
import { readPages } from '../robot/page-read.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { Requests } from '../robot/requests.ts';
import { BytePort } from '../sim/byte-port.ts';
import { errorText } from '../view/texts/robot.ts';
import { TEXTS } from '../view/texts/texts.ts';
import { makeFormat } from './motion-bench.ts';
import { SimulatedClock, randomNumbers, settle } from './robot-bench.ts';

const ROOT = new URL('../../../', import.meta.url).pathname;
const SEED = 20261122;
/** Each request has its own time limit, and they run one after the other. */
const LIMIT_MS = 300_000;
const { format } = await makeFormat();
const crcOf = (bytes: Uint8Array): number => format.crc(bytes);
const QUESTIONS: readonly ((requests: Requests) => Promise<unknown>)[] = [
    askVersion,
    askWhere,
    askPose,
    askList,
    requests => askPage(requests, 1, crcOf),
    requests => askDensePage(requests, 1, crcOf),
    requests => readPages(requests, crcOf),
];

function talks(): Uint8Array[] {
    const lines = execFileSync(`${ROOT}build/venv/bin/python`, [`${ROOT}tools/visual/tests/strange_boards.py`], { encoding: 'utf8' })
        .trim()
        .split('\n');
    return lines.map(line => new Uint8Array(Buffer.from(line, 'base64')));
}

/** A board that sends some of its bytes whenever it receives something, until they are used up. */
function boardThatSays(bytes: Uint8Array, random: () => number): BytePort {
    let left = bytes;
    const port: BytePort = new BytePort('a strange board', () => {
        const count = Math.min(left.length, 1 + Math.floor(random() * 40));
        if (count > 0) port.push(left.slice(0, count));
        left = left.subarray(count);
    });
    return port;
}

/** A port with a board in its loader, which answers every line with Bad Command. `sent` is what the board received. */
function loaderThatSays(banner: string) {
    const sent: string[] = [];
    const port: BytePort = new BytePort('a loader', bytes => {
        sent.push(new TextDecoder('latin1').decode(bytes));
        if (bytes.includes(13)) port.push(new TextEncoder().encode("\r\n Bad Command.('help' for instructions definition)\r\n - "));
    });
    const say = (): void => {
        for (const letter of banner) port.push(new TextEncoder().encode(letter));
    };
    return { port, sent, say };
}

/** Lets time pass in steps that the page can follow. */
function passesOn(clock: SimulatedClock): (ms: number) => Promise<void> {
    return async ms => {
        for (let done = 0; done < ms; done += 50) {
            clock.advance(50);
            await settle();
        }
    };
}

async function loaderIsMet(banner: string) {
    const clock = new SimulatedClock();
    const { port, sent, say } = loaderThatSays(banner);
    const connection = new Connection(port, clock, { state: () => undefined, text: () => undefined });
    const pass = passesOn(clock);
    connection.connect();
    await pass(1000);
    say(); // MODE was pressed
    await pass(1000);
    return { connection, sent, pass };
}

test.each(['CM510', 'CM-700', 'XY9'])(
    'a board whose loader says that it is a %s: nothing is sent there, and the sentence names it',
    async name => {
        const { connection, sent, pass } = await loaderIsMet(`\xff\r\n\n SYSTEM O.K. (${name} Boot loader V1.00)\r\n - `);
        expect(connection.state).toBe('other-board');
        expect(errorText(connection.error as RobotError)).toContain(name);
        expect(TEXTS.robot.connections['other-board']).not.toContain('m512 flash');
        const count = sent.length;
        await expect(askPose(connection.requests)).rejects.toMatchObject({ code: 'not-connected' });
        await pass(5000);
        expect(sent.length).toBe(count);
        await connection.close();
    },
);

test.each(['CM5', 'CM-2+', 'Motion512'])('a board whose loader says that it is a %s is asked again', async name => {
    const { connection, sent, pass } = await loaderIsMet(`\r\n\n SYSTEM O.K. (${name} Boot loader V1.31)\r\n - `);
    const count = sent.length;
    await pass(5000);
    expect(['silent', 'asking']).toContain(connection.state);
    expect(sent.length).toBeGreaterThan(count);
    await connection.close();
});

test('another board is put on a cable where a foreign firmware answered: it is found, and until then the state stays', async () => {
    const clock = new SimulatedClock();
    let answer = '@ver image=other protocol=9 OK';
    const port: BytePort = new BytePort('a cable', () => port.push(new TextEncoder().encode(`\x1e${answer}\r\n`)));
    const states: ConnectionState[] = [];
    const connection = new Connection(port, clock, { state: state => states.push(state), text: () => undefined });
    const pass = passesOn(clock);
    connection.connect();
    await pass(10_000);
    expect(new Set(states.slice(2))).toEqual(new Set(['foreign']));
    answer = '@ver image=play version=1.0.0 board=cm5 protocol=1 can=list OK';
    await pass(4000);
    expect(connection.state).toBe('ready');
    expect(connection.version?.image).toBe('play');
    await connection.close();
});

test("m512's strange boards: a state with a sentence, and every question ends", async () => {
    const random = randomNumbers(SEED);
    const clock = new SimulatedClock();
    const talked = talks();
    const states = new Map<ConnectionState, number>();
    let answered = 0;
    for (const [i, bytes] of talked.entries()) {
        const where = `seed ${SEED}, talk ${i}: ${Buffer.from(bytes).toString('latin1').slice(0, 80)}`;
        const connection = new Connection(boardThatSays(bytes, random), clock, { state: () => undefined, text: () => undefined });
        const pass = async (ms: number): Promise<void> => {
            for (let done = 0; done < ms; done += 100) {
                clock.advance(100);
                await settle();
            }
        };
        connection.connect();
        await pass(1000);
        expect(['silent', 'foreign', 'other-board', 'asking', 'ready'], where).toContain(connection.state);
        const asked = QUESTIONS.map(ask =>
            ask(connection.requests).then(
                () => 'answered',
                (error: unknown) => error,
            ),
        );
        let ends: unknown[] | null = null;
        void Promise.all(asked).then(all => (ends = all));
        for (let ms = 0; ends === null && ms < LIMIT_MS; ms += 1000) await pass(1000);
        expect(ends, where).not.toBeNull();
        for (const end of ends ?? []) {
            if (end === 'answered') answered++;
            else {
                expect(end, where).toBeInstanceOf(RobotError);
                const sentence = errorText(end as RobotError);
                expect(sentence.length, where).toBeGreaterThan(10);
                expect(sentence, where).not.toMatch(/undefined|\[object/);
            }
        }
        const { state, error } = connection;
        states.set(state, (states.get(state) ?? 0) + 1);
        expect(TEXTS.robot.connections[state], where).toMatch(/^[^\n]{10,}([.!…]|m512 flash edit-cm5\.hex \(CM-2: edit-cm2\.hex\))$/);
        if (state === 'silent' || state === 'foreign') expect(error, where).toBeInstanceOf(RobotError);
        await connection.close();
    }
    console.log(
        `${talked.length} talks: ${[...states].map(([state, count]) => `${count} ${state}`).join(', ')}; ${answered} questions were answered by chance`,
    );
    expect(talked.length).toBeGreaterThan(150);
    expect([...states.keys()]).toContain('foreign');
});
