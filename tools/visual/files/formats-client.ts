// SPDX-License-Identifier: MIT
// The page's end of the worker with Python. The worker starts at the first request.

import type { Difference, FileFormats, Finding, FormatsWorker, NoRoom, Opened, Refused, Saved } from '../model/file-formats.ts';
import type { FromFiles, PythonParts, ToFiles } from './messages.ts';

/** The browser gives no message if it could not load a worker's program. */
const NOT_LOADED = 'its program was not loaded';

type Ask = keyof FileFormats;

interface Waiting {
    readonly ask: Ask;
    readonly message: ToFiles;
    readonly resolve: (answer: unknown) => void;
    readonly reject: (error: Error) => void;
}

export class FormatsClient implements FormatsWorker {
    private readonly parts: PythonParts;
    private readonly makeWorker: () => Worker;
    private worker: Worker | null = null;
    private readonly waiting = new Map<number, Waiting>();
    private lastId = 0;

    constructor(parts: PythonParts, makeWorker: () => Worker) {
        this.parts = parts;
        this.makeWorker = makeWorker;
    }

    open(name: string, data: Uint8Array, leaveOut = false): Promise<Opened | NoRoom | Refused> {
        return this.ask('open', name, data, leaveOut);
    }

    save(name: string, image: Uint8Array): Promise<Saved | Refused> {
        return this.ask('save', name, image);
    }

    check(image: Uint8Array): Promise<readonly Finding[]> {
        return this.ask('check', image);
    }

    differences(first: Uint8Array, second: Uint8Array): Promise<readonly Difference[]> {
        return this.ask('differences', first, second);
    }

    cancel(): void {
        this.worker?.terminate(); // Python receives no messages while it works
        this.worker = null;
        for (const [id, { ask, message, reject }] of [...this.waiting]) {
            if (ask !== 'open' && ask !== 'save') {
                this.started().postMessage(message);
                continue;
            }
            this.waiting.delete(id);
            reject(new Error('cancelled'));
        }
    }

    private ask<K extends Ask, A>(ask: K, ...what: Parameters<FileFormats[K]>): Promise<A> {
        const id = ++this.lastId;
        const message = { kind: 'question', id, ask, what } as ToFiles; // the parameters belong to `ask`
        return new Promise<A>((resolve, reject) => {
            this.waiting.set(id, { ask, message, resolve: resolve as (answer: unknown) => void, reject });
            this.started().postMessage(message);
        });
    }

    private started(): Worker {
        if (this.worker) return this.worker;
        this.worker = this.makeWorker();
        this.worker.onmessage = ({ data }: MessageEvent<FromFiles>) => this.hear(data);
        this.worker.onerror = event => this.crashed(event.message ?? NOT_LOADED);
        this.worker.postMessage({ kind: 'parts', parts: this.parts } satisfies ToFiles);
        return this.worker;
    }

    private hear(message: FromFiles): void {
        const waiting = this.waiting.get(message.id);
        this.waiting.delete(message.id);
        switch (message.kind) {
            case 'answer':
                return waiting?.resolve(message.answer);
            case 'trouble':
                return waiting?.reject(new Error(message.text));
            default:
                return message satisfies never;
        }
    }

    /** Usually out of memory. The next request starts a new worker. */
    private crashed(text: string): void {
        this.worker?.terminate();
        this.worker = null;
        for (const { reject } of this.waiting.values()) reject(new Error(text));
        this.waiting.clear();
    }
}
