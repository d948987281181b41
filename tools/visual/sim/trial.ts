// SPDX-License-Identifier: MIT
// Plays one motion in physics, as fast as possible: the firmware's player and the virtual servos (trial.wasm) on their own body. The robot
// on display is not affected. board/trial_api.h documents the functions.

import { jointAngle } from '../model/body.ts';
import type { Body } from '../model/body.ts';
import { LINK_CODE_STOP, TRIAL_API_IMAGE_BYTES as IMAGE_BYTES } from '../model/facts.ts';
import { JOINTS, LAW_OF, TICKS_PER_SECOND } from '../model/motion.ts';
import { length, rotate, subtract } from '../model/space.ts';
import type { Place, Vector } from '../model/space.ts';
import type { TrialMoment, TrialRecord, TrialRequest } from '../model/trial.ts';
import { SHAFT_FIELDS } from './board.ts';
import type { ShaftBody } from './board.ts';
import type { PhysicalBody } from './physical-body.ts';
import { wasiImports } from './wasi.ts';

/** Ticks to stand in the first pose before the play. */
const SETTLE_TICKS = 32;
/** After the play the robot is watched until its trunk tilts and sinks by less than this within 0.75 s, or for 6 s: who tips slowly has
 *  not fallen yet. */
const STILL_TICKS = 96;
const STILL_RAD = 0.001;
const STILL_M = 0.0005;
const MOST_AFTER_TICKS = 6 * TICKS_PER_SECOND;
/** Ticks that a motion may take to stop. */
const STOP_TICKS = 12 * TICKS_PER_SECOND;
/** Cosine of 60 degrees, as in the trials of tools/body. */
const FALLEN = 0.5;
/** Ticks between two chances to read messages: about 10 ms of computing. */
const TURN_TICKS = 16;

interface Exports {
    readonly memory: WebAssembly.Memory;
    _initialize(): void;
    trial_api_image(): number;
    trial_api_new(volts: number): number;
    trial_api_add_servo(id: number): number;
    trial_api_stand(): void;
    trial_api_shape(rate: number, amplitude: number, blend: number): number;
    trial_api_start(page: number, law: number): number;
    trial_api_keys(code: number): void;
    trial_api_run(ticks: number): number;
    trial_api_page(): number;
    trial_api_step(): number;
    trial_api_positions(): number;
}

/** The state of a running trial. */
class Play {
    readonly positions: Float32Array;
    readonly pages = new Set<number>();
    /** Ticks since the start, and how many of them are recorded. */
    passed = 0;
    ticks = 0;
    isOn = false;
    now: TrialMoment;
    fell: TrialMoment | null = null;

    constructor({ page, ticks }: TrialRequest) {
        this.positions = new Float32Array(ticks * JOINTS).fill(NaN);
        this.now = { tick: 0, page, step: 0 };
    }
}

/** Runs trials, one at a time. */
export class TrialStand {
    private readonly api: Exports;
    private readonly body: Body;
    private readonly physical: PhysicalBody;

    private constructor(api: Exports, body: Body, physical: PhysicalBody) {
        this.api = api;
        this.body = body;
        this.physical = physical;
    }

    /** module: trial.wasm; physical: used by trials only. */
    static async make(module: WebAssembly.Module, body: Body, physical: PhysicalBody): Promise<TrialStand> {
        const exportsOf = (): Exports => instance.exports as unknown as Exports; // trial_api.h; tests/trial.test.ts calls all
        const pass = (call: keyof ShaftBody) => (at: number, count: number) =>
            physical[call](new Float64Array(exportsOf().memory.buffer, at, count * SHAFT_FIELDS));
        const instance: WebAssembly.Instance = await WebAssembly.instantiate(module, {
            ...wasiImports(() => exportsOf().memory),
            body: { look: pass('look'), step: pass('step') },
        });
        exportsOf()._initialize();
        return new TrialStand(exportsOf(), body, physical);
    }

