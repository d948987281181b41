// SPDX-License-Identifier: MIT
// The page's results of trials: what is valid, what a change invalidates, what is skipped, and what happens without physics.
import { expect, test, vi } from 'vitest';
import { DocumentEditor } from '../app/editor.ts';
import { MotionTrials } from '../app/trials.ts';
import { NO_HISTORY } from '../model/history.ts';
import { pageOf } from '../model/document.ts';
import { AS_STORED, STANDING_PAGE } from '../model/motion.ts';
import { readPage } from '../model/page.ts';
import type { TrialRecord, TrialRequest } from '../model/trial.ts';
import type { TrialClient } from '../sim/trial-client.ts';
import { BODY as body, libraryDocument, makeFormat, makeMotion } from './motion-bench.ts';
import { played, trialBench } from './trial-bench.ts';

const { format } = await makeFormat();
const player = await makeMotion();
const library = await libraryDocument();
const WALK = 20;
const STOOD: TrialRecord = { stood: true, ticks: 128, positions: new Float32Array(), pages: [], fell: null, ended: true, onFeet: true };

async function bench(made: () => Promise<Partial<TrialClient>>) {
    const events = { changed: () => undefined, refused: () => undefined, opened: () => trials.forget() };
    const editor: DocumentEditor = new DocumentEditor(body, { format, player, document: library, library: library.pages }, events);
    const trials: MotionTrials = new MotionTrials(editor, made as () => Promise<TrialClient>);
    return { editor, trials };
}

/** Physics in which everything stands. Records what it was asked. */
function standing(asked: number[], seconds: number[] = []): () => Promise<Partial<TrialClient>> {
    return () =>
        Promise.resolve({
            play: (request: TrialRequest, signal: AbortSignal) => {
                asked.push(request.page);
                seconds.push(Math.round(request.ticks / 128));
                return signal.aborted ? Promise.reject(signal.reason as Error) : Promise.resolve({ ...STOOD, pages: [request.page] });
            },
            touching: () => Promise.resolve([]),
            dispose: () => undefined,
        });
}

test('a trial holds until a page that the play reaches is changed, or the law is; undo makes it hold again', async () => {
    const asked: number[] = [];
    const { editor, trials } = await bench(standing(asked));
    await trials.run([2, 8, 100]); // 8 continues in 9 and 10; 100 has no action
    expect(asked).toEqual([2, 8]);
    expect(trials.state.get()).toMatchObject({ phase: 'idle', done: 2 });
    const change = (page: number): boolean => editor.dispatch(editor.edits.setTime(editor.state.get().document, page, [0], 99));
    change(10);
    expect([2, 8].map(page => trials.isFresh(page))).toEqual([true, false]);
    editor.undo();
    expect(trials.isFresh(8)).toBe(true);
    editor.select({ law: 'classic' });
    expect(trials.isFresh(2)).toBe(false);
    editor.select({ law: 'exact' });
    change(2);
    await trials.run([2, 8]);
    expect(asked).toEqual([2, 8, 2]);
});

test('a motion is tried to its end, one that loops for 6 s and at least once; what goes on for more than 60 s is not judged', async () => {
    const seconds: number[] = [];
    const { editor, trials } = await bench(standing([], seconds));
    const still = { positions: Array.from({ length: 31 }, () => 512), time: 255, pause: 255 };
    const [once, loops, slow] = [100, 101, 102];
    for (const [page, header] of [[once, {}] as const, [loops, { next: loops }] as const, [slow, { speed: 255 }] as const]) {
        editor.dispatch(editor.edits.insertSteps(editor.state.get().document, page, 0, new Array(7).fill(still)));
        editor.dispatch(editor.edits.setHeader(editor.state.get().document, page, header));
    }
    const pages = [WALK, once, loops, slow];
    await trials.run(pages);
    expect(seconds).toEqual([6, 28, 28, 60]); // 7 steps of 4 s at nominal speed 32
    expect(pages.map(page => trials.isJudged(page))).toEqual([true, true, true, false]);
});

