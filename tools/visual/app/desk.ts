// SPDX-License-Identifier: MIT
// The robot on the desk: joins the simulated robot or a port with the protocol and the views. The only place that knows
// them all.

import type { FileFormats } from '../model/file-formats.ts';
import type { Body } from '../model/body.ts';
import { documentFrom } from '../model/document.ts';
import type { Shape } from '../model/motion.ts';
import type { Connection } from '../robot/connection.ts';
import type { ConnectionState } from '../robot/connection-table.ts';
import { askList, command, setTorque } from '../robot/protocol.ts';
import type { Command } from '../robot/protocol.ts';
import type { TerminalSize } from '../robot/edit-screen.ts';
import type { RemoteButton } from '../robot/remote.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { RobotState } from '../robot/robot-state.ts';
import type { Beside, Desk, DeskState, Floor, Hand, ImageName, Notice, PanelButton, Tab } from '../view/desk.ts';
import { refusalText } from '../view/editor/texts.ts';
import { Store } from '../view/store.ts';
import { DocumentEditor } from './editor.ts';
import type { EditorParts } from './editor.ts';
import { TEXTS, errorText } from '../view/texts.ts';
import { makeDocuments, makeTransfer } from './document-parts.ts';
import type { DeskStorage } from './document-parts.ts';
import type { KeptDocuments } from './documents.ts';
import { DocumentFiles } from './files.ts';
import { Follow } from './follow.ts';
import { Listeners } from './listeners.ts';
import { LastSaid } from './said.ts';
import { RemoteKeys } from './remote-keys.ts';
import { Status } from './status.ts';
import { StickDrive } from './stick.ts';
import type { Stick } from './stick.ts';
import type { RobotTransfer } from './transfer.ts';
import { trialClient } from './assets.ts';
import { MotionTrials } from './trials.ts';
import { RobotImages } from './robot-images.ts';
import { RobotPlays } from './robot-plays.ts';
import { SimulatedSource } from './simulated-source.ts';
import { YourSource } from './your-source.ts';

/** What went wrong is to be read before the board's next line takes its place. */
const TROUBLE_STAYS_MS = 6000;

const ROBOT_IN_PAGE = 'robot in the page';

const START: DeskState = {
  source: 'simulated', connection: 'closed', portName: '', version: null, where: null, isInDialog: false, pages: [], image: 'play',
  physics: 'loading', speed: 1, stopped: null, doing: { text: 'Starting …', tone: 'calm' }, said: null, faultNames: [], tab: 'remote',
};

export class RobotDesk implements Desk {
  readonly body: Body;
  readonly state = new Store<DeskState>(START);
  readonly editor: DocumentEditor;
  readonly files: DocumentFiles;
  readonly documents: KeptDocuments;
  readonly transfer: RobotTransfer;
  readonly trials: MotionTrials;
  private readonly frames = new Listeners<RobotState>();
  private readonly texts = new Listeners<Uint8Array>();
  private readonly simulated: SimulatedSource;
  private readonly yours: YourSource;
  private readonly images: RobotImages;
  private readonly plays: RobotPlays;
  private readonly lastSaid = new LastSaid();
  private readonly remoteKeys = new RemoteKeys((packet) => this.sendRemote(packet));
  private readonly status: Status = new Status({ state: this.state, connection: () => this.connection, isWriting: () => this.transfer.isWriting });
  private troubleUntilMs = 0;
  private readonly follower = new Follow(() => this.connection, (error) => this.fail(error));
  /** What the robot in the page has in its flash. */
  private inPage: readonly Uint8Array[] = [];
  private readonly stick = new StickDrive(() => this.connection, () => this.walkPage(), (error) => this.fail(error));

