// SPDX-License-Identifier: MIT
// Reads and writes pages with the real Edit on the simulated board, in simulated time. The bytes are split at random. The robot's content
// is read directly from its flash. CUTS=all cuts every request of a write of twenty pages, and all pages are random ones (5 minutes).
import { afterEach, expect, test } from 'vitest';
import { pageOf } from '../model/document.ts';
import { writePage, readPage } from '../model/page.ts';
import { RobotTransfer } from '../app/transfer.ts';
import { Connection } from '../robot/connection.ts';
import { RobotError } from '../robot/robot-error.ts';
import { readPages } from '../robot/page-read.ts';
import { askList } from '../robot/protocol.ts';
import { hasUnsavedEdits } from '../robot/page-requests.ts';
import { PageWrite } from '../robot/page-write.ts';
import type { PageAccount, PageToWrite } from '../robot/page-write.ts';
import { CYCLES_PER_MS, MOTIONS_ADDRESS } from '../sim/board.ts';
import type { TransferState } from '../view/session/transfer.ts';
import { transferText } from '../view/texts/editor.ts';
import { libraryDocument, makeFormat, must } from './motion-bench.ts';
import { RobotBench } from './robot-bench.ts';

const all = process.env.CUTS === 'all';
const { format } = await makeFormat();
const library = await libraryDocument();
const open: Connection[] = [];
afterEach(async () => {
    for (const connection of open.splice(0)) await connection.close();
});

async function ready(image: 'play' | 'edit', seed: number, prepare: (bench: RobotBench) => void = () => undefined) {
    const bench = await RobotBench.make(image, seed);
    prepare(bench);
    const connection = new Connection(bench.port, bench.clock, { state: () => undefined, text: () => undefined });
    open.push(connection);
    connection.connect();
    await untilReady(bench, connection);
    return { bench, connection };
}

const crcOf = (bytes: Uint8Array): number => format.crc(bytes);

async function untilReady(bench: RobotBench, connection: Connection): Promise<void> {
    for (let i = 0; i < 400 && connection.state !== 'ready'; i++) await bench.run(25);
    expect(connection.state).toBe('ready');
}

function flashPage(bench: RobotBench, page: number): Uint8Array {
    return bench.board.readFlash().slice(MOTIONS_ADDRESS + 512 * page, MOTIONS_ADDRESS + 512 * page + 512);
}

/** A valid page with other contents. */
function another(bytes: Uint8Array, random: () => number): Uint8Array {
    const page = readPage(format, bytes);
    const steps = page.steps.length > 0 ? page.steps : [{ positions: new Array<number | null>(31).fill(null), time: 20, pause: 0 }];
    const positions = (steps[0]?.positions ?? []).map((position, id) => (id % 5 === 2 ? Math.floor(random() * 1024) : position));
    const change = { name: `n${Math.floor(random() * 1e6)}`, steps: steps.map((step, i) => (i === 0 ? { ...step, positions } : step)) };
    return must(writePage(format, bytes, change));
}

test.each([
    ['edit', 41],
    ['play', 42],
] as const)('%s: all pages are read, only those that nobody has; within 20 s', async (image, seed) => {
    const { bench, connection } = await ready(image, seed);
    const started = bench.clock.now();
    const all = await bench.until(
        readPages(connection.requests, crcOf, { known: () => [format.empty, new Uint8Array(512).fill(0xff)] }),
        60_000,
    );
    const first = bench.clock.now() - started;
    expect(all).toEqual(library.pages);
    const again: number[] = [];
    const from = bench.clock.now();
    const known = (page: number) => (page === 20 ? [] : [pageOf(library, page)]);
    expect(await bench.until(readPages(connection.requests, crcOf, { known, progress: (_, total) => again.push(total) }))).toEqual(
        library.pages,
    );
    expect(again.at(-1)).toBe(1);
    const second = bench.clock.now() - from;
    console.log(
        `${image}: the library's pages in ${(first / 1000).toFixed(1)} s, with one page changed in ${(second / 1000).toFixed(1)} s`,
    );
    expect(first).toBeLessThan(20_000);
    expect(second).toBeLessThan(1000);
});

test('128 pages of which nobody has any, every byte by chance, within 20 s; or a fourth of them in a fourth of that', async () => {
    const { bench, connection } = await ready('edit', 51);
    const pages = Array.from({ length: 128 }, () => Uint8Array.from({ length: 512 }, () => Math.floor(bench.random() * 256)));
    for (const [page, bytes] of pages.entries()) bench.board.writeFlash(MOTIONS_ADDRESS + 512 * page, bytes);
    const started = bench.clock.now();
    const part = all ? 1 : 4;
    const known = (page: number): Uint8Array[] => (page % part === 0 ? [] : pages.slice(page, page + 1));
    expect(await bench.until(readPages(connection.requests, crcOf, { known }), 60_000)).toEqual(pages);
    const took = bench.clock.now() - started;
    console.log(`${128 / part} pages, every byte by chance, in ${(took / 1000).toFixed(1)} s`);
    expect(took).toBeLessThan(20_000 / part);
});

