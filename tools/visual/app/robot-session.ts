// SPDX-License-Identifier: MIT
// The session joins the simulated robot or a port with the protocol and the views. It is the only place that knows all of them.

import type { FormatsWorker } from '../model/file-formats.ts';
import type { Body } from '../model/body.ts';
import { documentFrom } from '../model/document.ts';
import { dirtyPages } from '../model/editor-state.ts';
import type { Shape } from '../model/motion.ts';
import type { Connection } from '../robot/connection.ts';
import { command, setTorque } from '../robot/protocol.ts';
import type { Command } from '../robot/protocol.ts';
import type { RemoteButton } from '../robot/remote.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { RobotState } from '../robot/robot-state.ts';
import type { Overlay, Session, SessionState, ImageName, Notice, Tab, TerminalSize } from '../view/session/session.ts';
import { isEditing } from '../view/editor/editing.ts';
import { refusalText } from '../view/texts/editor.ts';
import { ROBOT_IN_PAGE } from '../view/document-storage.ts';
import { Store } from '../view/store.ts';
import { DocumentEditor } from './editor.ts';
import type { EditorParts } from './editor.ts';
import { TEXTS } from '../view/texts/texts.ts';
import { Arrival } from './arrival.ts';
import { onChange, watchCauses } from './causes.ts';
import { makeDocuments, makeTransfer } from './document-parts.ts';
import type { ChosenStorage } from './document-parts.ts';
import type { KeptDocuments } from './documents.ts';
import { Driving } from './driving.ts';
import { DocumentFiles } from './files.ts';
import { Follow } from './follow.ts';
import { imageError } from './image-error.ts';
import { SimulatorControls } from './simulator-controls.ts';
import { Listeners } from './listeners.ts';
import { Status } from './status.ts';
import type { Stick } from './stick.ts';
import type { RobotTransfer } from './transfer.ts';
import { trialClient } from './assets.ts';
import { MotionTrials } from './trials.ts';
import { PageVersion } from './page-version.ts';
import { MotionPreview } from './preview.ts';
import type { MemoryEvents } from './robot-memory.ts';
import { RobotImages } from './robot-images.ts';
import { RobotPlays } from './robot-plays.ts';
import type { SourceEvents } from './simulated-source.ts';
import { RobotSources } from './sources.ts';
import { StatusMessages } from './status-messages.ts';
import { until } from './until.ts';

/** A robot that already has the motion plays it within this time, so no preview is needed. */
const SHOWN_MS = 160;
/** States of a connection before its first answer. */
const SEARCHES: ReadonlySet<SessionState['connection']> = new Set(['opening', 'asking', 'silent']);
/** The longest search: all IDs over a slow adapter. A play that comes later than that would surprise. */
const SEARCH_MS = 30_000;
/** Empties a terminal. */
const NEW_SCREEN = new TextEncoder().encode('\x1bc');
/** Eleven seconds of a line of 57,600 baud. What is longer was not meant for the terminal, and nothing else would be heard meanwhile. */
const MOST_TYPED = 65_536;
/** Typed bytes that a robot acts upon: the ends of a line, and Ctrl-C and the space bar, which break a play in Edit. What a terminal answers
 *  by itself has none of them. */
const ACTED_UPON: ReadonlySet<number> = new Set(['\r', '\n', '\x03', ' '].map(key => key.charCodeAt(0)));

const startState = (): SessionState => ({
    source: 'simulated',
    connection: 'closed',
    portName: '',
    version: null,
    where: null,
    pages: [],
    image: 'play',
    physics: 'loading',
    speed: 1,
    stopped: null,
    doing: { text: TEXTS.status.starting, tone: 'calm' },
    message: null,
    faultNames: [],
    tab: 'remote',
    hasNewVersion: false,
    shownPage: null,
    isPowered: true,
    isLate: false,
    isSecond: false,
    hasUnkept: false,
    hasUnkeptServos: false,
    hasEdits: false,
});