  constructor(body: Body, parts: EditorParts, formats: FileFormats, storage: DeskStorage) {
    this.body = body;
    this.editor = new DocumentEditor(body, parts, {
      changed: () => this.documents.keep(),
      opened: () => this.trials.forget(),
      refused: (refusal) => this.state.set({ said: { text: refusalText(refusal), tone: 'bad' } }),
    });
    this.files = new DocumentFiles(this.editor, formats);
    this.trials = new MotionTrials(this.editor, () => trialClient(body));
    this.documents = makeDocuments(this.editor, storage, () => this.say({ text: TEXTS.workNotKept, tone: 'bad' }));
    this.transfer = makeTransfer(this.editor, this.documents, {
      name: () => (this.isSimulated ? ROBOT_IN_PAGE : this.state.get().portName), requests: () => this.connection.requests,
      becomeEdit: () => (this.isSimulated ? this.images.becomeEdit() : this.needEdit()),
    });
    const events = {
      frame: (state: RobotState) => this.frames.tell(state),
      text: (bytes: Uint8Array) => this.hear(bytes),
      connection: (state: ConnectionState) => this.connectionChanged(state),
      change: (change: Partial<DeskState>) => {
        this.state.set(change);
        if (change.physics === 'on') this.standUp();
        if (change.isInDialog !== undefined) this.status.tell();
      },
      motions: (image: Uint8Array) => this.simulatedMotions(image),
    };
    this.simulated = new SimulatedSource(body, events);
    this.yours = new YourSource(body, events, () => this.status.mayAsk());
    this.plays = new RobotPlays({
      state: this.state, editor: this.editor, transfer: this.transfer, connection: () => this.connection,
      prepare: async () => (this.isSimulated ? this.simulated.prepare() : undefined),
    });
    this.images = new RobotImages({
      state: this.state, format: parts.format, simulated: this.simulated,
      standUp: () => this.standUp(), say: (said) => this.say(said), fail: (error) => this.fail(error),
    });
  }

  /** Starts the robot in the page. */
  start(): Promise<void> {
    return this.simulated.start(this.state.get().image);
  }

  private async needEdit(): Promise<void> {
    if (!this.state.get().version?.can.has('save')) throw new RobotError('needs-edit');
  }

  private simulatedMotions(image: Uint8Array): void {
    this.inPage = documentFrom(image, '').pages;
    if (this.isSimulated) this.editor.setRobot(this.inPage);
  }

  onFrame(listener: (state: RobotState) => void): () => void {
    return this.frames.add(listener);
  }

  onText(listener: (bytes: Uint8Array) => void): () => void {
    return this.texts.add(listener);
  }

  show(tab: Tab): void {
    this.state.set({ tab });
    this.status.look();
  }

  terminalSize(size: TerminalSize): void {
    this.status.terminalSize(size);
  }

  play(page: number): Promise<void> {
    return this.deed(() => this.plays.play(page));
  }

  playEdited(page: number): Promise<void> {
    return this.deed(() => this.plays.playEdited(page));
  }

  shape(shape: Shape): Promise<void> {
    return this.deed(() => this.plays.shape(shape));
  }

  beside(what: Beside): Promise<void> {
    return this.deed(() => this.plays.beside(what));
  }

  command(what: Command): Promise<void> {
    return this.deed(async () => {
      const isStop = what === 'stop' || what === 'break';
      if (!isStop || !(await this.connection.breakOff())) await command(this.connection.requests, what);
    });
  }

  setTorque(on: boolean, servos: readonly number[] = []): Promise<void> {
    return this.deed(() => setTorque(this.connection.requests, on, servos));
  }

  follow(positions: readonly (number | null)[] | null): void {
    this.follower.set(positions);
  }

  say(said: Notice): void {
    this.state.set({ said });
  }

  remote(held: ReadonlySet<RemoteButton>): void {
    if (held.size > 0 && this.isSimulated) this.images.becomeDriven();
    if (held.size > 0 && this.isYoursWithEdit) this.say({ text: TEXTS.editNoRemote, tone: 'bad' });
    this.remoteKeys.hold(held);
  }

  drive(stick: Stick | null): void {
    this.stick.set(stick);
  }

  type(bytes: Uint8Array): void {
    void this.connection.type(bytes).catch((error: unknown) => this.fail(error));
  }

  useSimulated(): void {
    if (this.isSimulated) return;
    this.state.set({ source: 'simulated' });
    void this.yours.close();
    this.simulated.resume();
    this.editor.setRobot(this.inPage);
  }

  async connectYours(): Promise<void> {
    try {
      if (!(await this.yours.choose())) return; // the chooser was closed: no error
    } catch (error) {
      return this.fail(error);
    }
    this.simulated.pause();
    this.state.set({ source: 'yours', version: null, where: null, pages: [] });
    this.editor.setRobot([]);
    this.yours.connect();
  }

  setSpeed(speed: number): void {
    this.state.set({ speed });
    this.simulated.post({ kind: 'speed', speed });
  }

  oneTick(): void {
    this.setSpeed(0);
    this.simulated.post({ kind: 'tick' });
  }

