// SPDX-License-Identifier: MIT
// Drives the robot with the keys of a remote or a stick. Only Play can be driven, and only a robot on its feet. A key pressed earlier is
// kept and sent when the robot is ready.

import type { Connection } from '../robot/connection.ts';
import { remotePacket } from '../robot/remote.ts';
import type { RemoteButton } from '../robot/remote.ts';
import type { SessionState } from '../view/session/session.ts';
import type { Store } from '../view/store.ts';
import { TEXTS } from '../view/texts/texts.ts';
import { REPEAT_MS, RemoteKeys } from './remote-keys.ts';
import type { SimulatedSource } from './simulated-source.ts';
import { StickDrive } from './stick.ts';
import type { Stick } from './stick.ts';
import type { StatusMessages } from './status-messages.ts';

const STOP: RemoteButton = 'b6';
const NONE: ReadonlySet<RemoteButton> = new Set();

export interface DrivingParts {
    readonly state: Store<SessionState>;
    readonly messages: StatusMessages;
    readonly simulated: Pick<SimulatedSource, 'post' | 'isHeld'>;
    /** Throws RobotError not-connected if there is none. */
    connection(): Connection;
    /** Resolves when the robot in the page runs Play and is on its feet. Rejects with RobotError. */
    becomeDriven(): Promise<void>;
}

export class Driving {
    private readonly parts: DrivingParts;
    private readonly keys = new RemoteKeys(held => this.send(held));
    private readonly stick: StickDrive;
    /** The keys pressed last while the robot could not receive them. */
    private wish: ReadonlySet<RemoteButton> | null = null;
    /** Who waits until the robot in use can be driven; null: nobody. */
    private becoming: symbol | null = null;
    private isPushed = false;
    private ranPlay = false;
    /** A key was sent, and no release since. */
    private isDown = false;

    constructor(parts: DrivingParts) {
        this.parts = parts;
        this.stick = new StickDrive(parts.connection, () => this.walkPage(), parts.messages.fail);
        parts.state.watch(() => this.release());
    }

    remote(held: ReadonlySet<RemoteButton>): void {
        if ([...held].some(button => button !== STOP)) this.prepare(held); // Stop needs no robot that can be driven
        this.keys.hold(held);
    }

    get isWaiting(): boolean {
        return this.wish !== null;
    }

    /** Drops a key press that still waits for the robot, and stops a walk by the stick. isStopped: the robot is told to stop anyway. */
    forget(isStopped = false): void {
        this.wish = null;
        this.stick.stop(isStopped);
    }

    /** As if the person had let go of all keys and of the stick. */
    letGo(): void {
        this.forget();
        if (this.keys.isHeld) this.keys.hold(NONE);
    }

    /** Another robot is used from now on. It does not wait for the one before. */
    leave(): void {
        this.becoming = null;
        this.letGo();
    }

    drive(stick: Stick | null): void {
        if (stick && !this.isPushed) {
            this.prepare(NONE); // a stick that is still pushed then drives by itself
            if (this.hasNoWalk) this.parts.messages.complain(TEXTS.robot.noWalk, 'robot');
        }
        this.isPushed = stick !== null;
        this.stick.set(stick);
    }

    /** Makes the robot one that can be driven, or says why it cannot. held: the keys to send then. */
    private prepare(held: ReadonlySet<RemoteButton>): void {
        if (this.isOff) this.parts.messages.complain(TEXTS.status.isOff, 'robot');
        else if (this.isYoursWithEdit) this.parts.messages.complain(TEXTS.robot.editNoRemote(this.state.version?.board ?? ''), 'robot');
        else if (this.state.source !== 'yours' && !this.hears) this.keep(held);
    }

    /** Of a robot whose program this page has chosen: Play answers. */
    private get runsPlay(): boolean {
        const { source, connection, image, version } = this.state;
        return source !== 'yours' && image === 'play' && connection === 'ready' && version?.image === 'play';
    }

    /** The robot runs Play and is on its feet. */
    private get hears(): boolean {
        return this.runsPlay && !(this.isSimulated && this.parts.simulated.isHeld);
    }

    /** When Play starts, every button counts as down (firmware/common/REMOTE.md), and a press would be ignored for half a second. */
    private release(): void {
        const { runsPlay } = this;
        if (runsPlay && !this.ranPlay) this.pass(NONE);
        this.ranPlay = runsPlay;
    }

    private keep(held: ReadonlySet<RemoteButton>): void {
        this.wish = new Set(held);
        if (this.becoming) return;
        const mine = Symbol('becoming');
        this.becoming = mine;
        const end = (action: () => void): void => {
            if (mine !== this.becoming) return;
            this.becoming = null;
            action();
        };
        this.parts.becomeDriven().then(
            () => end(() => this.carryOut()),
            (error: unknown) => end(() => this.refuse(error)),
        );
    }

    private refuse(error: unknown): void {
        if (!this.wish) return; // nobody waits for it any more
        this.wish = null;
        this.parts.messages.fail(error);
    }

    /** A key that is still held is sent again anyway. */
    private carryOut(): void {
        const { wish } = this;
        this.wish = null;
        if (!wish || this.keys.isHeld) return;
        this.send(wish);
        setTimeout(() => !this.keys.isHeld && this.send(NONE), REPEAT_MS);
    }

    /** The robot could walk, and its pages are known: it answers questions behind the one for its pages. */
    private get hasNoWalk(): boolean {
        const { source, version, where, pages } = this.state;
        const mayWalk = source === 'yours' ? version?.image === 'play' : this.hears && !this.isOff;
        return mayWalk && where !== null && !pages.some(({ name }) => name === 'walk');
    }

    private walkPage(): number | null {
        const { source, version, pages } = this.state;
        if (this.isOff || (source !== 'yours' && !this.hears)) return null;
        return version?.image === 'play' ? (pages.find(page => page.name === 'walk')?.page ?? null) : null;
    }

    /** Edit and a boot loader would take a packet for typed letters, and who knows what another board would do. A robot that a hand holds hears
     *  only what moves nothing. */
    private send(held: ReadonlySet<RemoteButton>): void {
        const movesNothing = held.has(STOP) || (held.size === 0 && this.isDown);
        const hears = movesNothing ? this.runsPlay : this.hears;
        if (this.state.source === 'yours' ? this.state.version?.image === 'play' : hears) this.pass(held);
    }

    private pass(held: ReadonlySet<RemoteButton>): void {
        this.isDown = held.size > 0;
        const { messages, simulated } = this.parts;
        if (this.isSimulated) simulated.post({ kind: 'bytes', sender: 'remote', bytes: remotePacket(held) });
        else void this.write(held).catch(messages.fail);
    }

    private async write(held: ReadonlySet<RemoteButton>): Promise<void> {
        await this.parts.connection().requests.packet(remotePacket(held), { moves: held.size > 0 });
    }

    private get isYoursWithEdit(): boolean {
        return this.state.source === 'yours' && this.state.version?.image === 'edit';
    }

    private get isOff(): boolean {
        return this.isSimulated && !this.state.isPowered;
    }

    private get isSimulated(): boolean {
        return this.state.source === 'simulated';
    }

    private get state(): SessionState {
        return this.parts.state.get();
    }
}
