// SPDX-License-Identifier: MIT
// Play on your robot: it plays what the document has, or nothing. With the real firmware, in simulated time.
import { expect, onTestFinished, test, vi } from 'vitest';
import { RobotPlays } from '../app/robot-plays.ts';
import { RobotTransfer } from '../app/transfer.ts';
import { DocumentEditor } from '../app/editor.ts';
import { pageOf } from '../model/document.ts';
import type { MotionDocument } from '../model/document.ts';
import { NO_HISTORY } from '../model/history.ts';
import { readPage, writePage } from '../model/page.ts';
import type { Connection } from '../robot/connection.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { SessionState } from '../view/session/session.ts';
import { Store } from '../view/store.ts';
import { connected } from './connected.ts';
import { libraryDocument, makeFormat, makeMotion, must } from './motion-bench.ts';
import { RobotBench } from './robot-bench.ts';

const { format } = await makeFormat();
const library = await libraryDocument();
const WAVE = 60;

/** Your robot with the motion library, and the page with this document. Nothing has been read from the robot. */
async function yours(image: 'play' | 'edit', document: MotionDocument, seed: number, prepare = (): Promise<void> => Promise.resolve()) {
    const bench = await RobotBench.make(image, seed);
    const { connection } = connected(bench);
    for (let ms = 0; connection.state !== 'ready' && ms < 8000; ms += 50) await bench.run(50);
    const sent: string[] = [];
    const send = bench.board.send.bind(bench.board);
    bench.board.send = (sender, bytes) => {
        sent.push(new TextDecoder().decode(bytes));
        send(sender, bytes);
    };
    const body = { joints: [] } as unknown as ConstructorParameters<typeof DocumentEditor>[0]; // no joint is mirrored here
    const editor = new DocumentEditor(
        body,
        { format, player: await makeMotion(), document },
        { changed: () => undefined, refused: () => undefined, opened: () => undefined },
    );
    const transfer = new RobotTransfer({
        format,
        document: () => document,
        robot: () => editor.state.get().robot,
        setRobot: pages => editor.setRobot(pages),
        requests: () => connection.requests,
        becomeEdit: () => Promise.resolve(),
        backUp: () => Promise.resolve(),
    });
    const state = new Store({ source: 'yours' } as SessionState);
    const plays = new RobotPlays({ state, editor, transfer, connection: () => connection, untilFound: () => Promise.resolve(), prepare });
    return { bench, plays, transfer, played: () => sent.flatMap(bytes => bytes.match(/@play \d+/g) ?? []) };
}

/** The robot in the page with the motion library. The test decides when a write ends. */
async function inPage(document: MotionDocument) {
    const played: string[] = [];
    const written = { begun: 0, end: (): void => undefined, found: Promise.resolve() };
    let { pages } = library;
    let isWriting = false;
    const ask = async (text: string): Promise<string> => {
        const [, first = 0, last = -1] = /^@crcs (\d+) (\d+)/.exec(text) ?? [];
        if (/^@(play|layer)/.test(text)) played.push(text);
        return pages
            .slice(Number(first), Number(last) + 1)
            .map(bytes => format.crc(bytes).toString(16).padStart(4, '0'))
            .join('');
    };
    const write = async (_: readonly number[], __: unknown, shown = editor.state.get().document) => {
        if (isWriting) return { isDone: false, error: new RobotError('transfer-busy') };
        isWriting = true;
        written.begun++;
        await new Promise<void>(resolve => (written.end = resolve));
        [pages, isWriting] = [shown.pages, false];
        return { isDone: true };
    };
    const body = { joints: [] } as unknown as ConstructorParameters<typeof DocumentEditor>[0];
    const events = { changed: () => undefined, refused: () => undefined, opened: () => undefined };
    const editor = new DocumentEditor(body, { format, player: await makeMotion(), document }, events);
    const plays = new RobotPlays({
        state: new Store({ source: 'simulated' } as SessionState),
        editor,
        transfer: { write } as unknown as RobotTransfer,
        connection: () => ({ requests: { ask } }) as unknown as Connection,
        untilFound: () => written.found,
        prepare: () => Promise.resolve(),
    });
    return { plays, played, written, editor, robot: () => pages };
}

test('a play while servos are being looked for is played when they are found; one that is stopped meanwhile is not', async () => {
    const { plays, played, written } = await inPage(library);
    let find = (): void => undefined;
    const searches = (): void => {
        written.found = new Promise(resolve => (find = resolve));
    };
    for (const ask of [() => plays.play(WAVE), () => plays.playEdited(WAVE)]) {
        searches();
        const play = ask();
        await new Promise(resolve => setTimeout(resolve, 20));
        expect(played).toEqual([]);
        find();
        expect(await play).toBe(true);
        expect(played.splice(0)).toEqual([`@play ${WAVE}`]);
        searches();
        const dropped = ask();
        plays.drop(new RobotError('cancelled'));
        await expect(dropped).rejects.toThrow(RobotError);
        find();
        await new Promise(resolve => setTimeout(resolve, 20));
        expect(played).toEqual([]);
    }
});

