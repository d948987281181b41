// SPDX-License-Identifier: MIT
// The weight of the built page, with each file compressed as a host would send it (gzip -9).
import { readFileSync, readdirSync } from 'node:fs';
import { gzipSync } from 'node:zlib';

const FOLDER = new URL('../../../../build/visual/', import.meta.url);
/** Loaded after the page. */
const PHYSICS = /mujoco|physical-body|body-[^/]*\.xml/;
const PYTHON = /pyodide|python/;
const SERVOS = /servos-/;
/** The texts of one language. */
const LANGUAGE = /\/(de|es|ja|ko|pseudo)-[^/]*\.js$/;

export interface Weights {
    /** Bytes until the robot stands in the picture, and Edit's image, which is loaded when Edit runs. */
    readonly first: number;
    readonly physics: number;
    /** Each with its worker. */
    readonly python: number;
    readonly servos: number;
    /** All languages except English. One is loaded when it is chosen. */
    readonly languages: number;
}

/** The part of the page that is loaded after the first load, by file name, or for a worker by its content. null: the first load. */
export function comesLater(name: string, text: string): 'physics' | 'python' | 'servos' | 'languages' | null {
    if (LANGUAGE.test(name)) return 'languages';
    if (PHYSICS.test(name)) return 'physics';
    const isWorker = /worker-[^/]*\.js$/.test(name);
    if (SERVOS.test(name) || (isWorker && text.includes('machine_bus_write'))) return 'servos';
    return PYTHON.test(name) || (isWorker && text.includes('pyodide')) ? 'python' : null;
}

export function weights(): Weights {
    const sum = { first: 0, physics: 0, python: 0, servos: 0, languages: 0 };
    for (const name of ['index.html', ...readdirSync(new URL('assets/', FOLDER)).map(file => `assets/${file}`)]) {
        const bytes = readFileSync(new URL(name, FOLDER));
        sum[comesLater(name, bytes.toString('latin1')) ?? 'first'] += gzipSync(bytes, { level: 9 }).length;
    }
    return sum;
}
