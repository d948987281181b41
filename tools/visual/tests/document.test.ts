// SPDX-License-Identifier: MIT
// The document: random edits with undo and redo (EDITS=10000: so many), and single edits calculated by hand.
import { expect, test } from 'vitest';
import { DocumentEditor } from '../app/editor.ts';
import { emptyDocument, imageOf, isSamePage, pageOf, withChanges } from '../model/document.ts';
import type { MotionDocument } from '../model/document.ts';
import * as states from '../model/editor-state.ts';
import type { EditorState } from '../model/editor-state.ts';
import { readPage } from '../model/page.ts';
import type { PageView, Step } from '../model/page.ts';
import type { Result } from '../model/result.ts';
import type { JointPair } from '../model/step-edits.ts';
import type { Transaction } from '../model/transaction.ts';
import type { Gesture } from '../view/session/editor.ts';
import { BODY, libraryDocument, makeFormat, makeMotion, must, refusalOf } from './motion-bench.ts';
import { randomNumbers } from './robot-bench.ts';

const EDITS = Number(process.env.EDITS ?? 2000);
const { format, edits } = await makeFormat();
const PAIRS: readonly JointPair[] = [1, 3, 5, 7, 9, 11, 13, 15, 17].map(id => [id, id + 1]);
const view = (document: MotionDocument, page: number): PageView => readPage(format, pageOf(document, page));
const after = (document: MotionDocument, edit: Result<Transaction>): MotionDocument => withChanges(document, must(edit).changes);

/** A random edit with random arguments. Some are refused. */
function randomEdit(random: () => number, document: MotionDocument): Result<Transaction> {
    const below = (count: number): number => Math.floor(random() * count);
    const page = below(128);
    const other = below(130) - 1;
    const step = below(8);
    const steps = Array.from({ length: 1 + below(3) }, () => below(7));
    const made: Step = {
        positions: Array.from({ length: 31 }, () => (random() < 0.3 ? null : below(1030))),
        time: below(256),
        pause: below(256),
    };
    const options = { linksFollow: random() < 0.5, replace: random() < 0.5 };
    const kinds: (() => Result<Transaction>)[] = [
        () =>
            edits.setJoints(
                document,
                page,
                steps,
                new Map([
                    [below(33), below(1024)],
                    [below(31), null],
                ]),
            ),
        () => edits.insertSteps(document, page, step, [made]),
        () => edits.deleteSteps(document, page, steps),
        () => edits.duplicateSteps(document, page, steps),
        () => edits.moveSteps(document, page, steps, step),
        () => edits.setTime(document, page, steps, below(300)),
        () => edits.setPause(document, page, steps, below(256)),
        () => edits.mirrorSteps(document, page, steps, PAIRS, random() < 0.5 ? 'right' : 'left'),
        () => edits.exchangeSteps(document, page, steps, PAIRS),
        () => edits.interpolate(document, page, step),
        () => edits.rename(document, page, 'x'.repeat(below(15))),
        () => edits.setHeader(document, page, { repetitions: below(256), accelTime: below(256), speed: below(256), code: below(256) }),
        () => edits.setLink(document, page, 'exit', below(130)),
        () => edits.copyPage(document, page, other, options),
        () => edits.movePage(document, page, other, options),
        () => edits.swapPages(document, page, other, options),
        () => edits.clearPages(document, [page]),
        () => edits.replacePages(document, new Map([[page, pageOf(document, below(128))]])),
    ];
    return kinds[below(kinds.length)]?.() ?? edits.clearPages(document, []);
}

test('random edits (EDITS): all undone is the first document, all redone the last, byte for byte', async () => {
    const random = randomNumbers(20261122);
    const first = await libraryDocument();
    let state: EditorState = states.startState(first);
    let made = 0;
    let refused = 0;
    const effective = new Map<string, number>();
    while (made < EDITS) {
        const edit = randomEdit(random, state.document);
        const before = state;
        if (edit.ok) state = states.dispatch(state, edit.value);
        else refused++;
        const changed = state.document.pages.filter((bytes, page) => bytes !== before.document.pages[page]).length;
        expect(changed).toBe(edit.ok ? edit.value.changes.length : 0); // untouched pages stay the same object
        if (state !== before) made++;
        if (edit.ok && changed > 0) effective.set(edit.value.label, (effective.get(edit.value.label) ?? 0) + 1);
        if (made % 500 === 0)
            for (let n = Math.floor(random() * 20); n > 0; n--) state = random() < 0.6 ? states.undoOne(state) : states.redoOne(state);
    }
    expect(refused).toBeGreaterThan(EDITS / 100);
    expect(effective.size).toBe(18); // every kind of edit above has changed something, most of them often
    expect(Math.min(...effective.values())).toBeGreaterThan(EDITS / 700);
    const last = imageOf(state.document);
    for (const [page, bytes] of state.document.pages.entries()) if (page > 0) expect(format.fault(bytes), `page ${page}`).toBeNull();
    const count = state.history.done.length;
    expect(count).toBeGreaterThan(0.9 * EDITS);
    while (state.history.done.length > 0) state = states.undoOne(state);
    expect(imageOf(state.document)).toEqual(imageOf(first));
    for (let n = 0; n < count; n++) state = states.redoOne(state);
    expect(imageOf(state.document)).toEqual(last);
});

