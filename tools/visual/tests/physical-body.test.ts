// SPDX-License-Identifier: MIT
// The robot's body in MuJoCo, driven by the real firmware: what a hand does to it and what happens when the hand lets go. Expected is what
// a person sees: a stiff limb returns, no force remains, a lying robot gets up.
import { readFile } from 'node:fs/promises';
import { expect, test } from 'vitest';
import type { Body } from '../model/body.ts';
import { jointAngle, placeLinks } from '../model/body.ts';
import { add, liesOnFace, rotate } from '../model/space.ts';
import type { Vector } from '../model/space.ts';
import { makeMachine } from '../sim/machine.ts';
import { makeMujoco } from '../sim/mujoco.ts';
import { PhysicalBody } from '../sim/physical-body.ts';
import { Simulation } from '../sim/simulation.ts';
import { randomNumbers, robotImages, wasmModule } from './robot-bench.ts';

const SECOND = 128; // ticks
const BUILD = new URL('../../../build/', import.meta.url);
const MUJOCO = new URL('../node_modules/@mujoco/mujoco/mujoco.wasm', import.meta.url);

class StandingRobot {
    readonly simulation: Simulation;
    private readonly body: Body;
    private text = '';

    private constructor(simulation: Simulation, body: Body) {
        this.simulation = simulation;
        this.body = body;
    }

    /** A robot that stands by itself in the pose of page 1. */
    static async make(seed: number): Promise<StandingRobot> {
        const body = JSON.parse(await readFile(new URL('wasm/body.json', BUILD), 'utf8')) as Body;
        const robot = new StandingRobot(
            new Simulation(await makeMachine(await wasmModule('board'), await robotImages('play'), null, seed), body),
            body,
        );
        robot.simulation.board.setPower(true);
        robot.run(2 * SECOND);
        const mujoco = await makeMujoco(Uint8Array.from(await readFile(MUJOCO)).buffer);
        robot.simulation.setPhysical(new PhysicalBody(mujoco, await readFile(new URL('wasm/body.xml', BUILD), 'utf8'), body));
        robot.play(1);
        robot.simulation.setHeld(false);
        robot.run(SECOND);
        return robot;
    }

    run(ticks: number): void {
        for (let tick = 0; tick < ticks; tick++) {
            if (!this.simulation.runTick()) throw new Error(this.simulation.board.violation?.text);
            this.text += new TextDecoder().decode(this.simulation.board.receive());
        }
    }

    ask(request: string): string {
        this.text = '';
        this.simulation.board.send('pc', new TextEncoder().encode(`${request}\r`));
        this.run(16);
        return new RegExp(`^${request.split(' ')[0]} .*(OK|ERR.*)$`, 'm').exec(this.text)?.[0] ?? `no answer: ${this.text}`;
    }

    /** Plays a page to its end, at most 30 s. */
    play(page: number): void {
        expect(this.ask(`@play ${page}`)).toMatch(/OK$/);
        for (let tick = 0; tick < 30 * SECOND; tick += SECOND / 2) {
            this.run(SECOND / 2);
            if (/state=idle/.test(this.ask('@where'))) return;
        }
        throw new Error(`page ${page} did not end`);
    }

    page(name: string): number {
        return Number(new RegExp(`(\\d+):\\d+:"${name}"`).exec(this.ask('@list 0 30'))?.[1]);
    }

    get trunk() {
        return this.simulation.state(0).trunk;
    }

    position(servo: number): number {
        return this.simulation.state(0).servos.find(({ id }) => id === servo)?.position ?? NaN;
    }

    /** The place of a link's point in the room. */
    placeOf(link: string, point: Vector): Vector {
        const place = placeLinks(this.body, this.trunk, joint => jointAngle(joint, this.position(joint.servo))).get(link);
        if (!place) throw new Error(`no link ${link}`);
        return add(place.pos, rotate(place.quat, point));
    }
}

test('a stiff arm follows the hand a little, and goes back when the hand lets go; nothing pulls any more', async () => {
    const robot = await StandingRobot.make(1);
    const arm = (): number[] => [1, 3, 5].map(servo => robot.position(servo));
    const rest = arm();
    const point: Vector = [0, 0, -0.05];
    robot.simulation.setGrip({ link: 'right_forearm', point, target: add(robot.placeOf('right_forearm', point), [0.03, -0.01, 0.02]) });
    robot.run(SECOND);
    expect(Math.max(...arm().map((position, i) => Math.abs(position - (rest[i] ?? 0))))).toBeGreaterThan(5);
    robot.simulation.setGrip(null);
    robot.run(3 * SECOND);
    for (const [i, position] of arm().entries()) expect(position).toBeCloseTo(rest[i] ?? 0, -1);
    const there = robot.trunk.pos;
    robot.run(2 * SECOND);
    for (const [i, at] of robot.trunk.pos.entries()) expect(at).toBeCloseTo(there[i] ?? 0, 3); // within half a millimetre in 2 s
    expect(robot.simulation.hasFallen).toBe(false);
});

const random = randomNumbers(20261122);
test.each([
    ['ahead', 1],
    ['back', -1],
] as const)('pushed %s until it falls, it gets up by the page for the side it lies on', async (_, direction) => {
    const seed = Math.floor(random() * 1000);
    const robot = await StandingRobot.make(seed);
    robot.run(Math.floor(random() * SECOND));
    for (let push = 0; push < 12 && !robot.simulation.hasFallen; push++) {
        const [x, y, z] = robot.trunk.pos;
        robot.simulation.setGrip({ link: 'trunk', point: [0, 0, 0.03], target: [x + direction * 0.2, y, z + 0.03] }, 38);
        robot.run(SECOND);
    }
    expect(robot.simulation.hasFallen, `seed ${seed}`).toBe(true);
    robot.run(SECOND);
    expect(liesOnFace(robot.trunk), `seed ${seed}`).toBe(direction > 0);
    robot.play(robot.page(liesOnFace(robot.trunk) ? 'get_up' : 'get_up_back'));
    robot.run(SECOND);
    expect(robot.simulation.hasFallen, `seed ${seed}`).toBe(false);
});
