// SPDX-License-Identifier: MIT
// The page's end of the worker with the simulated robot: a Port, and the controls that a real robot does not have.

import { wallClock } from '../robot/clock.ts';
import type { Clock } from '../robot/clock.ts';
import { BytePort } from './byte-port.ts';
import type { FromSim, ToSim } from './messages.ts';
import type { Memories } from './machine.ts';

/** The worker reads its messages every few milliseconds. If it does not answer for this long, it has hung. */
const ANSWER_MS = 60_000;

export interface SimulatedRobotEvents {
    /** All messages except bytes, which go to the port, and requested memories. */
    message(message: FromSim): void;
}

export class SimulatedRobot {
    readonly port: BytePort;
    private readonly worker: Worker;
    private readonly events: SimulatedRobotEvents;
    private readonly clock: Clock;
    private readonly waiting = new Map<number, { take(memories: Memories): void; fail(error: Error): void }>();
    private nextId = 1;
    private crash: Error | null = null;

    /** worker: a new one that runs worker.ts. */
    constructor(worker: Worker, events: SimulatedRobotEvents, clock: Clock = wallClock) {
        this.worker = worker;
        this.events = events;
        this.clock = clock;
        this.port = new BytePort('the robot in this page', bytes => this.post({ kind: 'bytes', sender: 'pc', bytes }));
        worker.onmessage = (event: MessageEvent<FromSim>) => this.take(event.data);
        worker.onerror = event => this.take({ kind: 'crashed', text: event.message });
    }

    post(message: ToSim, transfer: Transferable[] = []): void {
        this.worker.postMessage(message, transfer);
    }

    /** The current flash and EEPROM. Rejects if the worker has crashed or does not answer. */
    memories(): Promise<Memories> {
        const id = this.nextId++;
        return new Promise((resolve, fail) => {
            if (this.crash) return fail(this.crash);
            const cancel = this.clock.after(ANSWER_MS, () => this.end(id)?.fail(new Error('the worker does not answer')));
            this.waiting.set(id, {
                take: memories => {
                    cancel();
                    resolve(memories);
                },
                fail: error => {
                    cancel();
                    fail(error);
                },
            });
            this.post({ kind: 'memories', id });
        });
    }

    dispose(): void {
        this.worker.terminate();
    }

    /** The request that waits for this answer, if it still does. */
    private end(id: number) {
        const waiting = this.waiting.get(id);
        this.waiting.delete(id);
        return waiting;
    }

    private take(message: FromSim): void {
        if (message.kind === 'bytes') return this.port.push(message.bytes);
        if (message.kind === 'memories' && message.id !== null) return this.end(message.id)?.take(message.memories);
        if (message.kind === 'crashed') {
            this.crash = new Error(message.text);
            for (const id of [...this.waiting.keys()]) this.end(id)?.fail(this.crash);
        }
        this.events.message(message);
        if (message.kind === 'state') this.post({ kind: 'seen' });
    }
}
