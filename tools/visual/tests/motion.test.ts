// SPDX-License-Identifier: MIT
// motion.wasm against the firmware on the simulated board, which sends the goals to its servos.
import { expect, test } from 'vitest';
import { Motion, PAGE_BYTES } from '../model/motion.ts';
import type { MotionExports } from '../model/motion.ts';
import { CYCLES_PER_MS, CYCLES_PER_TICK } from '../sim/board.ts';
import { RobotBench, randomNumbers, robotImages, wasmModule } from './robot-bench.ts';

async function motion(): Promise<Motion> {
    const instance = await WebAssembly.instantiate(await wasmModule('motion'), {});
    const made = new Motion(instance.exports as unknown as MotionExports);
    made.pages.set((await robotImages('play')).motions);
    return made;
}

test('pages of the library are good, and a changed byte is found', async () => {
    const player = await motion();
    const random = randomNumbers(5);
    for (const page of [1, 2, 20, 37]) {
        expect(player.check(page)).toBeNull();
        expect(player.isPlayable(page)).toBe(true);
        const bytes = player.page(page);
        const at = Math.floor(random() * PAGE_BYTES);
        bytes[at] = (bytes[at] ?? 0) ^ 0x21;
        player.setPage(page, bytes);
        expect(player.check(page), `page ${page} byte ${at}`).toBe('checksum');
    }
    player.clear(3);
    expect(player.check(3)).toBeNull();
    expect(player.isPlayable(3)).toBe(false);
    expect(() => player.check(128)).toThrow(RangeError);
});

test('a position half-way is rounded towards the second', async () => {
    const player = await motion();
    expect(player.positionBetween(512, 513)).toBe(513);
    expect(player.positionBetween(513, 512)).toBe(512);
    expect(player.positionBetween(0, 1023)).toBe(512);
    expect(player.positionBetween(1023, 0)).toBe(511);
    expect(player.positionBetween(400, 400)).toBe(400);
});

test('a time is shared, and nothing gets none', async () => {
    const player = await motion();
    const shares = [31, 255, 2, 1, 0].map(time => player.timeSplit(time));
    expect(shares.map(({ share, rest }) => [share, rest])).toEqual([
        [16, 15],
        [128, 127],
        [1, 1],
        [1, 1],
        [0, 0],
    ]);
});

test('a bow as it is drawn is the bow that the robot sends', async () => {
    const player = await motion();
    const bench = await RobotBench.make('play', 31);
    await bench.run(2000);
    bench.board.send('pc', new TextEncoder().encode('@play 2\r'));
    // Play decides the movement to the first pose. From the moment page 2 plays, the goals follow the motion law.
    const sent: number[] = [];
    for (let tick = 0; tick < 1300; tick++) {
        bench.board.runTo(bench.board.nowCycles + CYCLES_PER_TICK);
        sent.push(bench.board.servos()[10]?.goalPos ?? 0);
    }
    expect(bench.board.nowCycles).toBeGreaterThan(CYCLES_PER_MS);
    const first = player.firstPose(2, new Uint16Array(31).fill(512));
    expect(player.start(2, first, { joints: 0x7fffe })).toBe(true);
    const drawn = Array.from({ length: player.curve(4000).ticks }, (_, i) => i);
    player.start(2, first, { joints: 0x7fffe });
    const goals = player.curve(drawn.length).goals;
    const line = drawn.map(tick => goals[tick * 31 + 11] ?? 0);
    const turns = (values: readonly number[]): number[] => values.filter((value, i) => value !== values[i - 1]);
    const tail = turns(line).slice(5);
    expect(tail.length).toBeGreaterThan(100);
    expect(turns(sent).join(' ')).toContain(tail.slice(0, 100).join(' '));
});
