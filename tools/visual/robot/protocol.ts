// SPDX-License-Identifier: MIT
// The requests of firmware/common/PROTOCOL.md as functions. Each rejects as Requests.ask() does, and with RobotError 'foreign' if an answer
// does not follow the protocol.

import { JOINTS, PAGE_BYTES } from '../model/motion.ts';
import type { Shape } from '../model/motion.ts';
import { bytesOfHex } from './hex.ts';
import type { RequestOptions, Requests } from './requests.ts';
import { RobotError } from './robot-error.ts';

/** The answer to `@ver`. */
export interface Version {
    readonly image: string; // "play", "edit"
    readonly version: string; // "1.0.0"; empty for an image without a record
    readonly board: string; // "cm5", "cm2"; "cm5" for an image without a record
    readonly protocol: number;
    /** Its abilities: list, page, pose, ... */
    readonly can: ReadonlySet<string>;
}

export type PlayState = 'idle' | 'ready' | 'approach' | 'paused' | 'playing';

/** The answer to `@where`. */
export interface Where {
    readonly state: PlayState;
    readonly page: number;
    readonly step: number;
    readonly repetition: number;
    readonly code: number;
    readonly batteryVolts: number;
    /** Bit per servo ID. */
    readonly faulty: number;
    /** Joints moved by code (`@aim`, `@swing`), with or without a play. Bit per servo ID. */
    readonly aimed: number;
    /** Shape of the plays, in percent. null: Edit has none, or its amplitudes differ by joint. */
    readonly shape: Shape | null;
    /** All fields by name: later versions report more. */
    readonly fields: ReadonlyMap<string, string>;
}

export interface JointPose {
    readonly id: number;
    /** Servo units; null if the servo does not answer. */
    readonly position: number | null;
    readonly torque: boolean;
}

export interface PageEntry {
    readonly page: number;
    readonly name: string;
    /** 0 for a damaged page; `fault` names the fault. */
    readonly steps: number;
    readonly fault: string;
}

export const PROTOCOL = 1;
const STATES: readonly string[] = ['idle', 'ready', 'approach', 'paused', 'playing'];
const LIST_MS = 4000;
const PAGE_MS = 2000;
const MOVES: RequestOptions = { moves: true };
const TRIES = 3;

function fields(answer: string): Map<string, string> {
    return new Map(
        answer
            .split(' ')
            .filter(Boolean)
            .map(word => {
                const equals = word.indexOf('=');
                return equals < 0 ? ([word, ''] as const) : ([word.slice(0, equals), word.slice(equals + 1)] as const);
            }),
    );
}

/** The servo IDs of a field with a bit per ID. */
export function idsIn(bits: number): number[] {
    return Array.from({ length: JOINTS }, (_, id) => id).filter(id => (bits >>> id) & 1);
}

function strange(request: string, answer: string): RobotError {
    return new RobotError('foreign', `${request}: ${answer.slice(0, 60)}`);
}

export async function askVersion(requests: Requests, options?: RequestOptions): Promise<Version> {
    const answer = await requests.ask('@ver', options);
    const values = fields(answer);
    const image = values.get('image');
    if (!image) throw strange('@ver', answer);
    return {
        image,
        version: values.get('version') ?? '',
        board: values.get('board') ?? 'cm5',
        protocol: Number(values.get('protocol') ?? 0),
        can: new Set((values.get('can') ?? '').split(',')),
    };
}

/** An amplitude of more than three digits is a list, one of each joint. */
function shapeOf(values: ReadonlyMap<string, string>): Shape | null {
    const [rate, amplitude, blend] = ['rate', 'amplitude', 'blend'].map(name => values.get(name));
    if (!rate || !amplitude || !blend || amplitude.length > 3) return null;
    return { rate: Number(rate), amplitude: Number(amplitude), blend: Number(blend) };
}