export class RobotSession implements Session {
    readonly body: Body;
    readonly state = new Store<SessionState>(startState());
    readonly editor: DocumentEditor;
    readonly files: DocumentFiles;
    readonly documents: KeptDocuments;
    readonly transfer: RobotTransfer;
    readonly trials: MotionTrials;
    readonly preview: MotionPreview;
    readonly sim: SimulatorControls;
    readonly version = new PageVersion(this.state);
    private readonly frames = new Listeners<RobotState>();
    private readonly texts = new Listeners<Uint8Array>();
    private readonly stops = new Listeners<void>();
    private lastFrame: RobotState | null = null;
    /** Buttons that were down together with button 6. They count again when they were let go. */
    private heldWithStop: ReadonlySet<RemoteButton> = new Set();
    /** Shows the asked motion if the robot has not begun in time. */
    private late: ReturnType<typeof setTimeout> | undefined;
    /** Counts run() and Stop. A motion that waits for the robot does not begin behind either. */
    private runs = 0;
    /** A run() waits for the robot. */
    private isRunWaiting = false;
    private readonly messages = new StatusMessages(this.state);
    private readonly sources: RobotSources;
    private readonly arrival: Arrival;
    private readonly driving: Driving;
    private readonly images: RobotImages;
    private readonly plays: RobotPlays;
    private readonly status: Status = new Status({
        state: this.state,
        connection: () => this.connection,
        isWriting: () => this.transfer.isWriting,
    });
    private readonly follower = new Follow(() => this.connection, this.messages.fail);

    constructor(body: Body, parts: EditorParts, formats: FormatsWorker, storage: ChosenStorage) {
        this.body = body;
        this.editor = new DocumentEditor(body, parts, {
            changed: () => this.documents.keep(),
            opened: () => {
                this.trials.forget();
                this.follower.end();
            },
            refused: refusal => this.messages.complain(refusalText(refusal), 'edit'),
        });
        this.files = new DocumentFiles(this.editor, formats, {
            cancel: () => formats.cancel(),
            create: (name, document) => this.documents.create(name, document),
        });
        this.preview = new MotionPreview({
            body,
            editor: this.editor,
            state: this.state,
            trunk: () => this.lastFrame?.trunk ?? null,
            isFollowing: () => this.follower.isOn,
            isStoodUp: () => this.isSimulated && this.sources.simulated.isHeld,
            pageChanged: () => this.status.tell(),
            nextFrame: call => void requestAnimationFrame(call),
        });
        this.trials = new MotionTrials(this.editor, () => trialClient(body));
        this.documents = makeDocuments(this.editor, storage, {
            failed: () => this.messages.complain(TEXTS.document.couldNotSave, 'storage'),
            copied: name => this.messages.keep({ text: TEXTS.document.secondTab(name), tone: 'calm' }),
            gone: name => this.messages.complain(TEXTS.document.gone(name), 'edit'),
        });
        this.transfer = makeTransfer(this.editor, this.documents, {
            name: () => (this.isSimulated ? ROBOT_IN_PAGE : this.state.get().portName),
            requests: () => this.connection.requests,
            becomeEdit: () => (this.state.get().source === 'yours' ? this.needEdit() : this.images.becomeEdit()),
        });
        this.sources = new RobotSources(body, {
            state: this.state,
            editor: this.editor,
            events: this.events(),
            mayAsk: () => this.status.mayAsk(),
            left: () => this.leaveRobot(),
            dropHidden: () => {
                const { isWaiting } = this;
                this.dropWaiting();
                return isWaiting;
            },
            fail: this.messages.fail,
        });
        const { simulated } = this.sources;
        this.arrival = new Arrival({
            state: this.state,
            messages: this.messages,
            status: this.status,
            sources: this.sources,
            editor: this.editor,
            transfer: this.transfer,
        });
        this.sim = new SimulatorControls(this.state, simulated, {
            restarts: () => this.dropForRestart(),
            pressed: button => this.dropWaiting(button === 'start'),
        });
        this.plays = new RobotPlays({
            state: this.state,
            editor: this.editor,
            transfer: this.transfer,
            connection: () => this.connection,
            untilFound: () => this.untilFound(),
            prepare: async () => (this.isSimulated ? simulated.prepare() : undefined),
        });
        this.images = new RobotImages({
            state: this.state,
            format: parts.format,
            robot: () => this.sources.withImages,
            isWriting: () => this.transfer.isWriting,
            isHalfSent: requests => this.transfer.isHalfSent(requests),
            say: message => this.say(message),
            fail: this.messages.fail,
        });
        this.driving = new Driving({
            state: this.state,
            messages: this.messages,
            simulated,
            connection: () => this.connection,
            becomeDriven: () => this.images.becomeDriven(),
        });
        // A hidden page hears of no key and no gamepad, not even that they were let go.
        document.addEventListener('visibilitychange', () => document.hidden && this.driving.letGo());
        // The robot's pages were written: by the page, or by Edit in the robot in the page.
        const askPages = (): unknown => this.status.mayAsk() && this.arrival.askPages();
        onChange(
            this.transfer.state,
            ({ phase }) => phase,
            phase => (phase === 'written' || phase === 'stopped') && askPages(),
        );
        onChange(
            this.editor.state,
            ({ robot }) => robot,
            () => this.isSimulated && askPages(),
        );
        watchCauses({ messages: this.messages, robot: this.state, editor: this.editor.state, documents: this.documents.state });
    }