    /** Plays a motion. Yields regularly with the number of ticks done. Throws if the page cannot be played. */
    *play(request: TrialRequest): Generator<number, TrialRecord> {
        const { api } = this;
        const play = this.begin(request);
        const stood = this.settle(request);
        if (stood) this.start(play, request);
        const limit = request.ticks + (request.toTheEnd ? STOP_TICKS : 0);
        for (let done = 1; play.isOn && done <= limit; done++) {
            if (done > request.ticks) api.trial_api_keys(LINK_CODE_STOP);
            this.tick(play, done <= request.ticks);
            if (done % TURN_TICKS === 0) yield Math.min(done, request.ticks);
        }
        for (let after = 0, isStill = !stood || !request.toTheEnd; !isStill && after < MOST_AFTER_TICKS; after += STILL_TICKS) {
            isStill = this.isStill(play);
            yield request.ticks;
        }
        const { ticks, positions, pages, fell } = play;
        return {
            stood,
            ticks,
            positions: positions.slice(0, ticks * JOINTS),
            pages: [...pages],
            fell,
            ended: !play.isOn,
            onFeet: stood && this.physical.isOnItsFeet,
        };
    }

    private begin(request: TrialRequest): Play {
        const { api } = this;
        if (request.image.length !== IMAGE_BYTES)
            throw new RangeError(`an image of motions has ${IMAGE_BYTES} bytes, not ${request.image.length}`);
        new Uint8Array(api.memory.buffer, api.trial_api_image(), IMAGE_BYTES).set(request.image);
        if (!api.trial_api_new(request.volts)) throw new Error('no memory for a trial');
        for (const { servo } of this.body.joints)
            if (!api.trial_api_add_servo(servo)) throw new Error(`servo ${servo} cannot be plugged in`);
        const { rate, amplitude, blend } = request.shape;
        if (!api.trial_api_shape(rate, amplitude, blend)) throw new RangeError(`no shape: ${rate} ${amplitude} ${blend}`);
        return new Play(request);
    }

    /** Puts the robot on its soles in the first pose. false: it does not stay upright. */
    private settle({ pose }: TrialRequest): boolean {
        const joints = new Map(this.body.joints.map(joint => [joint.servo, joint]));
        this.physical.begin(servo => {
            const joint = joints.get(servo);
            return joint ? jointAngle(joint, pose[servo] ?? joint.zero) : 0;
        }, this.body);
        this.api.trial_api_stand();
        this.api.trial_api_run(SETTLE_TICKS);
        return this.physical.upright > FALLEN;
    }

    private start(play: Play, { page, law }: TrialRequest): void {
        const status = this.api.trial_api_start(page, LAW_OF[law]);
        if (status !== 0) throw new Error(`page ${page} cannot be played (${status})`);
        play.isOn = true;
    }

    private tick(play: Play, isNoted: boolean): void {
        const { api } = this;
        play.isOn = api.trial_api_run(1) !== 0;
        const page = api.trial_api_page();
        if (page > 0) play.now = { tick: play.passed, page, step: api.trial_api_step() - 1 };
        if (page > 0) play.pages.add(page);
        if (isNoted) this.notePositions(play);
        if (this.physical.upright < FALLEN) play.fell ??= play.now;
        play.passed++;
    }

    /** Watches the robot for STILL_TICKS. */
    private isStill(play: Play): boolean {
        const up = (trunk: Place): Vector => rotate(trunk.quat, [0, 0, 1]);
        const before = this.physical.trunk;
        for (let i = 0; i < STILL_TICKS; i++) this.tick(play, false);
        const { trunk } = this.physical;
        return length(subtract(up(trunk), up(before))) < STILL_RAD && Math.abs(trunk.pos[2] - before.pos[2]) < STILL_M;
    }

    private notePositions(play: Play): void {
        const { joints } = this.body;
        const from = play.ticks++ * JOINTS;
        const positions = new Float64Array(this.api.memory.buffer, this.api.trial_api_positions(), joints.length);
        for (const [i, { servo }] of joints.entries()) play.positions[from + servo] = positions[i] ?? NaN;
    }
}
