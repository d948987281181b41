// SPDX-License-Identifier: MIT
// My servos: Play or Edit in a worker of this page drives servos on an adapter (Web Serial). All other code sees a robot on a line.

import type { Body } from '../model/body.ts';
import type { Connection } from '../robot/connection.ts';
import { RobotError } from '../robot/robot-error.ts';
import { WebSerialPort } from '../robot/web-serial-port.ts';
import { AdapterPorts } from '../servos/adapter-ports.ts';
import { canRunServos } from '../servos/machine.ts';
import type { FromServos } from '../servos/messages.ts';
import { ServosClient } from '../servos/servos-client.ts';
import type { ImageName } from '../view/session/session.ts';
import { loadServos, saveServos } from '../view/robot-store.ts';
import { errorText } from '../view/texts/robot.ts';
import { TEXTS } from '../view/texts/texts.ts';
import { motionLibrary, servosModule } from './assets.ts';
import { imageError } from './image-error.ts';
import { FollowedRobot } from './followed-robot.ts';
import { holdServos } from './hold-document.ts';
import type { Release } from './hold-document.ts';
import { rememberAdapter, withPort } from './serial-ports.ts';
import type { SourceEvents } from './simulated-source.ts';
import { Turns } from './turns.ts';

/** Time limit for the robot to come to a stop before the program is ended. */
const STAND_MS = 5000;
/** Play's echo of a typed `on` or `@torque on` and its OK, with no prompt in between. Edit's screen does not show whether it has obeyed. */
const SWITCHED_ON = /\bon[ ,\d-]*\r\n(?:(?!\] ).*\r\n)*(?: |@torque )OK\r\n/;
const HEARD_MOST = 200;

export class ServosSource {
    private readonly events: SourceEvents;
    private readonly robot: FollowedRobot;
    private chosen: { readonly ports: AdapterPorts<SerialPort>; readonly name: string } | null = null;
    private client: ServosClient | null = null;
    private image: ImageName = 'play';
    private readonly turns = new Turns();
    /** Lets another tab use the memories. null: this tab does not use them. */
    private release: Release | null = null;
    /** false: another robot was chosen. A program that is being restarted then stays ended. */
    private isUsed = false;
    /** What the browser has not stored, or could not. The next program gets it all the same. */
    private unstored: readonly Uint8Array[] | null = null;
    /** false: what is stored could not be read, and must not be replaced by what the program then has: the motions of a new robot. */
    private mayStore = true;
    /** What Play has printed since the adapter is back. null: no torque waits for `on`. */
    private heard: string | null = null;

    constructor(body: Body, events: SourceEvents, mayAsk: () => boolean) {
        this.events = events;
        const text = (bytes: Uint8Array): void => {
            this.hear(bytes);
            events.text(bytes);
        };
        this.robot = new FollowedRobot(body, { ...events, text }, mayAsk);
    }

    get connection(): Connection | null {
        return this.robot.connection;
    }

    /** Lets the person choose the adapter. false: the chooser was closed. */
    async choose(): Promise<boolean> {
        if ('serial' in navigator && !canRunServos()) throw new RobotError('old-browser');
        return withPort(async () => {
            const port = await navigator.serial.requestPort();
            this.chosen = { ports: new AdapterPorts(port), name: new WebSerialPort(port, TEXTS.menu.port).name };
            navigator.serial.onconnect = () => void this.place(); // what is plugged in beside the adapter is not the adapter
            rememberAdapter(port);
        });
    }

    /** Resolves when the adapter is open and the program runs; call connect() then. Rejects with RobotError, and nothing runs. */
    start(image: ImageName): Promise<void> {
        return this.turns.run(async () => {
            this.release ??= await holdServos(); // two tabs would overwrite each other's memories
            if (!this.release) throw new RobotError('second-tab');
            this.isUsed = true;
            try {
                await this.begin(image, await programOf(image));
            } catch (error) {
                this.letGo();
                throw error;
            }
        });
    }

    connect(): void {
        if (this.client) this.robot.connect(this.client.port);
    }

    /** Stops the robot and starts another program on the same servos. The memories are kept. */
    restart(image: ImageName): Promise<void> {
        return this.turns.run(() => this.again(image));
    }

    /** Nothing to do: the robot stands where its owner has put it. */
    prepare(): Promise<void> {
        return Promise.resolve();
    }

    /** Stops movement. Servos that hold their pose keep holding it. */
    close(): Promise<void> {
        this.isUsed = false;
        return this.turns.run(async () => {
            await this.end();
            this.letGo();
        });
    }

    private letGo(): void {
        this.release?.();
        this.release = null;
    }

