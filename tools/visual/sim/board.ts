// SPDX-License-Identifier: MIT
// The simulated robot of board.wasm with names and types. board/board_api.h documents the functions.

import * as facts from '../model/facts.ts';
import { wasiImports } from './wasi.ts';

export const CYCLES_PER_TICK = facts.M128_HZ / facts.PLAYER_TICKS_PER_SECOND;
export const CYCLES_PER_MS = facts.M128_HZ / 1000;
export const FLASH_BYTES = facts.MEM_BOOT_END;
export const EEPROM_BYTES = facts.MEM_EEPROM_BYTES;
export const MOTIONS_ADDRESS = facts.MEM_MOTION_START;
/** servo_shaft_t as doubles: ID, torque in N m, angle in radians, speed in radians per second. */
export const SHAFT_FIELDS = facts.SERVO_SHAFT_FIELDS;
/** Factory setting. */
const AX12_BPS = 1_000_000;
const { BOARD_API_BUFFER_BYTES: BUFFER_BYTES, BOARD_API_SERVO_FIELDS: SERVO_FIELDS, SERVO_EEPROM_BYTES } = facts;

export type Sender = 'pc' | 'remote';
export const BUTTONS = ['up', 'down', 'left', 'right', 'start', 'mode'] as const;
export type Button = (typeof BUTTONS)[number];

/** The current state of one servo. Positions in servo units, speeds in units per second. */
export interface ServoReading {
    readonly id: number;
    readonly goalPos: number;
    readonly position: number;
    readonly velocity: number;
    readonly output: number;
    readonly torque: boolean;
    readonly alarms: number;
    readonly celsius: number;
    readonly faults: number;
    readonly led: boolean;
}

/** The body that the servos' shafts drive (servo_body.h). Each shaft is four doubles: ID, torque, angle, speed. */
export interface ShaftBody {
    look(shafts: Float64Array): void;
    step(shafts: Float64Array): void;
}

interface Exports {
    readonly memory: WebAssembly.Memory;
    _initialize(): void;
    board_api_buffer(): number;
    board_api_new(kind: number, seed: number): number;
    board_api_add_servo(id: number, model: number, bps: number): number;
    board_api_power(on: number): void;
    board_api_is_powered(): number;
    board_api_press(button: number, down: number): void;
    board_api_battery(volts: number): void;
    board_api_run(untilCycle: number): number;
    board_api_now(): number;
    board_api_busy(): number;
    board_api_resets(): number;
    board_api_violation(): number;
    board_api_violation_name(): number;
    board_api_violation_text(): number;
    board_api_load_hex(count: number): number;
    board_api_load_text(status: number): number;
    board_api_flash_read(address: number, count: number): number;
    board_api_flash_write(address: number, count: number): number;
    board_api_eeprom_read(address: number, count: number): number;
    board_api_eeprom_write(address: number, count: number): number;
    board_api_operations(): number;
    board_api_servo_eeprom_read(index: number): number;
    board_api_servo_eeprom_write(index: number): number;
    board_api_send(sender: number, count: number): void;
    board_api_waiting(): number;
    board_api_drop_waiting(): void;
    board_api_receive(): number;
    board_api_leds(): number;
    board_api_servos(): number;
    board_api_servo_table(): number;
    board_api_servo_register(index: number, address: number, bytes: number): number;
    board_api_servo_push(index: number, position: number): void;
    board_api_body(attached: number): void;
    board_api_faults(): number;
    board_api_fault_name(fault: number): number;
    board_api_fault(index: number, fault: number, answers: number): number;
}

/** Throws if the bytes are not a module or there is no memory for a board. */
export class Board {
    private readonly api: Exports;
    private readonly bufferAt: number;
    private readonly seam: { body: ShaftBody | null };

    private constructor(api: Exports, seed: number, seam: { body: ShaftBody | null }) {
        this.api = api;
        this.seam = seam;
        this.bufferAt = api.board_api_buffer();
        if (!api.board_api_new(facts.BOARD_CM5, seed)) throw new Error('no memory for a simulated board');
    }