test('a gesture is one undo step however often it changed; cancelled, it leaves nothing', async () => {
    const first = await libraryDocument();
    let state = states.beginGesture(states.startState(first), 'drag');
    for (const position of [500, 400, 300]) {
        state = states.changeGesture(state, must(edits.setJoints(first, 2, [0], new Map([[11, position]]))));
        expect(view(state.document, 2).steps[0]?.positions[11]).toBe(position);
    }
    expect(state.history.done).toHaveLength(0);
    const cancelled = states.cancelGesture(state);
    expect(cancelled.document).toBe(first);
    expect(cancelled.history.done).toHaveLength(0);
    state = states.finishGesture(state);
    expect(state.history.done).toHaveLength(1);
    expect(view(state.document, 2).steps[0]?.positions[11]).toBe(300);
    expect(imageOf(states.undoOne(state).document)).toEqual(imageOf(first));
});

test('a drag ends when another one begins, or when another motion or step is chosen: it changes nothing any more', async () => {
    const nothing = (): void => undefined;
    const parts = { format, player: await makeMotion(), document: await libraryDocument() };
    const editor = new DocumentEditor(BODY, parts, { changed: nothing, refused: nothing, opened: nothing });
    const drag = (gesture: Gesture, position: number): boolean =>
        gesture.change(edits.setJoints(gesture.start, 2, [0], new Map([[11, position]])));
    const positionNow = () => editor.page(2).steps[0]?.positions[11];
    const first = editor.gesture('drag');
    drag(first, 500);
    const second = editor.gesture('drag');
    expect([drag(first, 400), positionNow()]).toEqual([false, 500]);
    drag(second, 300);
    first.cancel();
    expect(positionNow()).toBe(300);
    editor.select({ page: 3 });
    expect([drag(second, 200), positionNow()]).toEqual([false, 300]);
    const third = editor.gesture('drag');
    drag(third, 100);
    editor.select({ page: 3, step: 1 });
    expect([drag(third, 50), positionNow(), editor.state.get().history.done.length]).toEqual([false, 100, 3]);
});

test('steps are moved, duplicated, deleted and put in between as one would by hand', () => {
    let document = emptyDocument(format, 'steps');
    const named = (n: number): Step => ({
        positions: Array.from({ length: 31 }, (_, id) => (id === 1 ? n * 100 : null)),
        time: 10 * n + 1,
        pause: n,
    });
    const order = (): number[] => view(document, 5).steps.map(step => (step.positions[1] ?? -100) / 100);
    document = after(document, edits.insertSteps(document, 5, 0, [1, 2, 3, 4, 5].map(named)));
    document = after(document, edits.moveSteps(document, 5, [3, 1], 0));
    expect(order()).toEqual([2, 4, 1, 3, 5]);
    document = after(document, edits.moveSteps(document, 5, [0], 5));
    expect(order()).toEqual([4, 1, 3, 5, 2]);
    document = after(document, edits.duplicateSteps(document, 5, [0, 2]));
    expect(order()).toEqual([4, 1, 3, 4, 3, 5, 2]);
    expect(refusalOf(edits.interpolate(document, 5, 0))).toBe('steps-full');
    document = after(document, edits.deleteSteps(document, 5, [3, 4]));
    document = after(document, edits.interpolate(document, 5, 1)); // between 1 and 3; its time 31 is split into 16 and 15
    expect(order()).toEqual([4, 1, 2, 3, 5, 2]);
    expect(
        view(document, 5)
            .steps.slice(2, 4)
            .map(step => [step.time, step.pause]),
    ).toEqual([
        [16, 0],
        [15, 3],
    ]);
    expect(refusalOf(edits.interpolate(document, 5, 5))).toBe('no-such-step');
});

