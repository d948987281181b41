// SPDX-License-Identifier: MIT
// node node-trials.ts TRIALS.json: prints the result of each trial as one line of JSON. See test_same_physics.py.
import { readFile } from 'node:fs/promises';
import { AS_STORED, JOINTS } from '../../model/motion.ts';
import { makeMotion } from '../motion-bench.ts';
import { played, trialBench } from '../trial-bench.ts';

interface Asked {
    readonly image: string; // base64
    readonly page: number;
    readonly ticks: number;
    readonly volts: number;
}

const [trials] = process.argv.slice(2);
if (!trials) throw new Error('usage: node-trials.ts TRIALS.json');
const { stand } = await trialBench();
const motion = await makeMotion();
const results = (JSON.parse(await readFile(trials, 'utf8')) as Asked[]).map(({ image, page, ticks, volts }) => {
    const bytes = Uint8Array.from(Buffer.from(image, 'base64'));
    motion.pages.set(bytes);
    const pose = motion.firstPose(page, new Uint16Array(JOINTS).fill(512));
    const { fell, onFeet } = played(stand, { image: bytes, page, law: 'exact', shape: AS_STORED, pose, ticks, toTheEnd: true, volts });
    return { fellSeconds: fell ? fell.tick / 128 : null, onFeet };
});
console.log(JSON.stringify(results));