    /** A CM-5 without power, erased, without servos. seed: determines the SRAM contents at power-on. */
    static async make(module: WebAssembly.Module, seed = 1): Promise<Board> {
        const seam: { body: ShaftBody | null } = { body: null };
        const shafts = (at: number, count: number): Float64Array =>
            new Float64Array((instance.exports as unknown as Exports).memory.buffer, at, count * SHAFT_FIELDS);
        const instance: WebAssembly.Instance = await WebAssembly.instantiate(module, {
            ...wasiImports(() => (instance.exports as unknown as Exports).memory),
            body: {
                look: (at: number, count: number) => seam.body?.look(shafts(at, count)),
                step: (at: number, count: number) => seam.body?.step(shafts(at, count)),
            },
        });
        const api = instance.exports as unknown as Exports; // the names above are those of board_api.h
        api._initialize();
        return new Board(api, seed, seam);
    }

    /** Connects the servos' shafts to a body, which moves in lockstep with the board. null: each servo turns its own rotor. */
    setBody(body: ShaftBody | null): void {
        this.seam.body = body;
        this.api.board_api_body(Number(body !== null));
    }

    addServo(id: number): void {
        if (!this.api.board_api_add_servo(id, facts.SERVO_AX12, AX12_BPS)) throw new Error(`servo ${id} cannot be plugged in`);
    }

    setPower(on: boolean): void {
        this.api.board_api_power(Number(on));
    }

    get isPowered(): boolean {
        return this.api.board_api_is_powered() !== 0;
    }

    press(button: Button, down: boolean): void {
        this.api.board_api_press(BUTTONS.indexOf(button), Number(down));
    }

    setBattery(volts: number): void {
        this.api.board_api_battery(volts);
    }

    /** Runs to the first instruction boundary at or after that cycle. false: a violation stopped the board. */
    runTo(cycle: number): boolean {
        return this.api.board_api_run(cycle) === 0;
    }

    get nowCycles(): number {
        return this.api.board_api_now();
    }

    get busyCycles(): number {
        return this.api.board_api_busy();
    }

    get resets(): number {
        return this.api.board_api_resets();
    }

    /** A firmware action that the chip does not allow: its kind and a sentence. null: none. */
    get violation(): { readonly kind: string; readonly text: string } | null {
        if (this.api.board_api_violation() === 0) return null;
        return { kind: this.text(this.api.board_api_violation_name()), text: this.text(this.api.board_api_violation_text()) };
    }

    /** Loads an Intel HEX file into flash. Returns null, or the fault of the file, in which case nothing was changed. */
    loadHex(text: string): string | null {
        const bytes = new TextEncoder().encode(text);
        if (bytes.length > BUFFER_BYTES) return 'is longer than any image';
        const status = this.api.board_api_load_hex(this.put(bytes));
        return status === 0 ? null : this.text(this.api.board_api_load_text(status));
    }

    readFlash(address = 0, count = FLASH_BYTES): Uint8Array {
        return this.take(this.api.board_api_flash_read(address, count));
    }

    writeFlash(address: number, bytes: Uint8Array): void {
        this.api.board_api_flash_write(address, this.put(bytes));
    }

    readEeprom(address = 0, count = EEPROM_BYTES): Uint8Array {
        return this.take(this.api.board_api_eeprom_read(address, count));
    }

    writeEeprom(address: number, bytes: Uint8Array): void {
        this.api.board_api_eeprom_write(address, this.put(bytes));
    }

    /** Flash and EEPROM writes by the firmware so far. */
    get operations(): number {
        return this.api.board_api_operations();
    }

