// SPDX-License-Identifier: MIT
// The robot in the page: its worker, its memory in the browser, and the hand that holds it up until its legs bear it.

import type { Body } from '../model/body.ts';
import { STANDING_PAGE } from '../model/motion.ts';
import { Connection } from '../robot/connection.ts';
import type { ConnectionState } from '../robot/connection-table.ts';
import type { Where } from '../robot/protocol.ts';
import { askWhere, command, play } from '../robot/protocol.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { RobotState } from '../robot/robot-state.ts';
import type { Images } from '../sim/machine.ts';
import type { FromSim, ToSim } from '../sim/messages.ts';
import { SimulatedRobot } from '../sim/robot-client.ts';
import type { SessionState, ImageName } from '../view/session/session.ts';
import type { KeptRobot } from '../view/robot-store.ts';
import { TEXTS } from '../view/texts/texts.ts';
import { boardModule, physics, robotImages } from './assets.ts';
import { RobotMemory, motionsIn } from './robot-memory.ts';
import type { MemoryEvents } from './robot-memory.ts';
import { TickClock } from './tick-clock.ts';
import { Turns } from './turns.ts';

const STAND_LIMIT_MS = 8000;
const ASK_MS = 50;
const WHERE_MS = 3000;
/** Then the robot goes on without physics. What a slow line brings later is still used. */
const PHYSICS_MS = 120_000;
/** Frames to wait for the worker to report that the hand has let go. */
const MOST_FRAMES = 60;

interface Parts {
    readonly image: ImageName;
    readonly module: WebAssembly.Module;
    readonly images: Images;
}

export interface SourceEvents {
    frame(state: RobotState): void;
    text(bytes: Uint8Array): void;
    connection(state: ConnectionState): void;
    change(change: Partial<SessionState>): void;
    /** The robot in the page has these motion pages in its flash: 65,536 bytes. */
    motions(image: Uint8Array): void;
}

export class SimulatedSource {
    private readonly body: Body;
    private readonly events: SourceEvents & MemoryEvents;
    private readonly memory: RobotMemory;
    private robot: SimulatedRobot | null = null;
    /** One robot at a time: the second of two quick requests waits for the first. */
    private readonly turns = new Turns();
    private isShown = true;
    private standing: Promise<void> | null = null;
    private isInHand = false;
    private clock = new TickClock();
    private readonly waiting: ((state: RobotState) => void)[] = [];
    /** Tells who waits for the robot to stand up that it never will. */
    private giveUp: (why: RobotError) => void = () => undefined;
    /** Ends the wait for physics. */
    private physicsCame: () => void = () => undefined;
    /** Why it does not run any more; null: it runs. */
    private stopped: string | null = null;
    private stops = 0;
    /** What standing up has interrupted and goes on with afterwards. */
    private interrupted: Where | null = null;
    /** Floor, battery and faults as the person has set them. The next robot gets them, too. */
    private readonly room = new Map<string, ToSim>();
    /** Counts changes of the image. The last one counts. */
    private asked = 0;
    private running: ImageName = 'play';
    /** What runs, or will as soon as it is loaded. */
    image: ImageName = 'play';
    connection: Connection | null = null;

    constructor(body: Body, events: SourceEvents & MemoryEvents) {
        this.body = body;
        this.events = events;
        this.memory = new RobotMemory(events);
    }

    start(image: ImageName): Promise<void> {
        return this.turns.run(async () => {
            const [parts, kept] = await Promise.all([this.parts(image), this.memory.load()]);
            this.begin(parts, kept);
        });
    }

    /** Restarts the robot with this image. Its memories are kept. Rejects if the image cannot be had; the robot then keeps running as
     *  before. */
    async restart(image: ImageName): Promise<void> {
        const mine = ++this.asked;
        this.image = image;
        try {
            await this.turns.run(async () => {
                const parts = await this.parts(image);
                const kept = await this.memories();
                await this.end();
                this.begin(parts, kept);
            });
        } catch (error) {
            if (mine === this.asked) this.image = this.running;
            throw error;
        }
    }

    /** Starts a factory-new robot. Rejects as restart() does. */
    forget(image: ImageName): Promise<void> {
        return this.turns.run(async () => {
            const parts = await this.parts(image);
            await this.end();
            await this.memory.forget();
            this.begin(parts, null);
        });
    }

    private async parts(image: ImageName): Promise<Parts> {
        const [module, images] = await Promise.all([boardModule(), robotImages(image)]);
        return { image, module, images };
    }

    /** The robot's memories for the next one. */
    private async memories(): Promise<KeptRobot | null> {
        const memories = await this.robot?.memories().catch(() => null);
        if (memories) this.events.motions(motionsIn(memories));
        return this.memory.passOn(memories ?? null);
    }

    private begin({ image, module, images }: Parts, kept: KeptRobot | null): void {
        this.running = image;
        const worker = new Worker(new URL('../sim/worker.ts', import.meta.url), { type: 'module' });
        const robot: SimulatedRobot = new SimulatedRobot(worker, { message: message => this.robot === robot && this.take(message) });
        this.robot = robot;
        this.events.motions(kept ? motionsIn(kept) : images.motions);
        this.standing = null;
        this.isInHand = false;
        this.stopped = null;
        if (this.isShown) this.events.change({ stopped: null });
        robot.post({ kind: 'start', module, body: this.body, images, kept });
        for (const message of this.room.values()) robot.post(message);
        if (!this.isShown) robot.post({ kind: 'speed', speed: 0 });
        this.clock = new TickClock();
        this.connection = new Connection(robot.port, this.clock, {
            state: state => this.isShown && this.events.connection(state),
            text: bytes => this.isShown && this.events.text(bytes),
        });
        this.connection.connect();
        void this.addPhysics(robot);
    }

