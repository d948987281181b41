// SPDX-License-Identifier: MIT
// The browser's Worker for tests in Node, as far as sim/robot-client.ts and sim/worker.ts need it: a thread. Messages posted together are
// received together, so that nothing the worker waits for can come between them.
import { Worker as Thread } from 'node:worker_threads';

const BOOT = (url: string): string => `
  const { parentPort } = require('node:worker_threads');
  globalThis.self = globalThis;
  globalThis.postMessage = (message, { transfer = [] } = {}) => parentPort.postMessage(message, transfer);
  const ready = import(${JSON.stringify(url)});
  parentPort.on('message', (posted) => ready.then(() => posted.forEach((data) => self.onmessage({ data }))));
`;

export class NodeWorker {
    /** Workers that were not terminated. */
    static readonly alive = new Set<NodeWorker>();
    onmessage: ((event: { data: unknown }) => void) | null = null;
    onerror: ((event: { message: string }) => void) | null = null;
    private readonly thread: Thread;
    private posted: unknown[] = [];
    private transferred: ArrayBuffer[] = [];

    constructor(url: URL) {
        NodeWorker.alive.add(this);
        this.thread = new Thread(BOOT(url.href), { eval: true });
        this.thread.on('message', (data: unknown) => this.onmessage?.({ data }));
        this.thread.on('error', error => this.onerror?.({ message: error instanceof Error ? error.message : String(error) }));
    }

    postMessage(message: unknown, transfer: ArrayBuffer[] = []): void {
        if (this.posted.length === 0) queueMicrotask(() => this.send());
        this.posted.push(message);
        this.transferred.push(...transfer);
    }

    terminate(): void {
        NodeWorker.alive.delete(this);
        void this.thread.terminate();
    }

    private send(): void {
        this.thread.postMessage(this.posted, this.transferred);
        this.posted = [];
        this.transferred = [];
    }
}