function changed(page: number): MotionDocument {
    const bytes = library.pages[page] ?? format.empty;
    const [first, ...others] = readPage(format, bytes).steps;
    if (!first) throw new Error(`page ${page} has no step`);
    const steps = [{ ...first, positions: first.positions.map((position, id) => (id === 3 ? 600 : position)) }, ...others];
    return { ...library, pages: library.pages.map((one, index) => (index === page ? must(writePage(format, bytes, { steps })) : one)) };
}

test.each([
    ['play', 61],
    ['edit', 62],
] as const)('%s: pressed while the pages are still being read, Play does not play what is in flash instead', async (image, seed) => {
    const { bench, plays, transfer, played } = await yours(image, changed(WAVE), seed);
    const reading = transfer.read();
    await bench.run(300);
    expect(transfer.state.get().phase).toBe('reading');
    await expect(bench.until(plays.playEdited(WAVE))).rejects.toMatchObject({ code: 'pages-differ' });
    expect(played()).toEqual([]);
    transfer.cancel();
    await bench.until(reading);
});

test('what the robot has as the document has it plays at once, read or not', async () => {
    const { bench, plays, played } = await yours('play', changed(3), 63);
    await bench.until(plays.playEdited(WAVE));
    expect(played()).toEqual([`@play ${WAVE}`]);
});

test('what somebody has changed in the robot since it was read does not play', async () => {
    const { bench, plays, transfer, played } = await yours('edit', library, 64);
    expect(await bench.until(transfer.read(), 60_000)).toEqual({ isDone: true });
    bench.board.send('pc', new TextEncoder().encode(`page ${WAVE}\rname other\rsave\r`));
    await bench.run(3000);
    await expect(bench.until(plays.playEdited(WAVE))).rejects.toMatchObject({ code: 'pages-differ' });
    expect(played()).toEqual([]);
});

test('a page is laid over a play only as the document has it', async () => {
    const { bench, plays } = await yours('play', changed(WAVE), 65);
    const lay = plays.overlay({ kind: 'layer', page: WAVE, joints: [] });
    await expect(bench.until(lay)).rejects.toMatchObject({ code: 'layer-differs' });
});

test('Stop, pressed while the page of a layer is being compared: the layer is not sent behind it', async () => {
    const { plays, played } = await inPage(library);
    const lay = plays.overlay({ kind: 'layer', page: 2, joints: [] });
    plays.cancel();
    await expect(lay).rejects.toMatchObject({ code: 'cancelled' });
    expect(played).toEqual([]);
    await plays.overlay({ kind: 'layer', page: 2, joints: [] });
    expect(played).toEqual(['@layer 2']);
});

test('Play pressed again while the pages are being written: it waits for them, then plays once', async () => {
    const { plays, played, written } = await inPage(changed(WAVE));
    const presses = [plays.playEdited(WAVE), plays.playEdited(WAVE)];
    await vi.waitFor(() => expect(written.begun).toBe(1));
    written.end();
    expect(await Promise.all(presses)).toEqual([false, true]);
    expect([played, written.begun]).toEqual([[`@play ${WAVE}`], 1]);
});

test('another document opened while Play waits: what was seen when it was pressed is written and played', async () => {
    const seen = changed(WAVE);
    const { plays, played, written, editor, robot } = await inPage(seen);
    const press = plays.playEdited(WAVE);
    editor.open({ ...library, pages: library.pages.with(WAVE, pageOf(library, 2)) }, NO_HISTORY);
    await vi.waitFor(() => expect(written.begun).toBe(1));
    written.end();
    await press;
    expect(robot()[WAVE]).toEqual(pageOf(seen, WAVE));
    expect(played).toEqual([`@play ${WAVE}`]);
});

test('a second play takes the place of one that still waits for the robot to stand', async () => {
    let stand = (): void => undefined;
    const stands = new Promise<void>(resolve => (stand = resolve));
    const { bench, plays, played } = await yours('play', library, 66, () => stands);
    const first = expect(plays.play(2)).resolves.toBe(false);
    const second = plays.play(WAVE);
    stand();
    await first;
    await bench.until(second);
    expect(played()).toEqual([`@play ${WAVE}`]);
});

test('a play leaves nothing behind that listens for its end', async () => {
    const { plays } = await inPage(library);
    const listening = new Set<unknown>();
    onTestFinished(() => void vi.restoreAllMocks());
    const isOne = (target: unknown, type: string): boolean => target instanceof AbortSignal && type === 'abort';
    const { addEventListener, removeEventListener } = EventTarget.prototype;
    vi.spyOn(EventTarget.prototype, 'addEventListener').mockImplementation(function (this: EventTarget, type, listener, options) {
        if (isOne(this, type)) listening.add(listener);
        addEventListener.call(this, type, listener, options);
    });
    vi.spyOn(EventTarget.prototype, 'removeEventListener').mockImplementation(function (this: EventTarget, type, listener, options) {
        if (isOne(this, type)) listening.delete(listener);
        removeEventListener.call(this, type, listener, options);
    });
    const [first, second] = [plays.play(2), plays.playEdited(2)];
    expect(listening.size).toBe(2);
    expect(await first.catch(() => false)).toBe(false); // the second takes its place
    await second;
    await Promise.resolve();
    expect(listening.size).toBe(0);
});