    private events(): Omit<SourceEvents, 'motions'> & MemoryEvents {
        return {
            frame: state => {
                this.lastFrame = state;
                this.status.reach(state.ticks);
                if (state.isPowered !== this.state.get().isPowered) this.powerChanged(state.isPowered);
                this.frames.tell(state);
            },
            text: bytes => {
                this.texts.tell(bytes);
                this.status.hear(bytes);
                this.messages.hear(bytes);
                this.follower.hear(bytes);
            },
            connection: state => {
                this.arrival.connectionChanged(state);
                if (state !== 'ready') return;
                this.images.look();
                if (!this.isSimulated && this.heldWithStop.has('b6')) void this.command('stop'); // pressed while the cable was out
            },
            change: change => {
                this.state.set(change.message === null ? { ...change, message: this.messages.unread } : change);
                if (change.physics === 'on') this.arrival.standUp();
            },
            backUp: image => this.documents.backUp(ROBOT_IN_PAGE, documentFrom(image, '').pages),
        };
    }

    /** What a robot has said that is off now is not true any more. */
    private powerChanged(isPowered: boolean): void {
        const known = isPowered ? {} : { where: null, version: null, message: this.messages.unread };
        this.status.tell({ isPowered, ...known });
    }

    start(): Promise<void> {
        return this.sources.simulated.start(this.state.get().image);
    }

    private async needEdit(): Promise<void> {
        const { connection, version } = this.state.get();
        if (connection !== 'ready') throw this.connection.error ?? new RobotError('no-answer');
        if (!version?.can.has('save')) throw new RobotError('needs-edit', version?.board);
    }

    onFrame(listener: (state: RobotState) => void): () => void {
        return this.frames.add(listener);
    }

    onText(listener: (bytes: Uint8Array) => void): () => void {
        return this.texts.add(listener);
    }

    onStop(listener: () => void): () => void {
        return this.stops.add(listener);
    }

    show(tab: Tab): void {
        if (!isEditing(tab)) this.follower.end();
        this.state.set({ tab });
        this.status.look();
    }

    terminalSize(size: TerminalSize): void {
        this.status.terminalSize(size);
    }

    play(page: number): Promise<boolean> {
        this.follower.end();
        return this.act(() => this.plays.play(page));
    }

    async playEdited(page: number): Promise<void> {
        this.follower.end();
        const { format, state } = this.editor;
        const dirty = dirtyPages(state.get(), format);
        const isToWrite = format.reach(state.get().document, page).some(one => dirty.has(one));
        clearTimeout(this.late);
        this.late = setTimeout(() => this.preview.playAsked(page), isToWrite ? 0 : SHOWN_MS);
        await this.act(async () => {
            if (!(await this.plays.playEdited(page))) return false;
            clearTimeout(this.late);
            this.preview.showRobot();
            return true;
        });
    }

