// SPDX-License-Identifier: MIT
// The simulated board with its servos: made from images and kept memories, read back, reset. Uses no wall clock, worker or storage.

import * as facts from '../model/facts.ts';
import { Board, CYCLES_PER_MS, MOTIONS_ADDRESS } from './board.ts';
import type { ServoReading } from './board.ts';

/** Boot loader, application and motions of a factory-new robot. */
export interface Images {
    readonly boot: string; // Intel HEX
    readonly application: string; // Intel HEX
    readonly motions: Uint8Array;
}

/** The memories that survive without power. */
export interface Memories {
    readonly flash: Uint8Array;
    readonly eeprom: Uint8Array;
    readonly servos: Uint8Array;
}

export const SERVO_IDS: readonly number[] = Array.from({ length: 18 }, (_, i) => i + 1);
/** The loader's mode byte: start the application without a message. If erased, the loader stays at its prompt. */
const { MEM_EE_BOOT_MODE: MODE_BYTE, START_MODE_APPLICATION: MODE_APPLICATION, MEM_APP_END: APPLICATION_END } = facts;
const RESET_CYCLES = 10 * CYCLES_PER_MS;

/** A robot without power. Kept memories are loaded first, then boot loader and application over them, as in a firmware update. The motions
 *  are loaded only if nothing was kept. Throws if an image is invalid; the text names the image and the fault. */
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
    loadImage(board, 'the boot loader', images.boot); // also sets the fuse that starts the loader
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