test('an image that does not know the dense form is read all the same', async () => {
    const { bench, connection } = await ready('edit', 53);
    const asked: string[] = [];
    const older = {
        ask: (text: string, options?: object) => {
            asked.push(text);
            return text.startsWith('@dense')
                ? Promise.reject(new RobotError('refused', 'Unknown word', { number: 1 }))
                : connection.requests.ask(text, options);
        },
    } as typeof connection.requests;
    const known = (page: number) => (page < 4 ? [] : [pageOf(library, page)]);
    expect(await bench.until(readPages(older, crcOf, { known }))).toEqual(library.pages);
    expect(asked.filter(text => text.startsWith('@dense'))).toHaveLength(1);
    expect(asked.filter(text => text.startsWith('@page'))).toHaveLength(4);
});

/** Twenty pages, or the first of them: library, empty, erased and damaged ones. */
function twenty(bench: RobotBench, length = 20): PageToWrite[] {
    return Array.from({ length }, (_, i) => i * 6 + 1).map(page => {
        const before = flashPage(bench, page);
        return { page, before, after: another(format.fault(before) === null ? before : format.empty, bench.random) };
    });
}

function spoil(bench: RobotBench): void {
    const at = (page: number): number => MOTIONS_ADDRESS + 512 * page;
    bench.board.writeFlash(at(7), new Uint8Array(512).fill(0xff)); // erased
    const damaged = flashPage(bench, 19);
    damaged[100] = (damaged[100] ?? 0) ^ 4;
    bench.board.writeFlash(at(19), damaged);
}

const KINDS = ['@crcs', '@open', '@data', '@crc', '@save'] as const;

/** Pulls the cable in the n-th request of a kind (1..): during its bytes, or up to 80 ms after them. Counts all requests. */
function pullAt(bench: RobotBench, kind: string, nth: number): { restore(): void; counts: Map<string, number>; isPulled(): boolean } {
    const send = bench.board.send.bind(bench.board);
    const counts = new Map<string, number>();
    const late = bench.random() < 0.5;
    let isPulled = false;
    bench.board.send = (who, bytes) => {
        const [word = ''] = new TextDecoder()
            .decode(bytes)
            .replace('\x1e', '')
            .split(' ')
            .map(one => one.trim());
        counts.set(word, (counts.get(word) ?? 0) + 1);
        if (word !== kind || counts.get(word) !== nth) return send(who, bytes);
        isPulled = true;
        send(who, late ? bytes : bytes.slice(0, Math.floor(bench.random() * (bytes.length + 1))));
        if (late) bench.clock.after(Math.floor(bench.random() * 80), () => bench.port.unplug());
        else bench.port.unplug();
    };
    return {
        restore: () => {
            bench.board.send = send;
        },
        counts,
        isPulled: () => isPulled,
    };
}

test('twenty pages: what is written is in flash, nothing else is touched, and the account says so', async () => {
    const { bench, connection } = await ready('edit', 43, spoil);
    const pages = twenty(bench);
    const others = Array.from({ length: 128 }, (_, page) => flashPage(bench, page));
    const write = new PageWrite(pages, format);
    const started = bench.clock.now();
    await bench.until(write.run(connection.requests), 60_000);
    console.log(`twenty pages written and verified in ${((bench.clock.now() - started) / 1000).toFixed(1)} s`);
    expect(write.isDone).toBe(true);
    for (const { page, after } of pages) others[page] = after;
    for (const [page, bytes] of others.entries()) expect(flashPage(bench, page), `page ${page}`).toEqual(bytes);
});

test('a page that changed in the robot meanwhile is not written over, nor are edits of somebody at the terminal', async () => {
    const { bench, connection } = await ready('edit', 44);
    const page = { page: 30, before: pageOf(library, 31), after: another(format.empty, bench.random) };
    const other = new PageWrite([page], format);
    await expect(bench.until(other.run(connection.requests))).rejects.toMatchObject({ code: 'page-changed', words: '30' });
    expect(flashPage(bench, 30)).toEqual(pageOf(library, 30));
    await bench.until(connection.write(new TextEncoder().encode('page 100\rname secret\r')));
    await bench.run(3000);
    const mine = new PageWrite([{ ...page, before: pageOf(library, 30) }], format);
    await expect(bench.until(mine.run(connection.requests))).rejects.toMatchObject({ code: 'page-unsaved' });
    expect(mine.account.get(30)).toBe('sending');
    expect(flashPage(bench, 30)).toEqual(pageOf(library, 30));
});