    async run(page: number): Promise<void> {
        const { preview } = this;
        const mine = ++this.runs;
        preview.setLooping(true);
        preview.start(page);
        this.isRunWaiting = true;
        await this.untilReady();
        if (mine === this.runs) this.isRunWaiting = false;
        const { isRunning, page: shown } = preview.state.get();
        const isWanted = mine === this.runs && isRunning && shown === page; // otherwise the person has chosen something else
        if (isWanted && this.state.get().stopped === null) await this.playEdited(page);
        preview.setLooping(false);
    }

    /** Or until it is clear that it will not be: it is off or has crashed. */
    private untilReady(): Promise<void> {
        return until(this.state, ({ connection, physics, stopped, isPowered }) => {
            const isReady = connection === 'ready' && physics !== 'loading';
            return isReady || stopped !== null || !isPowered;
        });
    }

    async shape(change: Partial<Shape>): Promise<void> {
        await this.act(() => this.plays.shape(change));
    }

    async overlay(what: Overlay): Promise<void> {
        await this.act(() => this.plays.overlay(what));
    }

    async command(what: Command): Promise<void> {
        const stops = what === 'stop' || what === 'break';
        if (stops) this.dropWaiting(true);
        const { isPowered, connection } = this.state.get();
        const isStarting = this.isSimulated && isPowered && connection !== 'ready';
        await this.act(async () => {
            try {
                await command(this.connection.requests, what);
            } catch (error) {
                if (!stops || !isStarting) throw error; // one that starts does not answer yet, and nothing moves
            }
        });
    }

    async setTorque(on: boolean, servos: readonly number[] = []): Promise<boolean> {
        if (!on && servos.length === 0) this.dropWaiting();
        const isDone = await this.act(() => setTorque(this.connection.requests, on, servos));
        if (isDone && on && this.state.get().adapter === 'back') this.status.tell({ adapter: null }); // which says to switch it on
        return isDone;
    }

    follow(positions: readonly (number | null)[] | null, ended?: () => void): void {
        this.follower.set(positions, ended);
    }

    say(message: Notice | null): void {
        if (message === null) this.messages.over('edit');
        else if (message.tone === 'bad') this.messages.complain(message.text, 'edit');
        else this.messages.say(message);
    }

    /** A packet of the remote may be lost on a line, Edit ignores it, and an unknown board gets none: there button 6 is a request. */
    remote(held: ReadonlySet<RemoteButton>): void {
        const stops = held.has('b6');
        const isPressed = stops && !this.heldWithStop.has('b6');
        this.heldWithStop = new Set([...held].filter(button => stops || this.heldWithStop.has(button)));
        const { connection, version } = this.state.get();
        const hears = this.isSimulated && connection === 'ready' && version?.image === 'play';
        if (isPressed && hears) this.dropWaiting(true);
        else if (isPressed) void this.command('stop');
        else if (held.size > 0) this.stops.tell();
        this.driving.remote(hears ? held : new Set([...held].filter(button => !this.heldWithStop.has(button))));
    }

    drive(stick: Stick | null): void {
        this.driving.drive(stick);
    }

    type(bytes: Uint8Array): void {
        if (bytes.length > MOST_TYPED) return this.messages.complain(TEXTS.terminal.tooLong, 'robot');
        this.status.typed();
        this.images.typed();
        if (bytes.some(byte => ACTED_UPON.has(byte))) this.dropMoves('line');
        void this.write(bytes).catch(this.messages.fail);
    }

    private async write(bytes: Uint8Array): Promise<void> {
        await this.connection.write(bytes);
    }

    takeNewVersion(): void {
        void this.reload(() => this.version.take());
    }

    async reload(reload: () => void): Promise<boolean> {
        try {
            await this.images.mustHaveNoEdits();
        } catch (error) {
            this.messages.fail(error);
            return false;
        }
        this.state.set({ hasEdits: false }); // asked a moment ago, or Edit hangs
        reload();
        return true;
    }