test('joints that the first step does not use begin where the robot of the page stands: with bent knees; so does what it is judged by', async () => {
    const { stand } = await trialBench();
    const poses: number[][] = [];
    const play = (request: TrialRequest) => {
        poses.push(Array.from(request.pose));
        return Promise.resolve(played(stand, request));
    };
    const { editor, trials } = await bench(() => Promise.resolve({ play, touching: () => Promise.resolve([]) }));
    const [LOOK, MINE, ANKLE] = [61, 64, 15];
    const change = (edit: Parameters<typeof editor.dispatch>[0]): boolean => editor.dispatch(edit);
    const document = () => editor.state.get().document;
    change(editor.edits.copyPage(document(), LOOK, MINE));
    change(editor.edits.setHeader(document(), MINE, { next: 0, exit: 0, repetitions: 1 }));
    await trials.run([MINE]);
    change(editor.edits.setJoints(document(), MINE, [3], new Map([[ANKLE, 501]]))); // 155 from where it stands: it falls to its back
    change(editor.edits.setTime(document(), MINE, [3], 40));
    change(editor.edits.clearPages(document(), [STANDING_PAGE])); // of the document, not of the robot that stands
    const before = trials.state.get().trials.get(MINE)?.verdict.kind;
    await trials.run([MINE]);
    expect([before, trials.state.get().trials.get(MINE)?.verdict.kind]).toEqual(['stands', 'falls']);
    const ready = readPage(format, pageOf(library, STANDING_PAGE)).steps[0]?.positions ?? [];
    expect(poses.map(pose => pose[ANKLE])).toEqual([ready[ANKLE], ready[ANKLE]]);
});

test('another document knows nothing; who stops keeps what is known', async () => {
    const asked: number[] = [];
    const { editor, trials } = await bench(standing(asked));
    const unwatch = trials.state.watch(({ page }) => page === 4 && trials.cancel());
    await trials.run([2, 4, 5]);
    unwatch();
    expect([...trials.state.get().trials.keys()]).toEqual([2]);
    expect(trials.state.get()).toMatchObject({ phase: 'idle', trouble: null });
    editor.open(library, NO_HISTORY);
    expect(trials.state.get().trials.size).toBe(0);
    expect(trials.isFresh(2)).toBe(false);
});

test('without physics it says so; poses and curves do not ask for it again and again, a person may', async () => {
    let made = 0;
    const { trials } = await bench(() => {
        made++;
        return Promise.reject(new Error('no memory'));
    });
    expect(await trials.touching(new Array<number>(31).fill(512))).toEqual([]);
    expect(await trials.touching(new Array<number>(31).fill(500))).toEqual([]);
    expect(await trials.follow(2, 100, AS_STORED, new AbortController().signal)).toBeNull();
    expect(made).toBe(1);
    await trials.run([2]);
    expect(trials.state.get()).toMatchObject({ phase: 'failed', trouble: 'no memory' });
    expect(made).toBe(2);
});

test('who stops while physics is being loaded need not wait for the network, and may try again at once', async () => {
    const asked: number[] = [];
    let arrive = (): void => undefined;
    const { trials } = await bench(async () => {
        await new Promise<void>(resolve => (arrive = resolve));
        return standing(asked)();
    });
    const run = trials.run([2]);
    expect(trials.state.get().phase).toBe('loading');
    trials.cancel();
    await run; // the network has stalled
    expect(trials.state.get()).toMatchObject({ phase: 'idle', trouble: null });
    const again = trials.run([2]);
    arrive();
    await again;
    expect(asked).toEqual([2]);
});

test('physics that could not be loaded once, and can when a person tries again: collisions and lags are there, too', async () => {
    let made = 0;
    const { trials } = await bench(() => (made++ === 0 ? Promise.reject(new Error('no network')) : standing([])()));
    await trials.run([2]);
    await trials.run([2]);
    expect(await trials.follow(2, 100, AS_STORED, new AbortController().signal)).not.toBeNull();
});

test('a lag that is asked for during a trial waits for it: a new play would end the one before without an answer', async () => {
    const answers: (() => void)[] = [];
    const play = () => new Promise<TrialRecord>(resolve => answers.push(() => resolve(STOOD)));
    const { trials } = await bench(() => Promise.resolve({ play, touching: () => Promise.resolve([]) }));
    const run = trials.run([2]);
    await vi.waitFor(() => expect(answers).toHaveLength(1));
    const lag = trials.follow(2, 100, AS_STORED, new AbortController().signal);
    await new Promise(resolve => setTimeout(resolve));
    expect(answers).toHaveLength(1);
    answers[0]?.();
    await vi.waitFor(() => expect(answers).toHaveLength(2));
    answers[1]?.();
    await Promise.all([run, lag]);
});