test('digits of the CRCs that the line has damaged are not believed: what is saved is said to be saved', async () => {
    const { bench, connection } = await ready('edit', 47);
    const pages = twenty(bench, 2);
    const write = new PageWrite(pages, format);
    let asked = 0;
    const ask: typeof connection.requests.ask = async (text, options) => {
        const answer = await connection.requests.ask(text, options);
        const isDamaged = text.startsWith('@crcs') && asked++ % 3 === 0; // of each three, the first
        return isDamaged ? (answer.startsWith('1') ? '2' : '1') + answer.slice(1) : answer;
    };
    await bench.until(write.run({ ask }), 60_000);
    expect(asked).toBe(6);
    expect(write.isDone).toBe(true);
    for (const { page, after } of pages) expect(flashPage(bench, page)).toEqual(after);
});

test('stopped between two pages: those before are new, those after old, and the next run goes on', async () => {
    const { bench, connection } = await ready('edit', 45);
    const pages = twenty(bench);
    const write = new PageWrite(pages, format);
    const stop = new AbortController();
    const changed = (): void => void ([...write.account.values()].filter(state => state === 'written').length === 5 && stop.abort());
    await expect(bench.until(write.run(connection.requests, { signal: stop.signal, changed }), 30_000)).rejects.toMatchObject({
        code: 'cancelled',
    });
    for (const [i, { page, before, after }] of pages.entries()) expect(flashPage(bench, page)).toEqual(i < 5 ? after : before);
    await bench.until(write.run(connection.requests), 60_000);
    expect(write.isDone).toBe(true);
});

/** Checks that the account matches the flash. */
function checkAccount(bench: RobotBench, write: PageWrite, pages: readonly PageToWrite[], where: string): void {
    for (const { page, before, after } of pages) {
        const now = flashPage(bench, page);
        const is = Buffer.from(now).equals(Buffer.from(after)) ? 'new' : Buffer.from(now).equals(Buffer.from(before)) ? 'old' : 'torn';
        const state = write.account.get(page) ?? '';
        const may: Record<string, readonly string[]> = {
            waiting: ['old'],
            sending: ['old'],
            saving: ['old', 'new'],
            written: ['new'],
            verified: ['new'],
        };
        expect(may[state], `${where}, page ${page}: ${state}`).toContain(is);
    }
}

test('the cable pulled at requests of a write: old or new, the account right, "try again" finishes', async () => {
    const { bench, connection } = await ready('edit', 46, spoil);
    const count = all ? 20 : 5; // the erased page and the damaged one are among them
    let pages = twenty(bench, count);
    const counter = pullAt(bench, '', 0);
    await bench.until(new PageWrite(pages, format).run(connection.requests), 60_000);
    counter.restore();
    const every = KINDS.flatMap(kind => Array.from({ length: counter.counts.get(kind) ?? 0 }, (_, i) => [kind, i + 1] as const));
    const some = ['@crcs', '@open', '@data', '@crc', '@save', '@save'].map(kind => {
        const ofKind = every.filter(([one]) => one === kind);
        return ofKind[Math.floor(bench.random() * ofKind.length)] ?? (['@open', 1] as const);
    });
    expect(every.length).toBeGreaterThan(5 * count);
    const cuts = all ? every : some;
    const waiting = [...cuts];
    for (let cut = waiting.shift(); cut; cut = waiting.shift()) {
        const [kind, nth] = cut;
        pages = twenty(bench, count);
        const where = `${kind} ${nth}`;
        const write = new PageWrite(pages, format);
        const pull = pullAt(bench, kind, nth);
        const outcome = await bench.until(
            write.run(connection.requests).then(
                () => 'done',
                (error: { code: string }) => error.code,
            ),
            60_000,
        );
        pull.restore();
        await bench.run(200); // the board finishes what it began, with or without the cable
        checkAccount(bench, write, pages, `${where}, ${outcome}`);
        await untilReady(bench, connection);
        if (outcome !== 'done') await bench.until(write.run(connection.requests), 60_000);
        expect(write.isDone, where).toBe(true);
        for (const { page, after } of pages) expect(flashPage(bench, page), `${where}, page ${page}`).toEqual(after);
        // These pages differ in fewer pieces than the first ones, so the last of their requests is cut instead.
        if (!pull.isPulled()) waiting.unshift([kind, pull.counts.get(kind) ?? 1]);
    }
    console.log(`${cuts.length} of ${every.length} requests cut`);
}, 3_600_000);

/** The power fails for a moment at the n-th request behind the first `@open`. It is sent `waitMs` later. */
function restartAt(bench: RobotBench, nth: number, waitMs: number): { restore(): void; hasBeen(): boolean } {
    const send = bench.board.send.bind(bench.board);
    let requests = -1;
    let hasBeen = false;
    bench.board.send = (who, bytes) => {
        const text = new TextDecoder().decode(bytes);
        if (requests >= 0 || text.startsWith('\x1e@open')) requests++;
        if (hasBeen || requests !== nth) return send(who, bytes);
        hasBeen = true;
        bench.board.setPower(false);
        bench.board.setPower(true);
        bench.board.runTo(bench.board.nowCycles + waitMs * CYCLES_PER_MS);
        send(who, bytes);
    };
    return {
        restore: () => {
            bench.board.send = send;
        },
        hasBeen: () => hasBeen,
    };
}

