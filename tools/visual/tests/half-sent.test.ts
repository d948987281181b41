// SPDX-License-Identifier: MIT
// A page that was half sent into the RAM of the real Edit when the cable was pulled, and is then not written again as it was. Nobody has
// edited there, so nobody may be asked to save it.
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import type { DocumentEditor } from '../app/editor.ts';
import { RobotPlays } from '../app/robot-plays.ts';
import { SENT_PAGES } from '../app/sent-pages.ts';
import { RobotTransfer } from '../app/transfer.ts';
import { pageOf } from '../model/document.ts';
import type { Connection } from '../robot/connection.ts';
import { askRamCrc } from '../robot/page-requests.ts';
import { askWhere } from '../robot/protocol.ts';
import type { RobotError } from '../robot/robot-error.ts';
import { MOTIONS_ADDRESS } from '../sim/board.ts';
import type { SessionState } from '../view/session/session.ts';
import { Store } from '../view/store.ts';
import { transferText } from '../view/texts/editor.ts';
import { errorText } from '../view/texts/robot.ts';
import { connectedEdit } from './connected.ts';
import { libraryDocument, makeFormat } from './motion-bench.ts';
import type { RobotBench } from './robot-bench.ts';

const { format } = await makeFormat();
const library = await libraryDocument();
/** Motion 3 of the robot and what the document has there; motion 55, empty in the robot. */
const [HALF, OTHER] = [3, 55];
const kept = new Map<string, string>();

beforeEach(() => {
    kept.clear();
    vi.stubGlobal('localStorage', {
        getItem: (key: string) => kept.get(key) ?? null,
        setItem: (key: string, value: string) => kept.set(key, value),
    });
});
afterEach(() => {
    vi.unstubAllGlobals();
});

type Edit = Awaited<ReturnType<typeof connectedEdit>>;

/** The page, just loaded, with a document that has these pages at 3 and 55. */
function loaded({ connection }: Edit, half: number, other: number) {
    const document = { name: 'mine', pages: [...library.pages] };
    let robot: readonly (Uint8Array | null)[] = [];
    const change = (page: number, from: number): void => {
        document.pages[page] = pageOf(library, from);
    };
    change(HALF, half);
    change(OTHER, other);
    const transfer = new RobotTransfer({
        format,
        document: () => document,
        robot: () => robot,
        setRobot: now => (robot = now),
        requests: () => connection.requests,
        becomeEdit: () => Promise.resolve(),
        backUp: () => Promise.resolve(),
        sent: SENT_PAGES,
    });
    return { transfer, change };
}

/** Motions 3 and 55 are written, and the cable is pulled behind the fourth piece of motion 3. It is plugged in again. */
async function halfSent(seed: number, isErased = false) {
    const edit = await connectedEdit(seed);
    const { bench, connection } = edit;
    if (isErased) bench.board.writeFlash(MOTIONS_ADDRESS + 512 * HALF, format.erased);
    const page = loaded(edit, 12, 2);
    const send = bench.board.send.bind(bench.board);
    let pieces = 0;
    bench.board.send = (sender, bytes) => {
        send(sender, bytes);
        if (new TextDecoder().decode(bytes).includes('@data') && ++pieces === 4) bench.clock.after(50, () => bench.port.unplug());
    };
    expect(await bench.until(page.transfer.write([HALF, OTHER]), 60_000)).toMatchObject({ error: { code: 'port-lost' } });
    bench.board.send = send;
    for (let i = 0; i < 400 && connection.state !== 'ready'; i++) await bench.run(25);
    return { edit, bench, connection, ...page };
}

function playsOf(connection: Connection, transfer: RobotTransfer): RobotPlays {
    const [state, editor] = [new Store({} as SessionState), {} as DocumentEditor]; // not asked by play()
    return new RobotPlays({
        state,
        editor,
        transfer,
        connection: () => connection,
        untilFound: () => Promise.resolve(),
        prepare: () => Promise.resolve(),
    });
}

function flashPage(bench: RobotBench, page: number): Uint8Array {
    return bench.board.readFlash().slice(MOTIONS_ADDRESS + 512 * page, MOTIONS_ADDRESS + 512 * page + 512);
}

