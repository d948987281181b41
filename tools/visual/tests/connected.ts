// SPDX-License-Identifier: MIT
// The page's connection to a robot on the bench, with what it reports and what it is sent. Closed at the end of the test.
import { afterEach, expect } from 'vitest';
import { Connection } from '../robot/connection.ts';
import { RobotBench } from './robot-bench.ts';

const open: Connection[] = [];
afterEach(async () => {
    for (const connection of open.splice(0)) await connection.close();
});

export function connected(bench: RobotBench) {
    let text = '';
    const connection = new Connection(bench.port, bench.clock, {
        state: () => undefined,
        text: bytes => (text += new TextDecoder('latin1').decode(bytes)),
    });
    open.push(connection);
    connection.connect();
    return { connection, text: () => text, forget: () => (text = '') };
}

/** Edit, ready. sent: the requests sent from now on. */
export async function connectedEdit(seed: number) {
    const bench = await RobotBench.make('edit', seed);
    const sent: string[] = [];
    const { connection, text, forget } = connected(bench);
    for (let ms = 0; connection.state !== 'ready' && ms < 5000; ms += 50) await bench.run(50);
    expect(connection.state, `seed ${seed}`).toBe('ready');
    const send = bench.board.send.bind(bench.board);
    bench.board.send = (sender, bytes) => {
        sent.push(new TextDecoder().decode(bytes));
        send(sender, bytes);
    };
    return { bench, connection, sent, text, forget };
}