test.each([
    ['the request is lost', 0, 1, 47],
    ['the request comes whole', 5000, 1, 48],
    ['the request is lost, and page 1 looks the same', 0, 30, 49],
    ['the request comes whole, and page 1 looks the same', 5000, 30, 50],
] as const)(
    'the board restarts at a request of a write, %s: nothing is left in the page that Edit opens then',
    async (_, waitMs, one, seed) => {
        const nothing = new Uint8Array(512).fill(0xff);
        const { bench, connection } = await ready('edit', seed, ({ board }) => {
            if (one !== 1) board.writeFlash(MOTIONS_ADDRESS + 512, nothing);
        });
        const first = flashPage(bench, 1);
        let hasBeen = true;
        let nth = seed % 3; // every third request, others in each case
        for (; hasBeen; nth += 3) {
            const page = 30 + nth;
            bench.board.writeFlash(MOTIONS_ADDRESS + 512 * page, nothing);
            const write = new PageWrite([{ page, before: nothing, after: another(pageOf(library, 3), bench.random) }], format);
            const restart = restartAt(bench, nth, waitMs);
            const run = (): Promise<string> =>
                bench.until(
                    write.run(connection.requests).then(
                        () => 'done',
                        (error: { code: string }) => error.code,
                    ),
                    60_000,
                );
            const told = [await run()];
            restart.restore();
            hasBeen = restart.hasBeen();
            const where = (): string => `request ${nth}: ${told.join(', ')}`;
            expect(flashPage(bench, 1), where()).toEqual(first);
            if (!write.isDone) told.push(await run());
            expect(write.isDone, where()).toBe(true);
            expect(
                await bench.until(
                    connection.requests.ask('@open 1').then(
                        () => 'clean',
                        () => 'edits',
                    ),
                ),
                where(),
            ).toBe('clean');
        }
        expect(nth).toBeGreaterThan(7);
    },
    120_000,
);

/** A RobotTransfer of the page, connected to the bench. */
function transferOn(bench: RobotBench, connection: Connection, pages: readonly PageToWrite[], edit = Promise.resolve()) {
    const original = { name: 'mine', pages: library.pages.map((bytes, page) => pages.find(one => one.page === page)?.after ?? bytes) };
    let document = original;
    const replace = (replaced: readonly number[]): void => {
        const pageNow = (bytes: Uint8Array, page: number): Uint8Array => (replaced.includes(page) ? another(bytes, bench.random) : bytes);
        document = { name: 'mine', pages: original.pages.map(pageNow) };
    };
    const kept: Uint8Array[][] = [];
    let robot: readonly (Uint8Array | null)[] = [];
    const transfer = new RobotTransfer({
        format,
        document: () => document,
        robot: () => robot,
        setRobot: now => {
            robot = now;
        },
        requests: () => connection.requests,
        becomeEdit: () => (connection.version?.can.has('save') ? edit : Promise.reject(new RobotError('needs-edit', 'cm5'))),
        backUp: now => Promise.resolve(void kept.push([...now])),
    });
    return {
        transfer,
        kept,
        original,
        replace,
        robot: () => robot,
        before: Array.from({ length: 128 }, (_, page) => flashPage(bench, page)),
    };
}

test('the page: a backup before the first write, a cable pulled in mid-write, "try again" finishes, and what is known of the robot is right', async () => {
    const { bench, connection } = await ready('edit', 47);
    const pages = twenty(bench);
    const { transfer, kept, robot, before } = transferOn(bench, connection, pages);
    const pull = pullAt(bench, '@save', 7);
    expect(await bench.until(transfer.write(pages.map(({ page }) => page)), 60_000)).toMatchObject({
        isDone: false,
        error: { code: 'port-lost' },
    });
    pull.restore();
    expect(kept).toEqual([before]);
    expect(transfer.state.get()).toMatchObject({ phase: 'stopped', total: 20 });
    expect(transfer.state.get().trouble).toContain('cable');
    const done = transfer.state.get().done;
    expect([6, 7]).toContain(done);
    expect(robot().filter((bytes, page) => !Buffer.from(bytes ?? []).equals(Buffer.from(before[page] ?? [])))).toHaveLength(done);
    expect(await transfer.tryAgain()).toMatchObject({ isDone: false }); // the cable is still unplugged
    await untilReady(bench, connection);
    expect(await bench.until(transfer.tryAgain(), 60_000)).toEqual({ isDone: true });
    expect(transfer.state.get()).toMatchObject({ phase: 'written', done: 20, total: 20, trouble: null });
    for (const [page, bytes] of robot().entries()) expect(flashPage(bench, page), `page ${page}`).toEqual(bytes);
    expect(kept).toHaveLength(1);
});