  setPower(on: boolean): void {
    this.simulated.post({ kind: 'power', on });
    if (on) setTimeout(() => this.simulated.connection?.askAgain(), 1500);
  }

  press(button: PanelButton, down: boolean): void {
    this.simulated.post({ kind: 'button', button, down });
  }

  setBattery(volts: number): void {
    this.simulated.post({ kind: 'battery', volts });
  }

  setFault(servo: number, fault: number, on: boolean): void {
    this.simulated.post({ kind: 'fault', servo, fault, answers: on ? -1 : 0 });
  }

  turnServo(servo: number, position: number): void {
    this.simulated.post({ kind: 'turn-servo', servo, position });
  }

  pull(hand: Hand | null, ticks = Infinity): void {
    this.simulated.post({ kind: 'grip', grip: hand, ticks });
  }

  hold(held: boolean): void {
    this.simulated.post({ kind: 'hold', held });
  }

  setFloor(floor: Floor): void {
    this.simulated.post({ kind: 'floor', floor });
  }

  runImage(image: ImageName): void {
    this.images.run(image);
  }

  forget(): Promise<void> {
    return this.images.forget();
  }

  /** Only Play can be driven. */
  private walkPage(): number | null {
    const { version, pages } = this.state.get();
    return version?.image === 'play' ? (pages.find((page) => page.name === 'walk')?.page ?? null) : null;
  }

  private get isSimulated(): boolean {
    return this.state.get().source === 'simulated';
  }

  private get connection(): Connection {
    const connection = this.isSimulated ? this.simulated.connection : this.yours.connection;
    if (!connection) throw new RobotError('not-connected');
    return connection;
  }

  /** deed: what it resolves to, if anything, says why it was not done. */
  private async deed(deed: () => Promise<string | null | void>): Promise<void> {
    try {
      const why = (await deed()) ?? null;
      this.state.set({ said: why === null ? null : { text: why, tone: 'bad' } });
      void this.status.ask();
    } catch (error) {
      this.fail(error);
    }
  }

  private fail(error: unknown): void {
    if (!(error instanceof RobotError)) throw error;
    this.troubleUntilMs = performance.now() + TROUBLE_STAYS_MS;
    this.state.set({ said: { text: errorText(error), tone: 'bad' } });
  }

  private hear(bytes: Uint8Array): void {
    this.texts.tell(bytes);
    const said = this.lastSaid.take(bytes);
    if (said && (said.isTrouble || performance.now() > this.troubleUntilMs)) this.state.set({ said: { text: said.text, tone: said.isTrouble ? 'bad' : 'calm' } });
  }

  private connectionChanged(state: ConnectionState): void {
    const { version, name, isInDialog } = this.connection;
    this.state.set({ connection: state, version, portName: name, where: null, isInDialog });
    this.status.tell();
    this.status.look();
    if (state !== 'ready') return;
    void askList(this.connection.requests).then((pages) => this.state.set({ pages }), (error: unknown) => this.fail(error));
    this.standUp();
    void this.status.ask();
    if (!this.isSimulated && this.editor.state.get().robot.length === 0) void this.learnYours();
  }

  /** The robot in the page stands up by itself as soon as it answers and has a body, whichever comes last. */
  private standUp(): void {
    const { connection, version } = this.state.get();
    if (this.isSimulated && connection === 'ready' && version?.image === 'play') void this.simulated.prepare().catch((error: unknown) => this.fail(error));
  }

  /** Reads what your robot has and keeps it, as soon as it is known; no question is asked for it. */
  private async learnYours(): Promise<void> {
    if (!(await this.transfer.read())) return;
    const pages = this.editor.state.get().robot.filter((bytes) => bytes !== null);
    await this.transfer.keep(pages).catch((error: unknown) => this.fail(error));
    this.say({ text: TEXTS.robotKept, tone: 'calm' });
  }

  private get isYoursWithEdit(): boolean {
    return !this.isSimulated && this.state.get().version?.image === 'edit';
  }

  /** To Edit they would be letters. */
  private sendRemote(packet: Uint8Array): void {
    if (this.isSimulated && this.state.get().image === 'play') this.simulated.post({ kind: 'bytes', sender: 'remote', bytes: packet });
    else if (!this.isSimulated && !this.isYoursWithEdit) void this.connection.write(packet).catch((error: unknown) => this.fail(error));
  }
}