    /** Something is lost when the page is left: documents, what a robot of this page has saved, or edits in its Edit. */
    get losesWork(): boolean {
        const { hasUnkept, hasUnkeptServos, hasEdits } = this.state.get();
        return this.documents.state.get().saving === 'off' || hasUnkept || hasUnkeptServos || hasEdits;
    }

    useSimulated(): void {
        void this.changeRobot(() => this.sources.useSimulated());
    }

    connectYours(): Promise<void> {
        return this.changeRobot(() => this.sources.connectYours());
    }

    connectServos(): Promise<void> {
        return this.changeRobot(() => this.sources.connectServos());
    }

    /** The program of my servos ends with the change. Never rejects. */
    private async changeRobot(change: () => void | Promise<void>): Promise<void> {
        try {
            if (this.state.get().source === 'servos') await this.images.mustHaveNoEdits();
        } catch (error) {
            return this.messages.fail(error);
        }
        await change();
    }

    runImage(image: ImageName): void {
        this.dropForRestart();
        this.images.run(image);
    }

    /** My servos may have become the robot in use while the question stood. They forget nothing. */
    async forget(): Promise<void> {
        if (!this.isSimulated) return this.messages.complain(TEXTS.robotPane.onlyInPage, 'robot');
        this.dropForRestart();
        const { simulated } = this.sources;
        await simulated.forget(simulated.image).catch((cause: unknown) => this.messages.fail(imageError(cause)));
    }

    /** isStopped: a stop goes to the robot. */
    private dropWaiting(isStopped = false): void {
        this.preview.pause();
        this.sources.dropText();
        this.dropMoves('stop', isStopped);
    }

    /** A person stops the robot or takes it over, so the page moves it no more with what was asked before. */
    private dropMoves(by: 'stop' | 'line', isStopped = false): void {
        clearTimeout(this.late);
        this.runs++;
        this.isRunWaiting = false;
        this.plays.cancel();
        this.sources.simulated.dropInterrupted(by);
        this.driving.forget(isStopped);
        this.stops.tell();
    }

    /** Something waits for the robot that rejects nothing when it is dropped. */
    private get isWaiting(): boolean {
        return this.driving.isWaiting || this.follower.isOn || this.isRunWaiting;
    }

    /** The robot is switched off, reset, restarted or told to forget. What still waits for it must not move or change it afterwards. */
    private dropForRestart(): void {
        const dropped = new RobotError('dropped');
        if (this.isWaiting) this.messages.fail(dropped);
        this.plays.drop(dropped); // each says so
        this.dropWaiting();
        this.driving.letGo();
        this.transfer.cancel();
        if (this.state.get().connection === 'ready') this.connection.requests.dropMoves();
    }

    /** What was asked of one robot must not move or change the next one. */
    private leaveRobot(): void {
        this.dropWaiting();
        this.driving.leave();
        this.transfer.leave();
        this.messages.leaveRobot();
        this.texts.tell(NEW_SCREEN);
        this.status.look();
    }

    /** A search for servos takes seconds. A program that has ended, or whose adapter is gone, is not waited for. */
    private untilFound(): Promise<void> {
        const used = this.state.get().source;
        const look = ({ source, connection, stopped }: SessionState): boolean => {
            if (source !== used) throw new RobotError('cancelled');
            return source !== 'servos' || stopped !== null || !SEARCHES.has(connection);
        };
        return until(this.state, look, SEARCH_MS);
    }

    private get isSimulated(): boolean {
        return this.sources.isSimulated;
    }

    private get connection(): Connection {
        return this.sources.connection;
    }

    /** A request to a robot that is off is dropped, or it would run whenever the robot is switched on. false: it was not done, which has
     *  been reported. */
    private async act(action: () => Promise<unknown>): Promise<boolean> {
        if (this.isSimulated && !this.state.get().isPowered) {
            this.messages.complain(TEXTS.status.isOff, 'robot');
            return false;
        }
        try {
            if ((await action()) === false) return false; // another request has taken its place, and reports
            this.messages.say(null);
            void this.status.ask();
            return true;
        } catch (error) {
            this.messages.fail(error);
            return false;
        }
    }
}
