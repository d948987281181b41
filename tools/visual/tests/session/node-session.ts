// SPDX-License-Identifier: MIT
// node node-session.ts BUILD SESSIONS.json: prints the hashes of all sessions as one line of JSON. See run-session.ts.

import { readFile } from 'node:fs/promises';
import { runSession } from './run-session.ts';
import type { Session } from './run-session.ts';

const [build, sessions] = process.argv.slice(2);
if (!build || !sessions) throw new Error('usage: node-session.ts BUILD SESSIONS.json');
const files = {
    board: await WebAssembly.compile(await readFile(`${build}/wasm/board.wasm`)),
    motions: new Uint8Array(await readFile(`${build}/motions/motions.bin`)),
    hex: (name: string) => readFile(`${build}/firmware/${name}.hex`, 'utf8'),
};
const results = [];
for (const session of JSON.parse(await readFile(sessions, 'utf8')) as Session[]) {
    results.push(await runSession(session, files));
}
console.log(JSON.stringify(results));
