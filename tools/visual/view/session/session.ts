// SPDX-License-Identifier: MIT
// The robot in use as the views see it: what they may know, and what they may ask for. main.ts puts the simulated
// robot or a port behind it; no view ever touches a stream or a worker.

import type { Body } from '../../model/body.ts';
import type { Shape } from '../../model/motion.ts';
import type { Vector } from '../../model/space.ts';
import type { ConnectionState } from '../../robot/connection-table.ts';
import type { Command, PageEntry, Version, Where } from '../../robot/protocol.ts';
import type { RemoteButton } from '../../robot/remote.ts';
import type { RobotState } from '../../robot/robot-state.ts';
import type { Documents } from './documents.ts';
import type { Editor } from './editor.ts';
import type { Files } from './files.ts';
import type { Preview } from './preview.ts';
import type { Store } from '../store.ts';
import type { Transfer } from './transfer.ts';
import type { Trials } from './trials.ts';

export type Source = 'simulated' | 'yours' | 'servos';
export type ImageName = 'play' | 'edit';
export type PanelButton = 'up' | 'down' | 'left' | 'right' | 'start' | 'mode';
export type Tab = 'remote' | 'steps' | 'curves' | 'pages' | 'links' | 'checks' | 'terminal' | 'robot';

/** What is said in the messages. `board`: in the words that the board used. */
export interface Notice {
    readonly text: string;
    readonly tone: 'calm' | 'good' | 'bad';
}

/** In letters. */
export interface TerminalSize {
    readonly rows: number;
    readonly columns: number;
}

export interface SessionState {
    readonly source: Source;
    readonly connection: ConnectionState;
    readonly portName: string;
    readonly version: Version | null;
    readonly where: Where | null;
    readonly pages: readonly PageEntry[];
    /** Image that the simulated robot runs. */
    readonly image: ImageName;
    readonly physics: 'loading' | 'on' | 'off';
    readonly speed: number;
    /** The robot in the page has stopped for good; this says why. */
    readonly stopped: string | null;
    /** What the robot does. */
    readonly doing: Notice;
    /** What went wrong last, or was said last; null: nothing. */
    readonly message: Notice | null;
    readonly faultNames: readonly string[];
    readonly tab: Tab;
    /** A newer version of this page waits for takeNewVersion(). */
    readonly hasNewVersion: boolean;
    /** A page that the picture shows while no robot plays it; null: none. */
    readonly shownPage: number | null;
    /** Its name in the document; the robot may know none yet. */
    readonly shownName?: string;
    readonly isPowered: boolean;
    /** The adapter of My servos was pulled out; it is back, and nothing has played since. */
    readonly adapter?: 'out' | 'back' | null;
    /** The robot in the page has not answered for longer than a start takes. */
    readonly isLate: boolean;
}

/** A hand at a point of a link (metres, in the link's frame), pulling towards a place in the room. */
export interface Hand {
    readonly link: string;
    readonly point: Vector;
    readonly target: Vector;
}

/** What goes on beside a play: a second page on joints of its own (null: no more; no joints: those that its first step uses), or
 *  joints that code moves. Servo units. */
export type Overlay =
    | { readonly kind: 'layer'; readonly page: number | null; readonly joints: readonly number[] }
    | { readonly kind: 'aim'; readonly joint: number; readonly position: number; readonly degreesPerSecond: number }
    | { readonly kind: 'swing'; readonly joint: number; readonly centre: number; readonly amplitude: number; readonly periodMs: number }
    /** No joints: all. */
    | { readonly kind: 'free'; readonly joints: readonly number[] };

export interface Floor {
    readonly tiltFront: number;
    readonly tiltLeft: number;
    readonly friction: number;
}

/** What a person can do to the robot in the page besides talking to it. To yours it does nothing. */
export interface SimControls {
    /** Times the robot's own; 0: it waits. */
    setSpeed(speed: number): void;
    oneTick(): void;
    setPower(on: boolean): void;
    press(button: PanelButton, down: boolean): void;
    setBattery(volts: number): void;
    setFault(servo: number, fault: number, on: boolean): void;
    /** ticks: lets go by itself after so many of the robot's time; without it, at the next pull. */
    pull(hand: Hand | null, ticks?: number): void;
    hold(held: boolean): void;
    setFloor(floor: Floor): void;
}

export interface Session {
    readonly body: Body;
    readonly state: Store<SessionState>;
    readonly editor: Editor;
    readonly files: Files;
    readonly documents: Documents;
    readonly transfer: Transfer;
    readonly trials: Trials;
    readonly preview: Preview;
    readonly sim: SimControls;
    /** Up to 60 times a second. */
    onFrame(listener: (state: RobotState) => void): () => void;
    /** What the board says to a terminal. */
    onText(listener: (bytes: Uint8Array) => void): () => void;
    /** Somebody wants the robot to stop: what waits for it is dropped. */
    onStop(listener: () => void): () => void;

    show(tab: Tab): void;
    /** The terminal shows so many letters. */
    terminalSize(size: TerminalSize): void;
    play(page: number): Promise<void>;
    command(command: Command): Promise<void>;
    /** Without servos: of all. */
    setTorque(on: boolean, servos?: readonly number[]): Promise<void>;
    /** Plays a page of the document: writes it and what it leads to first, as far as the robot has it otherwise. The picture shows it at once. */
    playEdited(page: number): Promise<void>;
    /** Shows a page of the document again and again, until the robot does it: as soon as it can. */
    run(page: number): Promise<void>;
    /** How what plays is shaped, from its next step on. Only Play can. */
    shape(shape: Shape): Promise<void>;
    /** What goes on beside a play. Only Play can. */
    overlay(what: Overlay): Promise<void>;
    /** From now on the robot goes slowly to this pose (servo units by ID; null: this joint stays); null: no more. */
    follow(positions: readonly (number | null)[] | null): void;
    /** Says something in the messages. */
    say(notice: Notice): void;
    remote(held: ReadonlySet<RemoteButton>): void;
    /** A stick: x to the right, y ahead, -1..1; null: let go. It walks, the farther the stick the larger the steps. */
    drive(stick: { readonly x: number; readonly y: number } | null): void;
    type(bytes: Uint8Array): void;

    /** Reloads the page as its newest version. */
    takeNewVersion(): void;
    useSimulated(): void;
    /** Opens the browser's chooser; call it in a click. */
    connectYours(): Promise<void>;

    /** Play runs in this page, at servos on an adapter. Opens the browser's chooser; call it in a click. */
    connectServos(): Promise<void>;

    /** Starts the robot in the page anew with that image; motions and settings stay. */
    runImage(image: ImageName): void;
    /** Forgets flash and EEPROM of the robot in the page: a robot fresh from the factory. */
    forget(): Promise<void>;
}
