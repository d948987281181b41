// SPDX-License-Identifier: MIT
// The goals that Play sends to the servos of the simulated board. My servos must receive the same.
import { CYCLES_PER_MS, CYCLES_PER_TICK } from '../sim/board.ts';
import { SERVO_IDS, makeMachine } from '../sim/machine.ts';
import { robotImages, wasmModule } from './robot-bench.ts';

/** The goals of all servos after each SYNC WRITE; -1: none yet. */
export function posesOf(frames: readonly ReadonlyMap<number, number>[]): number[][] {
    const pose = new Map<number, number>();
    return frames.map(frame => {
        for (const [id, goal] of frame) pose.set(id, goal);
        return SERVO_IDS.map(id => pose.get(id) ?? -1);
    });
}

/** All goals of the servos after each frame, without consecutive duplicates. */
export function distinct(poses: readonly (readonly number[])[]): string[] {
    return poses.map(pose => pose.join(' ')).filter((pose, i, all) => pose !== all[i - 1]);
}

/** The goals of the board while it plays this motion. */
export async function goalsOfBoard(motion: string): Promise<string[]> {
    const board = await makeMachine(await wasmModule('board'), await robotImages('play'), null);
    const poses: number[][] = [];
    let text = '';
    const run = (what: () => boolean): void => {
        for (let ticks = 0; !what(); ticks++) {
            if (ticks > 10_000) throw new Error(`it did not come; the board says:\n${text}`);
            if (!board.runTo(board.nowCycles + CYCLES_PER_TICK / 4)) throw new Error(board.violation?.text);
            text += new TextDecoder('latin1').decode(board.receive());
            poses.push(board.servos().map(servo => servo.goalPos));
        }
    };
    board.setPower(true);
    run(() => text.includes('18 servos: 1-18'));
    board.runTo(board.nowCycles + 300 * CYCLES_PER_MS);
    poses.length = 0;
    const from = text.length;
    board.send('pc', new TextEncoder().encode(`play ${motion}\r`));
    run(() => text.includes('Ended', from));
    return distinct(poses);
}
