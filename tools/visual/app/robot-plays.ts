// SPDX-License-Identifier: MIT
// What a robot is asked to play: a page as it has it, the page that is edited, and what goes on beside a play. Each deed resolves to why
// it was not done, or to null; it rejects with RobotError.

import { dirtyPages } from '../model/editor-state.ts';
import type { Shape } from '../model/motion.ts';
import type { Connection } from '../robot/connection.ts';
import { aim, askList, free, play, setAmplitude, setBlend, setLayer, setRate, swing } from '../robot/protocol.ts';
import type { Requests } from '../robot/requests.ts';
import type { Beside, DeskState } from '../view/desk.ts';
import { LAYER_TEXTS, PLAY_TEXTS } from '../view/editor/step-texts.ts';
import type { Store } from '../view/store.ts';
import type { DocumentEditor } from './editor.ts';
import type { RobotTransfer } from './transfer.ts';

export interface PlayParts {
  readonly state: Store<DeskState>;
  readonly editor: DocumentEditor;
  readonly transfer: RobotTransfer;
  /** Throws RobotError not-connected when there is none. */
  connection(): Connection;
  /** Before a motion: the robot in the page gets to its feet. */
  prepare(): Promise<void>;
}

type WhyNot = string | null;

export class RobotPlays {
  private readonly parts: PlayParts;

  constructor(parts: PlayParts) {
    this.parts = parts;
  }

  /** A page as the robot has it. */
  async play(page: number): Promise<WhyNot> {
    await this.parts.prepare();
    await play(this.requests, page);
    return null;
  }

  /** A page as the document has it. */
  async playEdited(page: number): Promise<WhyNot> {
    const { format, state } = this.parts.editor;
    return (await this.bringPages(format.reach(state.get().document, page))) ?? this.play(page);
  }

  async shape({ rate, amplitude, blend }: Shape): Promise<WhyNot> {
    const { requests } = this;
    await setRate(requests, rate);
    await setAmplitude(requests, amplitude);
    await setBlend(requests, blend);
    return null;
  }

  async beside(what: Beside): Promise<WhyNot> {
    const { requests } = this;
    switch (what.kind) {
      case 'layer': return this.layer(what.page, what.joints);
      case 'aim': await aim(requests, what.joint, what.position, what.degreesPerSecond); break;
      case 'swing': await swing(requests, what.joint, what.centre, what.amplitude, what.periodMs); break;
      case 'free': await free(requests, what.joints); break;
      default: what satisfies never;
    }
    return null;
  }

  /** Makes sure that the robot has these pages as the document has them. The robot in the page gets them; what will change in
   *  yours is to be seen before. */
  private async bringPages(pages: readonly number[]): Promise<WhyNot> {
    const { editor, transfer, state } = this.parts;
    if (editor.state.get().robot.length === 0 && !(await transfer.read())) return transfer.state.get().trouble;
    if (!this.isAnyOtherwise(pages)) return null;
    if (!this.isSimulated) return PLAY_TEXTS.writeFirst;
    if (!(await transfer.write(pages))) return transfer.state.get().trouble;
    state.set({ pages: await askList(this.requests) });
    return null;
  }

  /** A layer is what the robot has in its flash: one that differs is not played. */
  private async layer(page: number | null, joints: readonly number[]): Promise<WhyNot> {
    const { format, state } = this.parts.editor;
    if (page !== null && this.isAnyOtherwise(format.reach(state.get().document, page))) return this.isSimulated ? LAYER_TEXTS.otherwise : LAYER_TEXTS.otherwiseYours;
    await setLayer(this.requests, page, joints);
    return null;
  }

  /** The robot has one of these pages otherwise than the document. */
  private isAnyOtherwise(pages: readonly number[]): boolean {
    const { format, state } = this.parts.editor;
    const dirty = dirtyPages(state.get(), format);
    return pages.some((page) => dirty.has(page));
  }

  private get isSimulated(): boolean {
    return this.parts.state.get().source === 'simulated';
  }

  private get requests(): Requests {
    return this.parts.connection().requests;
  }
}