test('the page: the document changes under the list of what is to be written: only what the list shows is written', async () => {
    const { bench, connection } = await ready('edit', 69);
    const pages = twenty(bench, 4);
    const { transfer, original, replace, before } = transferOn(bench, connection, pages);
    const flash = (): Uint8Array[] => Array.from({ length: 128 }, (_, page) => flashPage(bench, page));
    replace([1]);
    expect(await bench.until(transfer.write([1], before, original), 60_000)).toEqual({ isDone: true });
    expect(flash()).toEqual(before.with(1, pageOf(original, 1)));

    const pull = pullAt(bench, '@open', 2);
    expect(await bench.until(transfer.write([7, 13], before, original), 60_000)).toMatchObject({ error: { code: 'port-lost' } });
    pull.restore();
    await untilReady(bench, connection);
    const stopped = flash();
    replace([13]);
    expect(await bench.until(transfer.tryAgain(), 60_000)).toEqual({ isDone: true });
    expect(transfer.state.get().phase).toBe('idle'); // the robot is read, for a new list
    expect(flash()).toEqual(stopped);
});

test('the page: "try again" goes on if the document changes elsewhere', async () => {
    const { bench, connection } = await ready('edit', 70);
    const pages = twenty(bench, 4);
    const { transfer, original, replace, before } = transferOn(bench, connection, pages);
    const pull = pullAt(bench, '@open', 2);
    expect(await bench.until(transfer.write([7, 13], before, original), 60_000)).toMatchObject({ error: { code: 'port-lost' } });
    pull.restore();
    await untilReady(bench, connection);
    replace([1, 19]);
    expect(await bench.until(transfer.tryAgain(), 60_000)).toEqual({ isDone: true });
    const wanted = before.map((bytes, page) => ([7, 13].includes(page) ? pageOf(original, page) : bytes));
    expect(Array.from({ length: 128 }, (_, page) => flashPage(bench, page))).toEqual(wanted);
});

/** The cable is pulled at the second page of a write, and then leads to another robot, which differs at these pages. */
async function otherRobot(seed: number, differing: readonly number[]) {
    const { bench, connection } = await ready('edit', seed);
    const pages = twenty(bench, 4);
    const { transfer, kept, robot, before } = transferOn(bench, connection, pages);
    const pull = pullAt(bench, '@save', 2);
    const written = transfer.write(
        pages.map(({ page }) => page),
        before,
    );
    expect(await bench.until(written, 60_000)).toMatchObject({ isDone: false, error: { code: 'port-lost' } });
    pull.restore();
    await bench.run(200); // the board finishes what it began
    const other = before.map((bytes, page) => (differing.includes(page) ? pageOf(library, 5) : bytes));
    for (const [page, bytes] of other.entries()) bench.board.writeFlash(MOTIONS_ADDRESS + 512 * page, bytes);
    await untilReady(bench, connection);
    return { bench, transfer, pages, kept, robot, before, other };
}

test('the page: "try again" meets another robot: it is read and backed up before anything is written, and what is known of it is right', async () => {
    const { bench, transfer, pages, kept, robot, before, other } = await otherRobot(64, [9, 61, 100]);
    const keptAtOpen: number[] = [];
    onTheLine(bench, line => {
        if (line.includes('@open')) keptAtOpen.push(kept.length);
        return line;
    });
    expect(await bench.until(transfer.tryAgain(), 60_000)).toEqual({ isDone: true });
    expect(kept).toEqual([before, other]);
    expect(keptAtOpen).toEqual(pages.flatMap(() => [2, 2])); // before it is sent, and after it is saved
    const wanted = other.map((bytes, page) => pages.find(one => one.page === page)?.after ?? bytes);
    expect(Array.from({ length: 128 }, (_, page) => flashPage(bench, page))).toEqual(wanted);
    expect(robot()).toEqual(wanted);
});

test('the page: "try again" meets another robot, which has another motion than the one that was compared: nothing is written', async () => {
    const { bench, transfer, kept, robot, before, other } = await otherRobot(65, [13]);
    for (const _ of ['at once', 'once more']) {
        expect(await bench.until(transfer.tryAgain(), 60_000)).toMatchObject({ error: { code: 'page-changed', words: '13' } });
        expect(transfer.state.get().account.size).toBe(0); // of the robot before
    }
    expect(kept.slice(0, 2)).toEqual([before, other]);
    expect(robot()).toEqual(other);
    expect(Array.from({ length: 128 }, (_, page) => flashPage(bench, page))).toEqual(other);
});

test('the page: Play cannot save, and a robot that cannot be kept is not written', async () => {
    const { bench, connection } = await ready('play', 48);
    const { transfer, kept } = transferOn(bench, connection, twenty(bench));
    expect(await transfer.write([1])).toMatchObject({ isDone: false, error: { code: 'needs-edit' } });
    expect(transfer.state.get().trouble).toContain('m512 flash edit-cm5.hex');
    expect(kept).toEqual([]);
    expect(flashPage(bench, 1)).toEqual(pageOf(library, 1));
});