    private async again(image: ImageName): Promise<void> {
        if (!this.isUsed) return;
        const module = await programOf(image); // if it cannot be had, the robot goes on as it was
        if (!this.isUsed) return;
        this.events.change({ connection: 'closed', version: null, where: null, adapter: null, stopped: null });
        await this.end();
        if (!this.isUsed) return;
        try {
            await this.begin(image, module);
        } catch (error) {
            this.stop(whyStopped(error));
            throw error;
        }
        if (this.isUsed) this.connect();
    }

    private async begin(image: ImageName, module: WebAssembly.Module): Promise<void> {
        const { chosen } = this;
        if (!chosen) throw new RobotError('not-connected');
        const kept = await this.memories();
        const port = await this.place();
        if (port < 0) throw new RobotError('adapter-out');
        const worker = new Worker(new URL('../servos/worker.ts', import.meta.url), { type: 'module', name: 'servos' });
        let runs = false;
        await new Promise<void>((resolve, reject) => {
            const client: ServosClient = new ServosClient(worker, chosen.name, {
                keep: memories => this.keep(memories),
                message: message => {
                    if (message.kind === 'started') resolve();
                    else if (message.kind === 'refused') reject(new RobotError('port-busy', message.text));
                    else if (message.kind === 'crashed' && !runs) reject(new RobotError('no-image', message.text));
                    else if (this.client === client) this.take(message);
                },
            });
            this.client = client;
            client.post({ kind: 'start', module, kept, port });
        }).catch((error: unknown) => {
            worker.terminate();
            this.client = null;
            throw error;
        });
        runs = true;
        this.image = image;
    }

    /** The adapter's place among the ports that are plugged in; -1: it is out. */
    private async place(): Promise<number> {
        const ports = await navigator.serial.getPorts();
        const adapter = this.chosen?.ports.find(ports);
        return adapter ? ports.indexOf(adapter) : -1;
    }

    private async end(): Promise<void> {
        const { client } = this;
        this.client = null;
        await this.robot.close();
        await client?.end(STAND_MS);
    }

    private take(message: FromServos): void {
        switch (message.kind) {
            case 'sentence':
                return this.say(message.text, 'calm');
            case 'adapter':
                this.heard = message.isThere ? '' : null;
                return this.events.change({ adapter: message.isThere ? 'back' : 'out' });
            case 'ended': // restarts, as a board does
                return void this.restart(this.image).catch((error: unknown) => this.stop(whyStopped(error)));
            case 'crashed':
                return this.stop(`${TEXTS.robot.servosCrashed} (${message.text})`);
            case 'started':
            case 'refused':
            case 'bytes':
            case 'keep':
                return; // handled elsewhere
            default:
                message satisfies never;
        }
    }

    private hear(bytes: Uint8Array): void {
        if (this.heard === null) return;
        this.heard = (this.heard + new TextDecoder('latin1').decode(bytes)).slice(-HEARD_MOST);
        if (!SWITCHED_ON.test(this.heard)) return;
        this.heard = null;
        this.events.change({ adapter: null });
    }

    private say(text: string, tone: 'calm' | 'bad'): void {
        this.events.change({ message: { text, tone } });
    }

    private stop(why: string): void {
        this.events.change({ stopped: why, doing: { text: why, tone: 'bad' } });
    }

    /** The memories of the program before, or those of a new robot: the motion library. */
    private async memories(): Promise<(Uint8Array | null)[]> {
        if (this.unstored) return [...this.unstored];
        this.mayStore = true;
        const kept = await loadServos().catch(() => {
            this.mayStore = false;
            this.say(TEXTS.robot.notKept, 'bad');
            return null;
        });
        return kept ? [...kept] : [await motionLibrary(), null, null];
    }

    private setUnstored(memories: readonly Uint8Array[] | null): void {
        this.unstored = memories;
        this.events.change({ hasUnkeptServos: memories !== null });
    }

    private async keep(memories: readonly Uint8Array[]): Promise<boolean> {
        this.setUnstored(memories);
        try {
            if (!this.mayStore) throw new Error('what is stored could not be read');
            await saveServos(memories);
            if (memories === this.unstored) this.setUnstored(null);
            return true;
        } catch {
            this.say(TEXTS.robot.notKept, 'bad');
            return false;
        }
    }
}

/** A program that did not start has been ended before, so it does not go on, as the text on an image says. */
function whyStopped(error: unknown): string {
    return error instanceof RobotError && error.code !== 'no-image' ? errorText(error) : TEXTS.robot.servosCrashed;
}

async function programOf(image: ImageName): Promise<WebAssembly.Module> {
    try {
        return await servosModule(image);
    } catch (cause) {
        throw imageError(cause);
    }
}