    post(message: ToSim): void {
        if (message.kind === 'floor' || message.kind === 'battery') this.room.set(message.kind, message);
        if (message.kind === 'fault') this.room.set(`${message.servo} ${message.fault}`, message);
        this.robot?.post(message);
    }

    pause(): void {
        this.isShown = false;
        this.post({ kind: 'speed', speed: 0 });
        if (this.connection?.state === 'ready') this.connection.requests.dropAll();
    }

    resume(): void {
        this.isShown = true;
        this.post({ kind: 'speed', speed: 1 });
        this.events.change({ speed: 1, version: this.connection?.version ?? null, where: null, stopped: this.stopped });
        if (this.connection) this.events.connection(this.connection.state);
    }

    /** A hand holds the robot, so motions move it in the air. */
    get isHeld(): boolean {
        return this.isInHand;
    }

    /** Does what a person does before a motion: holds the robot, lets it take its standing pose, lets go. Does nothing if no hand holds the
     *  robot. Rejects with RobotError if the robot refuses (the hand has then let go as well), restarts or crashes. */
    prepare(): Promise<void> {
        if (this.standing) return this.standing;
        if (this.stopped !== null) return Promise.reject(new RobotError('no-answer'));
        const isGone = new Promise<never>((_, reject) => (this.giveUp = reject)); // its time stands still then
        const standing: Promise<void> = Promise.race([this.stand(), isGone]).finally(() => {
            if (this.standing === standing) this.standing = null; // a new robot has its own
        });
        this.standing = standing;
        return standing;
    }

    /** What standing up has interrupted does not go on afterwards. Behind a Stop, neither does what it is about to interrupt; a line that was
     *  typed may just have begun that. */
    dropInterrupted(by: 'stop' | 'line'): void {
        this.interrupted = null;
        if (by === 'stop') this.stops++;
    }

    private async stand(): Promise<void> {
        const { connection, stops } = this;
        const now = await this.nextFrame();
        if (!connection?.version || !now.isHeld) return;
        const { requests } = connection;
        this.interrupted = null;
        try {
            const before = await askWhere(requests, { timeoutMs: WHERE_MS });
            const isToGoOn = before.state !== 'idle' && before.state !== 'paused' && before.page !== STANDING_PAGE;
            if (isToGoOn && stops === this.stops) this.interrupted = before;
            if (before.state !== 'idle') await command(requests, 'break');
            await this.untilIdle(connection);
            await play(requests, STANDING_PAGE);
            await this.untilIdle(connection);
        } finally {
            this.post({ kind: 'hold', held: false });
        }
        for (let frame = 0; frame < MOST_FRAMES && (await this.nextFrame()).isHeld; frame++); // the hand opens
        const { interrupted } = this;
        if (interrupted) await play(requests, interrupted.page, interrupted.code);
    }

    private async untilIdle({ requests }: Connection): Promise<void> {
        const { clock } = this;
        for (const endMs = clock.now() + STAND_LIMIT_MS; clock.now() < endMs; await clock.pass(ASK_MS)) {
            const where = await askWhere(requests, { timeoutMs: WHERE_MS });
            if (where.state === 'idle') return;
        }
    }

    private nextFrame(): Promise<RobotState> {
        return new Promise(resolve => this.waiting.push(resolve));
    }

    private async addPhysics(robot: SimulatedRobot): Promise<void> {
        const giveUp = (): void => this.events.change({ physics: 'off', message: { text: TEXTS.robot.noPhysics, tone: 'bad' } });
        const limit = setTimeout(giveUp, PHYSICS_MS);
        this.physicsCame = () => clearTimeout(limit);
        try {
            const { bodyXml, wasm } = await physics();
            robot.post({ kind: 'physics', bodyXml, wasm }, [wasm]);
        } catch {
            clearTimeout(limit);
            if (this.robot === robot) giveUp();
        }
    }

    private take(message: FromSim): void {
        switch (message.kind) {
            case 'state':
                this.isInHand = message.state.isHeld;
                this.clock.reach(message.state.ticks);
                for (const tell of this.waiting.splice(0)) tell(message.state);
                return this.isShown ? this.events.frame(message.state) : undefined;
            case 'started':
                return this.events.change({ faultNames: message.faults });
            case 'physics':
                this.physicsCame();
                return this.events.change(
                    message.error === null
                        ? { physics: 'on' }
                        : { physics: 'off', message: { text: `${TEXTS.robot.noPhysics} (${message.error})`, tone: 'bad' } },
                );
            case 'writes':
                return this.memory.writes();
            case 'memories':
                this.events.motions(motionsIn(message.memories));
                return void this.memory.written(message.memories);
            case 'violation':
                return this.stop(TEXTS.robot.violation(message.violation, message.text));
            case 'crashed':
                return this.stop(TEXTS.robot.crashed);
            case 'bytes':
                return; // handled by the port
            default:
                message satisfies never;
        }
    }

    private stop(why: string): void {
        this.stopped = why;
        this.giveUp(new RobotError('no-answer'));
        if (this.isShown) this.events.change({ stopped: why, doing: { text: why, tone: 'bad' } });
        void this.connection?.close(); // its time stands still, so no question would end
    }

    private async end(): Promise<void> {
        const robot = this.robot;
        this.robot = null;
        this.waiting.length = 0;
        this.physicsCame();
        this.giveUp(new RobotError('cancelled'));
        await this.connection?.close();
        this.connection = null;
        robot?.dispose();
        this.events.change({ physics: 'loading' });
        if (this.isShown) this.events.change({ speed: 1, version: null, where: null, message: null });
    }
}