test('the page: another board is on the cable than the one that was compared; nothing is written over what nobody has seen', async () => {
    const { bench, connection } = await ready('edit', 52);
    const pages = twenty(bench);
    const { transfer, before } = transferOn(bench, connection, pages);
    const [one, two] = pages.map(({ page }) => page);
    const seen = before.map((bytes, page) => (page === two ? pageOf(library, 5) : bytes));
    const written = transfer.write([Number(one), Number(two)], seen);
    expect(await bench.until(written, 60_000)).toMatchObject({ isDone: false, error: { code: 'page-changed', words: String(two) } });
    expect(flashPage(bench, Number(one))).toEqual(before[Number(one)]);
    for (const _ of ['it was seen as it is', 'it is there already'])
        expect(await bench.until(transfer.write([Number(one)], seen), 60_000)).toEqual({ isDone: true });
});

/** Lets a test change the bytes on the line: a byte lost in noise, a request that never arrives. */
function onTheLine(bench: RobotBench, change: (line: string) => string): string[] {
    const send = bench.board.send.bind(bench.board);
    const sent: string[] = [];
    bench.board.send = (sender, bytes) => {
        const line = new TextDecoder().decode(bytes);
        sent.push(line.replace('\x1e', ''));
        send(sender, new TextEncoder().encode(change(line)));
    };
    return sent;
}

test('the page: Stop is heard while Edit is still starting, nothing is written when it has started, and "try again" goes on', async () => {
    const { bench, connection } = await ready('edit', 49);
    let started = (): void => undefined;
    const edit = new Promise<void>(resolve => (started = resolve));
    const pages = twenty(bench);
    const { transfer, kept, before } = transferOn(bench, connection, pages, edit);
    const write = transfer.write(pages.map(({ page }) => page));
    transfer.cancel();
    expect(await bench.until(write, 1000)).toMatchObject({ isDone: false, error: { code: 'cancelled' } });
    expect(transfer.state.get()).toMatchObject({ phase: 'stopped', trouble: 'Stopped.' });
    started();
    await bench.run(3000);
    expect(kept).toEqual([]);
    expect(Array.from({ length: 128 }, (_, page) => flashPage(bench, page))).toEqual(before);
    expect(await bench.until(transfer.tryAgain(), 60_000)).toEqual({ isDone: true });
    for (const { page, after } of pages) expect(flashPage(bench, page)).toEqual(after);
});

test('a digit of "@save" lost in noise: the board refuses the request, and it is sent again', async () => {
    const { bench, connection } = await ready('edit', 54);
    const page = { page: 31, before: flashPage(bench, 31), after: another(pageOf(library, 31), bench.random) };
    const other = flashPage(bench, 3);
    let lost = 0;
    onTheLine(bench, line => (line.includes('@save 31 ') && lost++ === 0 ? line.replace('@save 31 ', '@save 3 ') : line));
    const write = new PageWrite([page], format);
    await bench.until(write.run(connection.requests), 30_000);
    expect(lost).toBe(2);
    expect(flashPage(bench, 3)).toEqual(other);
    expect(flashPage(bench, 31)).toEqual(page.after);
    expect(write.isDone).toBe(true);
});

/** A line on which the robot refuses to save this page, or says OK and keeps the old one. */
function wornAt(bench: RobotBench, { requests }: Connection, worn: number, how: 'refuses' | 'forgets'): Connection['requests'] {
    const before = flashPage(bench, worn);
    const ask: typeof requests.ask = async (text, options) => {
        const isWorn = text.startsWith(`@save ${worn} `);
        if (isWorn && how === 'refuses') throw new RobotError('refused', 'Not saved: flash error', { number: 11 });
        const answer = await requests.ask(text, options);
        if (isWorn) bench.board.writeFlash(MOTIONS_ADDRESS + 512 * worn, before);
        return answer;
    };
    return { ask } as typeof requests;
}

test('a page that the robot refuses to save does not bar the others, and it is said which one it is', async () => {
    const { bench, connection } = await ready('edit', 66);
    const pages = twenty(bench, 4);
    const before = pages.map(({ page }) => flashPage(bench, page));
    const line = { version: connection.version, requests: wornAt(bench, connection, 7, 'refuses') } as Connection;
    const { transfer } = transferOn(bench, line, pages);
    const numbers = pages.map(({ page }) => page);
    for (const begin of [() => transfer.write(numbers), () => transfer.tryAgain()]) {
        expect(await bench.until(begin(), 60_000)).toMatchObject({ error: { code: 'pages-refused', words: '7' } });
        expect([...transfer.state.get().account]).toEqual(numbers.map(page => [page, page === 7 ? 'refused' : 'verified']));
        expect(transferText(transfer.state.get())).toMatch(/Not written: 7\. 3 of 4 motions are done; the others are as they were\.$/);
    }
    expect(numbers.map(page => flashPage(bench, page))).toEqual(pages.map(({ after }, i) => (numbers[i] === 7 ? before[i] : after)));
    // Nothing of it is left in Edit, for a person to save or for the next page to meet.
    expect(await bench.until(hasUnsavedEdits(connection.requests, format))).toBe(false);
    expect(await bench.until(transfer.write([7]), 60_000)).toMatchObject({ error: { code: 'save-failed' } }); // perhaps it can save none
});

