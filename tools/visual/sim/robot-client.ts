// SPDX-License-Identifier: MIT
// The page's end of the worker with the simulated robot: a Port, and the knobs that a real robot has not.

import { BytePort } from './byte-port.ts';
import type { FromSim, ToSim } from './messages.ts';
import type { Memories } from './machine.ts';

export interface SimulatedRobotEvents {
  /** Everything but bytes, which go to the port, and memories that were asked for. */
  message(message: FromSim): void;
}

export class SimulatedRobot {
  readonly port: BytePort;
  private readonly worker: Worker;
  private readonly events: SimulatedRobotEvents;
  private readonly waiting = new Map<number, (memories: Memories) => void>();
  private nextId = 1;

  /** worker: a new one that runs worker.ts. */
  constructor(worker: Worker, events: SimulatedRobotEvents) {
    this.worker = worker;
    this.events = events;
    this.port = new BytePort('the robot in this page', (bytes) => this.post({ kind: 'bytes', sender: 'pc', bytes }));
    worker.onmessage = (event: MessageEvent<FromSim>) => this.take(event.data);
    worker.onerror = (event) => events.message({ kind: 'crashed', text: event.message });
  }

  post(message: ToSim, transfer: Transferable[] = []): void {
    this.worker.postMessage(message, transfer);
  }

  /** Flash and EEPROM as they are now. */
  memories(): Promise<Memories> {
    const id = this.nextId++;
    return new Promise((resolve) => {
      this.waiting.set(id, resolve);
      this.post({ kind: 'memories', id });
    });
  }

  dispose(): void {
    this.worker.terminate();
  }

  private take(message: FromSim): void {
    if (message.kind === 'bytes') return this.port.push(message.bytes);
    if (message.kind === 'memories' && message.id !== null) {
      this.waiting.get(message.id)?.(message.memories);
      this.waiting.delete(message.id);
      return;
    }
    this.events.message(message);
    if (message.kind === 'state') this.post({ kind: 'seen' });
  }
}