export async function askWhere(requests: Requests, options?: RequestOptions): Promise<Where> {
    const answer = await requests.ask('@where', options);
    const values = fields(answer);
    const number = (name: string): number => Number(values.get(name) ?? 0);
    const state = values.get('state') ?? '';
    if (!STATES.includes(state)) throw strange('@where', answer);
    return {
        state: state as PlayState,
        page: number('page'),
        step: number('step'),
        repetition: number('repetition'),
        code: number('code'),
        batteryVolts: number('dv') / 10,
        faulty: Number.parseInt(values.get('faulty') ?? '0', 16),
        aimed: Number.parseInt(values.get('aim') ?? '0', 16),
        shape: shapeOf(values),
        fields: values,
    };
}

/** A play or a move, or joints moved by code. null: not known. */
export function isMoving(where: Where | null): boolean {
    return where !== null && ((where.state !== 'idle' && where.state !== 'paused') || where.aimed > 0);
}

export async function askPose(requests: Requests, options?: RequestOptions): Promise<JointPose[]> {
    const answer = await requests.ask('@pose', options);
    return answer
        .split(' ')
        .filter(Boolean)
        .map(word => {
            const match = /^(\d+):(\d+|\?):([01])$/.exec(word);
            if (!match) throw strange('@pose', answer);
            return { id: Number(match[1]), position: match[2] === '?' ? null : Number(match[2]), torque: match[3] === '1' };
        });
}

/** An answer without a checksum: asks until two in a row are the same. Both are in the queue at once, before what is asked later. */
export async function askTwice(requests: Pick<Requests, 'ask'>, text: string, options: RequestOptions): Promise<string> {
    for (let tries = 1; tries <= TRIES; tries++) {
        const [answer, again] = await Promise.all([requests.ask(text, options), requests.ask(text, options)]);
        if (answer === again) return answer;
    }
    throw strange(text, 'no two answers are the same');
}

/** isExact: no cable is between, which might damage a digit. */
export async function askList(requests: Requests, isExact = false): Promise<PageEntry[]> {
    const options = { timeoutMs: LIST_MS };
    const answer = await (isExact ? requests.ask('@list', options) : askTwice(requests, '@list', options));
    return Array.from(answer.matchAll(/(\d+):(\d+|!):"([^"]*)"/g), match => {
        const damaged = match[2] === '!';
        const words = match[3] ?? '';
        return { page: Number(match[1]), steps: damaged ? 0 : Number(match[2]), name: damaged ? '' : words, fault: damaged ? words : '' };
    });
}

/** The CRC-16 of a page: PageFormat.crc. */
export type PageCrc = (page: Uint8Array) => number;

/** The 512 bytes of a page, checked by their CRC. */
export function askPage(requests: Pick<Requests, 'ask'>, page: number, crcOf: PageCrc, options?: RequestOptions): Promise<Uint8Array> {
    return readWhole(requests, `@page ${page}`, crcOf, bytesOfHex, options);
}

/** Like askPage() in two thirds of the time. An older image refuses with ERR 1. */
export function askDensePage(requests: Requests, page: number, crcOf: PageCrc, options?: RequestOptions): Promise<Uint8Array> {
    return readWhole(requests, `@dense ${page}`, crcOf, fromDense, options);
}

async function readWhole(
    requests: Pick<Requests, 'ask'>,
    request: string,
    crcOf: PageCrc,
    decode: (text: string) => Uint8Array,
    options: RequestOptions = {},
): Promise<Uint8Array> {
    const answer = await requests.ask(request, { timeoutMs: PAGE_MS, ...options });
    const [word = '', page] = request.split(' ');
    const [number, text = '', crc = ''] = answer.split(' ');
    if (Number(number) !== Number(page)) throw strange(word, answer);
    const bytes = decode(text);
    if (bytes.length !== PAGE_BYTES || crcOf(bytes) !== Number.parseInt(crc, 16)) throw strange(word, 'the CRC does not fit');
    return bytes;
}

const SIX_BITS = 0x30;

/** Six bits per character. Each group has the low six bits of its bytes (two in the first group, then three) and a character with their
 *  high bits, those of the last byte on top. */
function fromDense(text: string): Uint8Array {
    const sixes = Array.from(text, letter => letter.charCodeAt(0) - SIX_BITS);
    const made: number[] = [];
    for (let at = 0, count = 2; at < sixes.length; at += count + 1, count = 3) {
        const high = sixes[at + count] ?? 0;
        for (const [i, low] of sixes.slice(at, at + count).entries()) made.push(low | (((high >> (2 * (i + 3 - count))) & 3) << 6));
    }
    return Uint8Array.from(made);
}

