// SPDX-License-Identifier: MIT
// The page's end of the worker for trials.

import type { Touch, TrialRecord, TrialRequest } from '../model/trial.ts';
import type { FromTrials, ToTrials, TrialParts } from './trial-messages.ts';

/** Id of the worker's start. */
const STARTED = 0;

interface Waiting {
    readonly take: (message: FromTrials) => void;
    readonly fail: (error: Error) => void;
}

export class TrialClient {
    private readonly worker: Worker;
    private readonly waiting = new Map<number, Waiting>();
    private readonly started: Promise<void>;
    private nextId = 1;

    /** worker: a new one that runs trial-worker.ts. */
    constructor(worker: Worker, parts: TrialParts) {
        this.worker = worker;
        this.started = new Promise((take, fail) => this.waiting.set(STARTED, { take: () => take(), fail }));
        this.started.catch(() => undefined); // each request reports it
        worker.onmessage = (event: MessageEvent<FromTrials>) => this.take(event.data);
        worker.onerror = event => this.failAll(new Error(event.message));
        this.post({ kind: 'start', ...parts }, [parts.wasm]);
    }

    /** Rejects with the worker's message, or with the signal's reason if cancelled. */
    async play(request: TrialRequest, signal: AbortSignal): Promise<TrialRecord> {
        signal.throwIfAborted();
        const cancel = (): void => this.post({ kind: 'cancel' });
        signal.addEventListener('abort', cancel);
        const cancelled = new Promise<never>((_, fail) => signal.addEventListener('abort', () => fail(signal.reason as Error)));
        try {
            const answer = await Promise.race([this.ask(id => ({ kind: 'play', id, request })), cancelled]);
            if (answer.kind !== 'played') throw new Error('the trial was not answered');
            return answer.record;
        } finally {
            signal.removeEventListener('abort', cancel);
        }
    }

    /** poses: servo units by ID, JOINTS numbers each. */
    async touching(poses: Uint16Array): Promise<readonly (readonly Touch[])[]> {
        const answer = await this.ask(id => ({ kind: 'touch', id, poses }));
        if (answer.kind !== 'touched') throw new Error('the poses were not answered');
        return answer.touches;
    }

    dispose(): void {
        this.worker.terminate();
        this.failAll(new Error('the trials have ended'));
    }

    private async ask(messageOf: (id: number) => ToTrials): Promise<FromTrials> {
        await this.started;
        const id = this.nextId++;
        return new Promise((take, fail) => {
            this.waiting.set(id, { take, fail });
            this.post(messageOf(id));
        });
    }

    private post(message: ToTrials, transfer: Transferable[] = []): void {
        this.worker.postMessage(message, transfer);
    }

    private take(message: FromTrials): void {
        if (message.kind === 'failed' && message.id === null) return this.failAll(new Error(message.text));
        const id = message.kind === 'started' ? STARTED : (message.id ?? STARTED);
        const waiting = this.waiting.get(id);
        this.waiting.delete(id);
        if (message.kind === 'failed') waiting?.fail(new Error(message.text));
        else waiting?.take(message);
    }

    private failAll(error: Error): void {
        for (const { fail } of this.waiting.values()) fail(error);
        this.waiting.clear();
    }
}
