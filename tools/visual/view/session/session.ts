// SPDX-License-Identifier: MIT
// Interface of the views to the robot in use. main.ts connects it to the simulated robot or a port; no view touches a stream or a worker.

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

/** A message in the status bar. */
export interface Notice {
    readonly text: string;
    readonly tone: 'calm' | 'good' | 'bad';
}

/** In characters. */
export interface TerminalSize {
    readonly rows: number;
    readonly columns: number;
}

export interface SessionState {
    readonly source: Source;
    readonly connection: ConnectionState;
    /** While it waits: another program has the port, so the cable is not the reason. */
    readonly isPortBusy?: boolean;
    readonly portName: string;
    readonly version: Version | null;
    readonly where: Where | null;
    readonly pages: readonly PageEntry[];
    /** Image of the simulated robot. */
    readonly image: ImageName;
    readonly physics: 'loading' | 'on' | 'off';
    readonly speed: number;
    /** Why the simulated robot has stopped for good; null: it has not. */
    readonly stopped: string | null;
    /** What the robot does. */
    readonly doing: Notice;
    /** The last error or message; null: none. */
    readonly message: Notice | null;
    readonly faultNames: readonly string[];
    readonly tab: Tab;
    /** A newer version of this web page waits for takeNewVersion(). */
    readonly hasNewVersion: boolean;
    /** Motion page that is only previewed in the picture; null: none. */
    readonly shownPage: number | null;
    /** Its name in the document, which the robot may not have yet. */
    readonly shownName?: string;
    readonly isPowered: boolean;
    /** Adapter of My servos. out: unplugged; back: plugged in again, and nothing has played since. */
    readonly adapter?: 'out' | 'back' | null;
    /** The simulated robot has not answered for longer than a start takes. */
    readonly isLate: boolean;
    /** Another tab keeps its robot, so what the robot in this page saves is lost with the tab. */
    readonly isSecond: boolean;
    /** The robot in the page has saved something that the browser does not have. */
    readonly hasUnkept: boolean;
    /** My servos have, chosen or not. */
    readonly hasUnkeptServos: boolean;
    /** Edit of the robot in the page or of My servos has edits that are not saved. It counts as having some between a key and its answer. */
    readonly hasEdits: boolean;
}

/** A hand at a point of a link (metres, in the link's frame) that pulls towards a target in the room. */
export interface Hand {
    readonly link: string;
    readonly point: Vector;
    readonly target: Vector;
}

/** Runs in parallel to a play, in servo units. layer: a second page on joints of its own (page null: end it; no joints: those of its first
 *  step). The others: joints moved by code. */
export type Overlay =
    | { readonly kind: 'layer'; readonly page: number | null; readonly joints: readonly number[] }
    | { readonly kind: 'aim'; readonly joint: number; readonly position: number; readonly degreesPerSecond: number }
    | { readonly kind: 'swing'; readonly joint: number; readonly centre: number; readonly amplitude: number; readonly periodMs: number }
    /** Empty joints: all. */
    | { readonly kind: 'free'; readonly joints: readonly number[] };

export interface Floor {
    readonly tiltFront: number;
    readonly tiltLeft: number;
    readonly friction: number;
}

/** Controls of the simulation. They have no effect on a real robot. */
export interface SimControls {
    /** Factor for the robot's time; 0: paused. */
    setSpeed(speed: number): void;
    oneTick(): void;
    setPower(on: boolean): void;
    press(button: PanelButton, down: boolean): void;
    setBattery(volts: number): void;
    setFault(servo: number, fault: number, on: boolean): void;
    /** null: lets go. ticks of robot time: lets go by itself afterwards; absent: at the next pull. */
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
    /** Text of the board for a terminal. */
    onText(listener: (bytes: Uint8Array) => void): () => void;
    /** A person stops the robot, or moves it by its remote, its panel or a typed line: what would go on by itself must be dropped. */
    onStop(listener: () => void): () => void;

    show(tab: Tab): void;
    /** Reports the size of the terminal. */
    terminalSize(size: TerminalSize): void;
    /** false: the robot does not play it, which has been reported. */
    play(page: number): Promise<boolean>;
    command(command: Command): Promise<void>;
    /** Default: all servos. false: the robot refused or did not answer, which has been reported. */
    setTorque(on: boolean, servos?: readonly number[]): Promise<boolean>;
    /** Plays a page of the document. First writes it and the pages it leads to, where the robot's differ. The picture previews it
     *  meanwhile. */
    playEdited(page: number): Promise<void>;
    /** Previews a page of the document in a loop until the robot is ready to play it. */
    run(page: number): Promise<void>;
    /** Changes the shape of the current play, from its next step on. Only for Play. Refusals have been reported when it resolves. */
    shape(change: Partial<Shape>): Promise<void>;
    /** Starts, changes or ends what runs in parallel to a play. Only for Play. */
    overlay(what: Overlay): Promise<void>;
    /** Makes the robot move slowly to this pose and keep following (servo units by ID; null: this joint stays). null: ends it.
     *  ended: called when it ends otherwise: by what is done with the robot, the page or a document, or by an error, which has been
     *  reported. */
    follow(positions: readonly (number | null)[] | null, ended?: () => void): void;
    /** Shows a message in the status bar. null: the last input was taken, and what was said of one that was not is over. */
    say(notice: Notice | null): void;
    remote(held: ReadonlySet<RemoteButton>): void;
    /** Walks by stick: x to the right, y ahead, -1..1; null: released. The farther the stick, the larger the steps. */
    drive(stick: { readonly x: number; readonly y: number } | null): void;
    type(bytes: Uint8Array): void;

    /** Reloads the web page in its newest version. */
    takeNewVersion(): void;
    /** Calls `reload`, which reloads the page. The robot in the page restarts then. false: it has edits in Edit that would be lost, which has
     *  been reported. */
    reload(reload: () => void): Promise<boolean>;
    useSimulated(): void;
    /** Opens the browser's port chooser; call it in a click handler. */
    connectYours(): Promise<void>;

    /** Runs Play in this page, with servos on an adapter. Opens the browser's port chooser; call it in a click handler. */
    connectServos(): Promise<void>;

    /** Restarts the simulated robot with that image; motions and settings stay. */
    runImage(image: ImageName): void;
    /** Resets the simulated robot's flash and EEPROM to factory state. */
    forget(): Promise<void>;
}