export async function play(requests: Requests, page: number, code = 0): Promise<void> {
    await requests.ask(code ? `@play ${page} ${code}` : `@play ${page}`, MOVES);
}

/** Shapes the play from the next step on: blend -100..100 (left..right), rate 10..400 %, amplitude 0..150 %. Repeat it within a second, or
 *  the robot ends the play by itself. */
export async function drive(requests: Requests, blend: number, rate: number, amplitude: number): Promise<void> {
    await requests.ask(`@drive ${blend} ${rate} ${amplitude}`, MOVES);
}

export type Command = 'stop' | 'break' | 'pause' | 'resume' | 'reset';

export async function command(requests: Requests, what: Command): Promise<void> {
    await requests.ask(`@${what}`, { stops: what === 'stop' || what === 'break', moves: what === 'resume' });
}

/** No IDs: all servos. */
export async function setTorque(requests: Requests, on: boolean, ids: readonly number[] = []): Promise<void> {
    await requests.ask(['@torque', on ? 'on' : 'off', ...ids].join(' '), { timeoutMs: PAGE_MS, moves: on });
}

/** Moves slowly to a pose, ramped, at most `degreesPerSecond` (1..360). positions: servo units by ID; null: the joint stays as it is.
 *  Refused with ERR 4 while something moves. */
export async function movePose(requests: Requests, degreesPerSecond: number, positions: readonly (number | null)[]): Promise<void> {
    const first = positions.findIndex(position => position !== null);
    if (first < 0) return;
    const last = positions.findLastIndex(position => position !== null);
    const digits = positions
        .slice(first, last + 1)
        .map(position => (position === null ? '---' : position.toString(16).padStart(3, '0').toUpperCase()));
    await requests.ask(`@move ${degreesPerSecond} ${first} ${digits.join('')}`, MOVES);
}

/** ERR numbers of PROTOCOL.md that the code reacts to. */
export const REFUSED = { noCommand: 1, busy: 4, torqueOff: 8, notHere: 10 } as const;

/** Sets the speed of the play in percent (10..400). Only Play. */
export async function setRate(requests: Requests, percent: number): Promise<void> {
    await requests.ask(`@rate ${percent}`);
}

/** Sets the size about the centre pose in percent (0..150), for these joints or all. */
export async function setAmplitude(requests: Requests, percent: number, ids: readonly number[] = []): Promise<void> {
    await requests.ask(['@amplitude', percent, ...ids].join(' '));
}

/** Blends towards the partner page: right 1..100, left -1..-100. */
export async function setBlend(requests: Requests, percent: number): Promise<void> {
    await requests.ask(`@blend ${percent}`);
}

/** Plays a second page over the play, on these joints or those of its first step; null ends it. Only Play has layers. */
export async function setLayer(requests: Requests, page: number | null, ids: readonly number[] = []): Promise<void> {
    await requests.ask(page === null ? '@layer off' : ['@layer', page, ...ids].join(' '), { moves: page !== null });
}

/** Moves a joint to a position (servo units) at a limited speed (1..360) and holds it there. */
export async function aim(requests: Requests, id: number, position: number, degreesPerSecond: number): Promise<void> {
    await requests.ask(`@aim ${id} ${position} ${degreesPerSecond}`, MOVES);
}

/** Swings a joint about a centre: servo units, a period of 125..30000 ms. */
export async function swing(requests: Requests, id: number, centre: number, amplitude: number, periodMs: number): Promise<void> {
    await requests.ask(`@swing ${id} ${centre} ${amplitude} ${periodMs}`, MOVES);
}

/** Returns these joints, or all, to the play. Without a play they stay where they are. */
export async function free(requests: Requests, ids: readonly number[] = []): Promise<void> {
    await requests.ask(['@free', ...ids].join(' '));
}

/** Resets all shaping to the stored values. */
export async function resetShape(requests: Requests): Promise<void> {
    await requests.ask('@shape reset');
}