/** From now on these bits of a byte of flash stay erased. Returns the repair. */
function wearOut(bench: RobotBench, address: number, bits: number): () => void {
    const { board } = bench;
    const runTo = board.runTo.bind(board);
    board.runTo = cycles => {
        while (board.nowCycles < cycles) {
            const isOn = runTo(Math.min(board.nowCycles + 1000, cycles)); // Edit reads a page back at once
            const [byte = 0] = board.readFlash(address, 1);
            if ((byte & bits) !== bits) board.writeFlash(address, Uint8Array.of(byte | bits));
            if (!isOn) return false;
        }
        return true;
    };
    return () => (board.runTo = runTo);
}

test.each([
    [40, 'it is worn out', 81],
    [500, 'it is worn out', 82],
    [500, 'it is repaired', 83],
])('byte %i of a page is worn: it is named, the robot is to be restarted, and all others are written then; %s', async (at, how, seed) => {
    const { bench, connection } = await ready('edit', seed);
    const pages = twenty(bench, 4); // 1, 7, 13, 19
    const { transfer } = transferOn(bench, connection, pages);
    const numbers = pages.map(({ page }) => page);
    const states = (): PageAccount[] => numbers.map(page => transfer.state.get().account.get(page) ?? 'waiting');
    const repair = wearOut(bench, MOTIONS_ADDRESS + 512 * 7 + at, ~(pages[1]?.after[at] ?? 0) & 0xff);
    const pending = { error: { code: 'save-pending', words: '7' } };
    expect(await bench.until(transfer.write(numbers), 60_000)).toMatchObject(pending);
    expect(states()).toEqual(['verified', 'lost', 'waiting', 'waiting']);
    expect(transferText(transfer.state.get())).toMatch(
        /restarted.*@reset.*try again.* Motion: 7\. 1 of 4 motions are done\. "Read the robot again" shows/,
    );
    expect(await bench.until(hasUnsavedEdits(connection.requests, format))).toBe(false);
    expect(await bench.until(transfer.tryAgain(), 60_000)).toMatchObject(pending); // it has not been restarted
    expect(states()).toEqual(['verified', 'lost', 'waiting', 'waiting']);
    if (how === 'it is repaired') repair();
    await bench.until(connection.write(new TextEncoder().encode('@reset\r')));
    await bench.run(3000);
    await untilReady(bench, connection);
    const end = await bench.until(transfer.tryAgain(), 60_000);
    expect(end).toMatchObject(how === 'it is repaired' ? { isDone: true } : pending);
    for (const { page, after } of pages) if (page !== 7 || end.isDone) expect(flashPage(bench, page), `page ${page}`).toEqual(after);
    expect(states()).toEqual(['verified', end.isDone ? 'verified' : 'lost', 'verified', 'verified']);
});

test('a page that the robot has not kept: the others are verified, and it is said which one it is', async () => {
    const { bench, connection } = await ready('edit', 67);
    const pages = twenty(bench, 3);
    const write = new PageWrite(pages, format);
    const run = write.run({ ask: wornAt(bench, connection, 7, 'forgets').ask });
    await expect(bench.until(run, 60_000)).rejects.toMatchObject({ code: 'page-not-saved', words: '7' });
    expect([...write.account.values()]).toEqual(['verified', 'lost', 'verified']);
});

test.each(['saving', 'lost'] as const)('a page that may be another one now (%s): the others are not said to be as they were', state => {
    const account = new Map<number, PageAccount>([
        [1, 'verified'],
        [7, state],
        [13, 'waiting'],
    ]);
    const said = transferText({ phase: 'stopped', done: 1, total: 3, account, trouble: 'Trouble.', putBack: null });
    expect(said).toBe('Trouble. 1 of 3 motions are done. "Read the robot again" shows what it has of the others.');
});

