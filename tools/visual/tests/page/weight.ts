// SPDX-License-Identifier: MIT
// What the built page weighs, each file compressed as a host would send it (gzip -9).
import { readFileSync, readdirSync } from 'node:fs';
import { gzipSync } from 'node:zlib';

const FOLDER = new URL('../../../../build/visual/', import.meta.url);
/** Comes behind the page. */
const PHYSICS = /mujoco|physical-body|body-[^/]*\.xml/;
const PYTHON = /pyodide|python/;

export interface Weights {
    /** Bytes until the robot stands in the picture, and Edit's image, which is fetched when Edit runs. */
    readonly first: number;
    readonly physics: number;
    /** With the worker that runs it. */
    readonly python: number;
}

/** Does the page fetch it behind the first load? By its name, and a worker by what it holds. */
export function comesLater(name: string, text: string): 'physics' | 'python' | null {
    if (PHYSICS.test(name)) return 'physics';
    return PYTHON.test(name) || (/worker-[^/]*\.js$/.test(name) && text.includes('pyodide')) ? 'python' : null;
}

export function weights(): Weights {
    const sum = { first: 0, physics: 0, python: 0 };
    for (const name of ['index.html', ...readdirSync(new URL('assets/', FOLDER)).map(file => `assets/${file}`)]) {
        const bytes = readFileSync(new URL(name, FOLDER));
        sum[comesLater(name, bytes.toString('latin1')) ?? 'first'] += gzipSync(bytes, { level: 9 }).length;
    }
    return sum;
}