test('unticked: the other motion is written, and it is said what became of the half one', async () => {
    const { bench, transfer } = await halfSent(71);
    expect(await bench.until(transfer.write([OTHER]), 60_000)).toEqual({ isDone: true });
    expect(flashPage(bench, OTHER)).toEqual(pageOf(library, 2));
    expect(flashPage(bench, HALF)).toEqual(pageOf(library, HALF));
    expect(transferText(transfer.state.get())).toMatch(/^Written and verified: 1 motion\. Edit's memory had half of motion 3 .*dropped/);
    expect(await bench.until(transfer.write([OTHER]), 60_000)).toEqual({ isDone: true });
    expect(transferText(transfer.state.get())).not.toContain('half');
});

test('unticked, in flash that was never written: Edit has its own new page there', async () => {
    const { bench, transfer } = await halfSent(76, true);
    expect(await bench.until(transfer.write([OTHER]), 60_000)).toEqual({ isDone: true });
    expect(flashPage(bench, OTHER)).toEqual(pageOf(library, 2));
    expect(flashPage(bench, HALF)).toEqual(format.erased);
});

test('edited: it is written as it is now', async () => {
    const { bench, transfer, change } = await halfSent(72);
    change(HALF, 20);
    expect(await bench.until(transfer.write([HALF, OTHER]), 60_000)).toEqual({ isDone: true });
    expect(flashPage(bench, HALF)).toEqual(pageOf(library, 20));
    expect(flashPage(bench, OTHER)).toEqual(pageOf(library, 2));
});

test('reloaded, and edited: it is written as it is now', async () => {
    const { edit, bench } = await halfSent(73);
    const { transfer } = loaded(edit, 20, 2);
    expect(await bench.until(transfer.write([OTHER, HALF]), 60_000)).toEqual({ isDone: true });
    expect(flashPage(bench, HALF)).toEqual(pageOf(library, 20));
    expect(flashPage(bench, OTHER)).toEqual(pageOf(library, 2));
    expect(SENT_PAGES.load()).toEqual([]);
});

test('the cable is pulled once more, while the half one is put back: the next try knows it all the same', async () => {
    const { bench, connection, transfer } = await halfSent(74);
    const send = bench.board.send.bind(bench.board);
    let pieces = 0;
    bench.board.send = (sender, bytes) => {
        send(sender, bytes);
        if (new TextDecoder().decode(bytes).includes('@data') && ++pieces === 2) bench.clock.after(50, () => bench.port.unplug());
    };
    expect(await bench.until(transfer.write([OTHER]), 60_000)).toMatchObject({ error: { code: 'port-lost' } });
    bench.board.send = send;
    for (let i = 0; i < 400 && connection.state !== 'ready'; i++) await bench.run(25);
    expect(await bench.until(transfer.tryAgain(), 60_000)).toEqual({ isDone: true });
    expect(flashPage(bench, HALF)).toEqual(pageOf(library, HALF));
});

test('somebody edits the half one in Edit: nothing is written, SAVE is not what the page asks for, and what it asks for helps', async () => {
    const { bench, connection, transfer } = await halfSent(75);
    const typed = async (line: string): Promise<void> => {
        await bench.until(connection.write(new TextEncoder().encode(line)));
        await bench.run(2000);
    };
    await typed('name mixed\r');
    const end = await bench.until(transfer.write([OTHER]), 60_000);
    expect(end).toMatchObject({ error: { code: 'page-mixed', words: '3' } });
    const text = errorText((end as { error: RobotError }).error);
    expect(text).not.toMatch(/SAVE|UNDO/);
    expect(text).toContain('type PAGE 1 in the terminal and answer y');
    expect(flashPage(bench, OTHER)).toEqual(pageOf(library, OTHER));
    await typed('page 1\r');
    await typed('y');
    expect(await bench.until(transfer.tryAgain(), 60_000)).toEqual({ isDone: true });
    expect(flashPage(bench, OTHER)).toEqual(pageOf(library, 2));
});

test('played instead: what flash has plays, and the half one is not left in RAM', async () => {
    const { bench, connection, transfer } = await halfSent(77);
    const plays = playsOf(connection, transfer);
    expect(await bench.until(plays.play(HALF), 60_000)).toBe(true);
    const crc = await bench.until(askRamCrc(connection.requests));
    expect(crc).toBe(format.crc(pageOf(library, HALF)));
    expect((await bench.until(askWhere(connection.requests))).page).toBe(HALF);
});

test('somebody edits the half one in Edit: it does not play, and it is said why', async () => {
    const { bench, connection, transfer } = await halfSent(78);
    await bench.until(connection.write(new TextEncoder().encode('name mixed\r')));
    await bench.run(2000);
    const played = expect(bench.until(playsOf(connection, transfer).play(HALF), 60_000)).rejects;
    await played.toMatchObject({ code: 'page-mixed', words: '3' });
    expect((await bench.until(askWhere(connection.requests))).state).toBe('idle');
});

test("somebody's own edits play, and a page that is being written does not", async () => {
    const edit = await connectedEdit(79);
    const { bench, connection } = edit;
    const { transfer } = loaded(edit, 12, 2);
    const plays = playsOf(connection, transfer);
    await bench.until(connection.write(new TextEncoder().encode('name mine\r')));
    await bench.run(2000);
    expect(await bench.until(plays.play(1), 60_000)).toBe(true);
    transfer.state.set({ phase: 'writing' });
    await expect(bench.until(plays.play(1), 60_000)).rejects.toMatchObject({ code: 'transfer-busy' });
});

test('a browser that keeps nothing, or something else, knows of no half one', () => {
    kept.set('motion512.half-sent', '[[3,"00","00"]]');
    expect(SENT_PAGES.load()).toEqual([]);
    kept.set('motion512.half-sent', '{');
    expect(SENT_PAGES.load()).toEqual([]);
    vi.stubGlobal('localStorage', undefined);
    SENT_PAGES.store([{ page: 1, before: format.empty, after: format.empty }]);
    expect(SENT_PAGES.load()).toEqual([]);
});
