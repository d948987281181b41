// SPDX-License-Identifier: MIT
// The worker in which Play or Edit drives servos: the program, its adapter and its messages (messages.ts). The port is opened here rather
// than in the page, so that drawing never delays a goal.

import { Adapter } from './adapter.ts';
import type { AdapterPort } from './adapter.ts';
import { AdapterPorts } from './adapter-ports.ts';
import type { KindOfPort } from './adapter-ports.ts';
import { runProgram } from './machine.ts';
import type { FromServos, ToServos } from './messages.ts';
import { Sleeper } from './sleeper.ts';

/** The part of Web Serial that is used here. */
type BrowserPort = AdapterPort & KindOfPort;
declare const navigator: { readonly serial: { onconnect: () => void; getPorts(): Promise<BrowserPort[]> } };

const RATE_BPS = 1_000_000;

const sleeper = new Sleeper();
const typed: number[] = [];
const keeping = new Map<number, (isKept: boolean) => void>();
let nextId = 1;
let isAskedToEnd = false;

function tell(message: FromServos, transfer: Transferable[] = []): void {
    postMessage(message, { transfer });
}

async function start({ module, kept, port }: Extract<ToServos, { kind: 'start' }>): Promise<void> {
    const chosen = (await navigator.serial.getPorts())[port];
    const ports = chosen && new AdapterPorts(chosen);
    const find = async (): Promise<BrowserPort | null> => ports?.find(await navigator.serial.getPorts()) ?? null;
    navigator.serial.onconnect = () => void find(); // what is plugged in beside the adapter is not the adapter
    const adapter = new Adapter(find, {
        news: () => sleeper.wake(),
        isThere: isThere => tell({ kind: 'adapter', isThere }),
    });
    try {
        await adapter.open(RATE_BPS);
    } catch (cause) {
        return tell({ kind: 'refused', text: cause instanceof Error ? cause.message : String(cause) });
    }
    tell({ kind: 'started' });
    await runProgram(module, {
        adapter,
        kept,
        now: () => performance.now(),
        sleep: untilMs => sleeper.sleep(untilMs),
        isAskedToEnd: () => isAskedToEnd,
        typed: to => take(to),
        printed: bytes => tell({ kind: 'bytes', bytes }, [bytes.buffer]),
        sentence: text => tell({ kind: 'sentence', text }),
        keep: memories =>
            new Promise(resolve => {
                const id = nextId++;
                keeping.set(id, resolve);
                tell({ kind: 'keep', id, memories });
            }),
    });
    await adapter.close();
    tell({ kind: 'ended' });
}

function take(to: Uint8Array): number {
    const bytes = typed.splice(0, to.length);
    to.set(bytes);
    return bytes.length;
}

function crash(cause: unknown): void {
    tell({ kind: 'crashed', text: cause instanceof Error ? cause.message : String(cause) });
}

self.onmessage = (event: MessageEvent<ToServos>) => {
    const message = event.data;
    switch (message.kind) {
        case 'start':
            return void start(message).catch(crash);
        case 'bytes':
            typed.push(...message.bytes);
            return sleeper.wake();
        case 'end':
            isAskedToEnd = true;
            return sleeper.wake();
        case 'kept':
            keeping.get(message.id)?.(message.isKept);
            keeping.delete(message.id);
            return;
        default:
            message satisfies never;
    }
};