test('erased flash of the document becomes the empty page in a robot; a robot that has either of them has it already', async () => {
    const { bench, connection } = await ready('edit', 68, spoil);
    const erased = [1, 7, 13, 25].map(page => ({ page, before: flashPage(bench, page), after: format.erased }));
    const { transfer, robot, before } = transferOn(bench, connection, erased);
    const sent = onTheLine(bench, line => line);
    for (const _ of ['three motions and erased flash', 'three empty pages and erased flash'])
        expect(await bench.until(transfer.write([1, 7, 13, 25]), 60_000)).toEqual({ isDone: true });
    const wanted = before.map((bytes, page) => ([1, 13, 25].includes(page) ? format.empty : bytes));
    expect(Array.from({ length: 128 }, (_, page) => flashPage(bench, page))).toEqual(wanted);
    expect(robot()).toEqual(wanted);
    expect(sent.filter(line => line.startsWith('@save')).map(line => line.split(' ')[1])).toEqual(['1', '13', '25']);
});

test('a page that came damaged from a robot is not passed on: not a byte of it goes down the line', async () => {
    const { bench, connection } = await ready('edit', 55, spoil);
    const { transfer, robot } = transferOn(bench, connection, [{ page: 19, before: flashPage(bench, 19), after: flashPage(bench, 19) }]);
    bench.board.writeFlash(MOTIONS_ADDRESS + 512 * 19, pageOf(library, 19)); // the page is repaired there meanwhile
    const sent = onTheLine(bench, line => line);
    expect(await bench.until(transfer.write([19]), 60_000)).toEqual({ isDone: true });
    expect(sent.filter(line => /^@(open|data|save)/.test(line))).toEqual([]);
    expect(flashPage(bench, 19)).toEqual(pageOf(library, 19));
    expect(robot()[19]).toEqual(pageOf(library, 19));
});

test('the page: stopped while the robot is read, by itself or before a write: no motion is said to be written', async () => {
    const { bench, connection } = await ready('edit', 62);
    const { transfer, robot } = transferOn(bench, connection, twenty(bench));
    for (const begin of [() => transfer.read(), () => transfer.write([1, 7])]) {
        const said: string[] = [];
        const unwatch = transfer.state.watch(state => said.push(transferText(state)));
        const end = begin();
        await bench.run(900); // some of the twenty pages are read
        transfer.cancel();
        expect(await bench.until(end, 1000)).toMatchObject({ error: { code: 'cancelled' } });
        unwatch();
        expect(robot()).toEqual([]);
        expect(said.filter(text => /Written|are done/.test(text))).toEqual([]);
        expect(said.at(-1)).toBe('Stopped.');
    }
});

test('one transfer at a time: what is asked beside it is refused by name, and nothing of it goes down the line', async () => {
    const { bench, connection } = await ready('edit', 56);
    const pages = twenty(bench);
    const { transfer, kept } = transferOn(bench, connection, pages);
    const sent = onTheLine(bench, line => line);
    const first = transfer.write(pages.map(({ page }) => page));
    await bench.run(200);
    const busy = { isDone: false, error: { code: 'transfer-busy' } };
    expect(await bench.until(transfer.write([1]), 100)).toMatchObject(busy);
    expect(await bench.until(transfer.read(), 100)).toMatchObject(busy);
    expect(await bench.until(transfer.tryAgain(), 100)).toMatchObject(busy);
    expect(await bench.until(first, 60_000)).toEqual({ isDone: true });
    expect(sent.filter(line => line.startsWith('@save'))).toHaveLength(pages.length);
    expect(sent.filter(line => line.startsWith('@crcs 0 127'))).toHaveLength(1);
    expect(kept).toHaveLength(1);
    expect(transfer.state.get()).toMatchObject({ phase: 'written', done: pages.length });
});

test('who compares while the robot is being read sees its pages when they are there; they are read once', async () => {
    const { bench, connection } = await ready('play', 59);
    const { transfer, robot } = transferOn(bench, connection, []);
    const sent = onTheLine(bench, line => line);
    const arrival = transfer.read();
    await bench.run(100);
    const compared = transfer.read().then(end => [end, robot().length]);
    expect(await bench.until(compared, 60_000)).toEqual([{ isDone: true }, 128]);
    expect(await arrival).toEqual({ isDone: true });
    expect(sent.filter(line => line.startsWith('@crcs'))).toHaveLength(1);
});

test('a framing error in the middle of an answer does not end the talk', async () => {
    const { bench, connection } = await ready('edit', 57);
    const asked = askList(connection.requests);
    await bench.run(60); // the list takes longer than that at 57,600 baud
    bench.port.garble();
    expect(await bench.until(asked)).toContainEqual({ page: 2, name: 'bow', steps: expect.any(Number), fault: '' });
    expect(connection.state).toBe('ready');
});

test('while the time of the robot in the page stands still, the sentence says why nothing goes on', () => {
    const state = { phase: 'reading', done: 0, total: 0, account: new Map(), trouble: null, putBack: null } as unknown as TransferState;
    expect(transferText(state)).not.toContain('time stands still');
    expect(transferText(state, { source: 'simulated', speed: 0 })).toBe('Asking the robot which motions it has … · time stands still');
    expect(transferText({ ...state, phase: 'idle' }, { source: 'simulated', speed: 0 })).toBe('');
});
