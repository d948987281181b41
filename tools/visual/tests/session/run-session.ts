// SPDX-License-Identifier: MIT
// Runs one session of session.json on board.wasm through the flat API that the page uses, and hashes the results. test_same_machine.py runs
// the same session natively; both must give the same hashes.

import { Board, CYCLES_PER_MS, CYCLES_PER_TICK, MOTIONS_ADDRESS } from '../../sim/board.ts';
import type { Button } from '../../sim/board.ts';

export interface Session {
    readonly name: string;
    readonly images: readonly string[];
    readonly seed: number;
    readonly seconds: number;
    readonly events: readonly (readonly [number, string, unknown])[];
}

export interface SessionFiles {
    readonly board: WebAssembly.Module;
    readonly motions: Uint8Array;
    hex(name: string): Promise<string>;
}

const SERVOS = 18;

function rcPacket(value: number): Uint8Array {
    const low = value & 0xff;
    const high = (value >> 8) & 0xff;
    return Uint8Array.of(0xff, 0x55, low, low ^ 0xff, high, high ^ 0xff);
}

function act(board: Board, faults: string[], verb: string, what: unknown): void {
    const [first, second, third] = Array.isArray(what) ? what : [what];
    switch (verb) {
        case 'send':
            return board.send('pc', new TextEncoder().encode(String(first)));
        case 'rc':
            return board.send('remote', rcPacket(Number(first)));
        case 'press':
            return board.press(first as Button, Boolean(second));
        case 'power':
            return board.setPower(Boolean(first));
        case 'battery':
            return board.setBattery(Number(first));
        case 'push':
            return board.pushServo(Number(first) - 1, Number(second));
        case 'fault':
            return void board.setFault(Number(first) - 1, faults.indexOf(String(second)), Number(third));
        default:
            throw new Error(`session: no such event: ${verb}`);
    }
}

async function hash(parts: readonly Uint8Array[]): Promise<string> {
    const all = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
    let at = 0;
    for (const part of parts) {
        all.set(part, at);
        at += part.length;
    }
    const digest = new Uint8Array(await crypto.subtle.digest('SHA-256', all));
    return Array.from(digest, byte => byte.toString(16).padStart(2, '0')).join('');
}

async function makeBoard(session: Session, files: SessionFiles): Promise<Board> {
    const board = await Board.make(files.board, session.seed);
    for (const image of session.images) {
        const wrong = board.loadHex(await files.hex(image));
        if (wrong) throw new Error(`${image} ${wrong}`);
    }
    board.writeFlash(MOTIONS_ADDRESS, files.motions);
    for (let id = 1; id <= SERVOS; id++) board.addServo(id);
    board.setPower(true);
    return board;
}

/** Hashes of console bytes, goals and positions (every tick), and the final flash and EEPROM. */
export async function runSession(session: Session, files: SessionFiles): Promise<Record<string, string>> {
    const board = await makeBoard(session, files);
    const faults = board.faultNames();
    const console: Uint8Array[] = [];
    const goals: Uint8Array[] = [];
    const positions: Uint8Array[] = [];
    const events = [...session.events];
    for (let tick = 1; tick <= session.seconds * 128; tick++) {
        for (let next = events[0]; next && next[0] * CYCLES_PER_MS <= (tick - 1) * CYCLES_PER_TICK; next = events[0]) {
            events.shift();
            act(board, faults, next[1], next[2]);
        }
        if (!board.runTo(tick * CYCLES_PER_TICK)) throw new Error(`${board.violation?.kind}: ${board.violation?.text}`);
        console.push(board.receive());
        const servos = board.servos();
        goals.push(new Uint8Array(Uint16Array.from(servos, servo => servo.goalPos).buffer));
        positions.push(new Uint8Array(Float64Array.from(servos, servo => servo.position).buffer));
    }
    return {
        console: await hash(console),
        goals: await hash(goals),
        positions: await hash(positions),
        flash: await hash([board.readFlash()]),
        eeprom: await hash([board.readEeprom()]),
        cycles: String(board.nowCycles),
        busy: String(board.busyCycles),
    };
}