test('a mirror makes 1024 - p on the other side, at most 1023', () => {
    const positions = Array.from({ length: 31 }, (_, id) => (({ 1: 300, 2: 512, 3: 0 }) as Record<number, number>)[id] ?? null);
    const document = after(
        emptyDocument(format, 'm'),
        edits.insertSteps(emptyDocument(format, 'm'), 1, 0, [{ positions, time: 1, pause: 0 }]),
    );
    const pose = (edit: Result<Transaction>) => view(after(document, edit), 1).steps[0]?.positions.slice(1, 5);
    expect(pose(edits.mirrorSteps(document, 1, [0], PAIRS, 'right'))).toEqual([300, 724, 0, 1023]);
    expect(pose(edits.mirrorSteps(document, 1, [0], PAIRS, 'left'))).toEqual([512, 512, null, null]);
    expect(pose(edits.exchangeSteps(document, 1, [0], PAIRS))).toEqual([512, 724, null, 1023]);
});

test('a page that moves takes its links to itself along; links of others follow when they are asked to', () => {
    let document = emptyDocument(format, 'links');
    for (const page of [3, 4])
        document = after(
            document,
            edits.insertSteps(document, page, 0, [{ positions: new Array<null>(31).fill(null), time: 1, pause: 0 }]),
        );
    document = after(document, edits.setHeader(document, 3, { next: 3, exit: 4, blendLeft: 3 }));
    document = after(document, edits.setHeader(document, 4, { next: 3, linked2: 3 }));
    const links = (made: MotionDocument, page: number) => {
        const { next, exit, linked2, blendLeft } = view(made, page);
        return [next, exit, linked2, blendLeft];
    };
    const follows = after(document, edits.movePage(document, 3, 9, { linksFollow: true }));
    expect(links(follows, 9)).toEqual([9, 4, 0, 9]);
    expect(links(follows, 4)).toEqual([9, 0, 9, 0]);
    expect(format.isEmpty(pageOf(follows, 3))).toBe(true);
    expect(links(after(document, edits.movePage(document, 3, 9)), 4)).toEqual([3, 0, 3, 0]);
    expect(links(after(document, edits.copyPage(document, 3, 9)), 9)).toEqual([9, 4, 0, 9]);
    const swapped = after(document, edits.swapPages(document, 3, 4, { linksFollow: true }));
    expect([links(swapped, 4), links(swapped, 3)]).toEqual([
        [4, 3, 0, 4],
        [4, 0, 4, 0],
    ]);
    expect(refusalOf(edits.movePage(document, 3, 4))).toBe('page-in-use');
    expect(refusalOf(edits.copyPage(document, 3, 0))).toBe('trim-page');
    expect(refusalOf(edits.copyPage(document, 77, 78))).toBe('page-empty');
});

test('a damaged page is not edited, may be cleared or replaced, and comes back by undo', async () => {
    const library = await libraryDocument();
    const bytes = pageOf(library, 2).slice();
    bytes[70] = (bytes[70] ?? 0) ^ 1;
    const start = after(library, edits.replacePages(library, new Map([[2, bytes]])));
    expect(refusalOf(edits.rename(start, 2, 'x'))).toBe('page-damaged');
    expect(refusalOf(edits.copyPage(start, 2, 100))).toBe('page-damaged');
    const cleared = states.dispatch(states.startState(start), must(edits.clearPages(start, [2])));
    expect(format.isEmpty(pageOf(cleared.document, 2))).toBe(true);
    expect(isSamePage(pageOf(states.undoOne(cleared).document, 2), bytes)).toBe(true);
    expect(refusalOf(edits.clearPages(start, [0]))).toBe('trim-page');
});

test('pages that differ from the robot are known; those that were not read are not', async () => {
    const library = await libraryDocument();
    const robot = library.pages.map((bytes, page) => (page === 7 ? null : bytes));
    const edited = states.dispatch({ ...states.startState(library), robot }, must(edits.rename(library, 2, 'curtsy')));
    const both = states.dispatch(edited, must(edits.rename(edited.document, 7, 'unknown')));
    expect([...states.dirtyPages(both, format)]).toEqual([2]);
    const erased = { ...both, robot: robot.map(bytes => (bytes && format.isEmpty(bytes) ? new Uint8Array(512).fill(0xff) : bytes)) };
    expect([...states.dirtyPages(erased, format)]).toEqual([2]);
});
