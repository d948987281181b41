// SPDX-License-Identifier: MIT
// The simulated robot as a whole: board, servos and, when there is one, a body. Runs for so many cycles; knows no wall
// clock, no worker and no storage.

import * as facts from '../model/facts.ts';
import { Board, CYCLES_PER_MS, MOTIONS_ADDRESS } from './board.ts';
import type { ServoReading } from './board.ts';

/** Boot loader, application and motions for a robot fresh from the factory. */
export interface Images {
    readonly boot: string; // Intel HEX
    readonly application: string; // Intel HEX
    readonly motions: Uint8Array;
}

/** What a robot keeps without power. */
export interface Memories {
    readonly flash: Uint8Array;
    readonly eeprom: Uint8Array;
    readonly servos: Uint8Array;
}

export const SERVO_IDS: readonly number[] = Array.from({ length: 18 }, (_, i) => i + 1);
/** The loader's mode byte: start the application without a word (an erased one keeps it at its prompt). */
const { MEM_EE_BOOT_MODE: MODE_BYTE, START_MODE_APPLICATION: MODE_APPLICATION, MEM_APP_END: APPLICATION_END } = facts;
const RESET_CYCLES = 10 * CYCLES_PER_MS;

/** A robot without power. What it kept is loaded first, then the images over it, as a new firmware would be; motions only
 *  into a robot that kept nothing. Throws when an image is not one: the text names it and what is wrong. */
export async function makeMachine(module: WebAssembly.Module, images: Images, kept: Memories | null, seed = 1): Promise<Board> {
    const board = await Board.make(module, seed);
    for (const id of SERVO_IDS) board.addServo(id);
    if (kept && kept.flash.length > 0) {
        board.writeFlash(0, kept.flash);
        board.writeEeprom(0, kept.eeprom);
        board.writeServoEeproms(kept.servos);
        board.writeFlash(0, new Uint8Array(APPLICATION_END).fill(0xff));
    } else {
        board.writeFlash(MOTIONS_ADDRESS, images.motions);
        board.writeEeprom(MODE_BYTE, Uint8Array.of(MODE_APPLICATION));
    }
    loadImage(board, 'the application', images.application);
    loadImage(board, 'the boot loader', images.boot); // also sets the fuse that starts it
    return board;
}

function loadImage(board: Board, what: string, hex: string): void {
    const wrong = board.loadHex(hex);
    if (wrong) throw new Error(`the file of ${what} ${wrong}`);
}

export function readMemories(board: Board): Memories {
    return { flash: board.readFlash(), eeprom: board.readEeprom(), servos: board.readServoEeproms() };
}

/** Presses MODE for 10 ms of simulated time. */
export function resetBoard(board: Board): void {
    board.press('mode', true);
    board.runTo(board.nowCycles + RESET_CYCLES);
    board.press('mode', false);
}

export type { ServoReading };
