// SPDX-License-Identifier: MIT
// Driving the robot on the desk by the keys of a remote or by a stick. Only Play can be driven.

import type { Connection } from '../robot/connection.ts';
import type { RemoteButton } from '../robot/remote.ts';
import type { DeskState } from '../view/desk.ts';
import type { Store } from '../view/store.ts';
import { TEXTS } from '../view/texts.ts';
import { RemoteKeys } from './remote-keys.ts';
import type { SimulatedSource } from './simulated-source.ts';
import { StickDrive } from './stick.ts';
import type { Stick } from './stick.ts';
import type { Strip } from './strip.ts';

export interface DrivingParts {
  readonly state: Store<DeskState>;
  readonly strip: Strip;
  readonly simulated: Pick<SimulatedSource, 'post'>;
  /** Throws RobotError not-connected when there is none. */
  connection(): Connection;
  /** The robot in the page runs Play, if it does not yet. */
  becomeDriven(): void;
}

export class Driving {
  private readonly parts: DrivingParts;
  private readonly keys = new RemoteKeys((packet) => this.send(packet));
  private readonly stick: StickDrive;

  constructor(parts: DrivingParts) {
    this.parts = parts;
    this.stick = new StickDrive(parts.connection, () => this.walkPage(), parts.strip.fail);
  }

  remote(held: ReadonlySet<RemoteButton>): void {
    if (held.size > 0 && this.isSimulated) this.parts.becomeDriven();
    if (held.size > 0 && this.isYoursWithEdit) this.parts.strip.say({ text: TEXTS.editNoRemote, tone: 'bad' });
    this.keys.hold(held);
  }

  drive(stick: Stick | null): void {
    this.stick.set(stick);
  }

  private walkPage(): number | null {
    const { version, pages } = this.state;
    return version?.image === 'play' ? (pages.find((page) => page.name === 'walk')?.page ?? null) : null;
  }

  /** To Edit they would be letters. */
  private send(packet: Uint8Array): void {
    const { strip, simulated } = this.parts;
    if (this.isSimulated && this.state.image === 'play') simulated.post({ kind: 'bytes', sender: 'remote', bytes: packet });
    else if (!this.isSimulated && !this.isYoursWithEdit) void this.parts.connection().write(packet).catch(strip.fail);
  }

  private get isYoursWithEdit(): boolean {
    return !this.isSimulated && this.state.version?.image === 'edit';
  }

  private get isSimulated(): boolean {
    return this.state.source === 'simulated';
  }

  private get state(): DeskState {
    return this.parts.state.get();
  }
}