    /** The EEPROMs of all servos in sequence. */
    readServoEeproms(): Uint8Array {
        const all = new Uint8Array(this.servoCount * SERVO_EEPROM_BYTES);
        for (let i = 0; i < this.servoCount; i++) {
            all.set(this.take(this.api.board_api_servo_eeprom_read(i)), i * SERVO_EEPROM_BYTES);
        }
        return all;
    }

    /** Call before power-on. Returns false if the length does not match the servos. */
    writeServoEeproms(all: Uint8Array): boolean {
        if (all.length !== this.servoCount * SERVO_EEPROM_BYTES) return false;
        for (let i = 0; i < this.servoCount; i++) {
            this.put(all.subarray(i * SERVO_EEPROM_BYTES, (i + 1) * SERVO_EEPROM_BYTES));
            this.api.board_api_servo_eeprom_write(i);
        }
        return true;
    }

    send(sender: Sender, bytes: Uint8Array): void {
        this.api.board_api_send(sender === 'remote' ? 1 : 0, this.put(bytes));
    }

    /** Bytes that the board has not received yet. */
    get waiting(): number {
        return this.api.board_api_waiting();
    }

    dropWaiting(): void {
        this.api.board_api_drop_waiting();
    }

    /** Bytes that the board has sent since the last call. */
    receive(): Uint8Array {
        return this.take(this.api.board_api_receive());
    }

    /** Bit n: power, txd, rxd, aux, manage, program, play. */
    get leds(): number {
        return this.api.board_api_leds();
    }

    get servoCount(): number {
        return this.api.board_api_servos();
    }

    servos(): ServoReading[] {
        const at = this.api.board_api_servo_table();
        const table = new Float64Array(this.api.memory.buffer, at, this.servoCount * SERVO_FIELDS);
        const readings: ServoReading[] = [];
        for (let i = 0; i < this.servoCount; i++) {
            const field = (n: number): number => table[i * SERVO_FIELDS + n] ?? 0;
            readings.push({
                id: field(facts.BOARD_API_SERVO_ID),
                goalPos: field(facts.BOARD_API_SERVO_GOAL),
                position: field(facts.BOARD_API_SERVO_POSITION),
                velocity: field(facts.BOARD_API_SERVO_VELOCITY),
                output: field(facts.BOARD_API_SERVO_OUTPUT),
                torque: field(facts.BOARD_API_SERVO_TORQUE) !== 0,
                alarms: field(facts.BOARD_API_SERVO_ALARMS),
                celsius: field(facts.BOARD_API_SERVO_CELSIUS),
                faults: field(facts.BOARD_API_SERVO_FAULTS),
                led: field(facts.BOARD_API_SERVO_LED) !== 0,
            });
        }
        return readings;
    }

    register(index: number, address: number, bytes: 1 | 2): number {
        return this.api.board_api_servo_register(index, address, bytes);
    }

    /** A hand turns the horn to this position (servo units). */
    pushServo(index: number, position: number): void {
        this.api.board_api_servo_push(index, position);
    }

    faultNames(): string[] {
        return Array.from({ length: this.api.board_api_faults() }, (_, i) => this.text(this.api.board_api_fault_name(i)));
    }

    /** answers: how many answers are spoiled; 0 ends the fault, -1 keeps it until then. false: no such servo or fault. */
    setFault(index: number, fault: number, answers: number): boolean {
        return this.api.board_api_fault(index, fault, answers) !== 0;
    }

    private put(bytes: Uint8Array): number {
        if (bytes.length > BUFFER_BYTES) throw new RangeError(`${bytes.length} bytes do not fit the board's buffer`);
        new Uint8Array(this.api.memory.buffer, this.bufferAt, bytes.length).set(bytes);
        return bytes.length;
    }

    private take(count: number): Uint8Array {
        return new Uint8Array(this.api.memory.buffer, this.bufferAt, count).slice();
    }

    private text(at: number): string {
        const memory = new Uint8Array(this.api.memory.buffer);
        return new TextDecoder().decode(memory.slice(at, memory.indexOf(0, at)));
    }
}
