// SPDX-License-Identifier: MIT
// Tries motions of the document in physics. Joins the editor with the worker for trials, which starts at the first use.

import { imageOf, pageOf } from '../model/document.ts';
import { AS_STORED, NOMINAL_VOLTS, TICKS_PER_SECOND } from '../model/motion.ts';
import type { Law, Shape } from '../model/motion.ts';
import { deepestTouches, posesOf, verdictOf } from '../model/trial.ts';
import type { Touch, TrialRecord, TrialRequest } from '../model/trial.ts';
import { wholeCurve } from '../model/whole-curve.ts';
import type { TrialClient } from '../sim/trial-client.ts';
import { Store } from '../view/store.ts';
import type { Trials, TrialsState } from '../view/session/trials.ts';
import { orAborted } from './aborted.ts';
import type { DocumentEditor } from './editor.ts';

/** A looping motion is stopped after 6 s, but not before it begins anew. */
const LOOP_TICKS = 6 * TICKS_PER_SECOND;
/** Any motion is stopped after this: 60 s, which take physics some seconds. */
const MOST_TICKS = 60 * TICKS_PER_SECOND;

/** The law and pages for which a trial is valid. */
interface Tried {
    readonly law: Law;
    readonly pages: ReadonlyMap<number, Uint8Array>;
}

const NOTHING: TrialsState = { phase: 'idle', page: null, done: 0, total: 0, trials: new Map(), trouble: null };

export class MotionTrials implements Trials {
    readonly state = new Store<TrialsState>(NOTHING);
    private readonly editor: DocumentEditor;
    private readonly makeClient: () => Promise<TrialClient>;
    private client: Promise<TrialClient> | null = null;
    private readonly tried = new Map<number, Tried>();
    private hasFailed = false;
    private stop = new AbortController();
    /** The worker tries one motion at a time. */
    private last: Promise<unknown> = Promise.resolve();

    constructor(editor: DocumentEditor, makeClient: () => Promise<TrialClient>) {
        this.editor = editor;
        this.makeClient = makeClient;
    }

    async run(pages: readonly number[]): Promise<void> {
        const { phase } = this.state.get();
        const due = pages.filter(page => this.isPlayable(page) && !this.isFresh(page));
        if (phase === 'loading' || phase === 'trying' || due.length === 0) return;
        this.stop = new AbortController();
        this.hasFailed = false;
        const { signal } = this.stop;
        this.state.set({ phase: 'loading', done: 0, total: due.length, trouble: null });
        try {
            const client = await orAborted(this.ready(), signal); // a stalled network can be stopped, too
            for (const [done, page] of due.entries()) {
                signal.throwIfAborted();
                this.state.set({ phase: 'trying', page, done });
                if (this.isPlayable(page)) await this.tryPage(client, page, signal);
            }
            this.state.set({ phase: 'idle', page: null, done: due.length });
        } catch (error) {
            const isStopped = signal.aborted;
            if (!isStopped) this.giveUp();
            this.state.set({ phase: isStopped ? 'idle' : 'failed', page: null, trouble: isStopped ? null : wordsOf(error) });
        }
    }

    cancel(): void {
        this.stop.abort();
    }

    /** Drops all results, because another document was opened. */
    forget(): void {
        this.cancel();
        this.tried.clear();
        this.state.set({ trials: new Map() });
    }

    isFresh(page: number): boolean {
        const { document, law } = this.editor.state.get();
        const tried = this.tried.get(page);
        return tried !== undefined && tried.law === law && [...tried.pages].every(([one, bytes]) => pageOf(document, one) === bytes);
    }

    isJudged(page: number): boolean {
        return this.isFresh(page) && this.state.get().trials.get(page)?.verdict.isWhole === true;
    }

    async follow(page: number, ticks: number, shape: Shape, signal: AbortSignal): Promise<Float32Array | null> {
        if (!this.isPlayable(page) || this.hasFailed) return null;
        const request = { ...this.request(page, shape, ticks), toTheEnd: false };
        try {
            const record = await this.play(await this.ready(), request, signal);
            return record.stood ? record.positions : null;
        } catch (error) {
            if (signal.aborted) throw error;
            this.giveUp();
            return null;
        }
    }

    async touching(pose: ArrayLike<number>): Promise<readonly Touch[]> {
        if (this.hasFailed) return [];
        try {
            const [touches] = await (await this.ready()).touching(Uint16Array.from(pose));
            return touches ?? [];
        } catch {
            this.giveUp();
            return []; // Checks reports the reason when it is used
        }
    }

    private async tryPage(client: TrialClient, page: number, signal: AbortSignal): Promise<void> {
        const { document, law } = this.editor.state.get();
        const reached = new Map(this.editor.format.reach(document, page).map(one => [one, pageOf(document, one)]));
        const pose = this.editor.firstPose(page, AS_STORED, this.editor.standingPose);
        const curve = wholeCurve(ticks => this.editor.curve(page, { ticks, from: pose }), LOOP_TICKS);
        if (!curve) return;
        const request = this.request(page, AS_STORED, Math.min(curve.ticks, MOST_TICKS), pose);
        const { poses, steps } = posesOf(curve, page);
        const touches = deepestTouches(steps, await client.touching(poses));
        const record = await this.play(client, request, signal);
        signal.throwIfAborted();
        const verdict = verdictOf(record, curve.ticks > MOST_TICKS);
        this.tried.set(page, { law, pages: reached });
        this.state.set({ trials: new Map([...this.state.get().trials, [page, { verdict, pages: record.pages, touches }]]) });
    }

    private play(client: TrialClient, request: TrialRequest, signal: AbortSignal): Promise<TrialRecord> {
        const mine = this.last.then(() => client.play(request, signal));
        this.last = mine.catch(() => undefined);
        return mine;
    }

    private request(page: number, shape: Shape, ticks: number, pose = this.editor.firstPose(page, shape)): TrialRequest {
        const { document, law } = this.editor.state.get();
        return {
            image: imageOf(document),
            page,
            law,
            shape,
            pose,
            ticks,
            toTheEnd: true,
            volts: NOMINAL_VOLTS,
        };
    }

    private isPlayable(page: number): boolean {
        return page > 0 && this.editor.format.isPlayable(pageOf(this.editor.state.get().document, page));
    }

    private ready(): Promise<TrialClient> {
        if (this.client) return this.client;
        const made = this.makeClient();
        made.catch(() => {
            if (this.client === made) this.client = null; // the next try loads it again
        });
        this.client = made;
        return made;
    }

    /** Physics does not work. It is not tried again until a person asks. */
    private giveUp(): void {
        this.hasFailed = true;
        void this.client?.then(
            client => client.dispose(),
            () => undefined,
        );
        this.client = null;
    }
}

function wordsOf(error: unknown): string {
    return error instanceof Error ? error.message : String(error);
}
