// SPDX-License-Identifier: MIT
// Imports point down only: model < robot < sim < servos; model < files; view uses model and robot; app and main.ts join them all.
import { readFileSync, readdirSync } from 'node:fs';
import { dirname, relative, resolve } from 'node:path';
import { expect, test } from 'vitest';

const ROOT = resolve(import.meta.dirname, '..');
const MAY: Readonly<Record<string, readonly string[]>> = {
    model: ['model'],
    robot: ['robot', 'model'],
    sim: ['sim', 'robot', 'model'],
    servos: ['servos', 'sim', 'robot', 'model'],
    files: ['files', 'model'],
    view: ['view', 'robot', 'model'],
    app: ['app', 'view', 'files', 'servos', 'sim', 'robot', 'model'],
};
/** Packages that a layer may use. All other imports are our own files. */
const PACKAGES: Readonly<Record<string, RegExp>> = {
    model: /^$/,
    robot: /^$/,
    sim: /^@mujoco\/mujoco$/,
    servos: /^$/,
    files: /^pyodide/,
    view: /^(three|@xterm|@dagrejs\/dagre$)/,
    app: /^$/,
};

/** File names in the folder and its subfolders. */
function sourcesIn(folder: string): string[] {
    return readdirSync(resolve(ROOT, folder), { recursive: true, encoding: 'utf8' }).filter(name => name.endsWith('.ts'));
}

function importsOf(source: string): string[] {
    return Array.from(source.matchAll(/\b(?:from|import)\s*\(?\s*'([^']+)'/g), match => match[1] ?? '');
}

function wrongImports(folder: string, file: string, source: string): string[] {
    return importsOf(source).filter(name => {
        if (!name.startsWith('.')) return !PACKAGES[folder]?.test(name);
        const to = relative(ROOT, resolve(dirname(file), name));
        if (to.startsWith('..')) return folder !== 'app' && relative(ROOT, file) !== 'model/facts.ts'; // build products: assets.ts, facts.ts
        return !MAY[folder]?.includes(to.split('/')[0] ?? '');
    });
}

test.each(Object.keys(MAY))('%s imports only what lies below it', folder => {
    const files = sourcesIn(folder);
    expect(files.length).toBeGreaterThan(0);
    const wrong = files.flatMap(name => {
        const file = resolve(ROOT, folder, name);
        return wrongImports(folder, file, readFileSync(file, 'utf8')).map(to => `${folder}/${name}: ${to}`);
    });
    expect(wrong).toEqual([]);
});

test('an import upwards is found', () => {
    const file = resolve(ROOT, 'model/x.ts');
    expect(wrongImports('model', file, "import { a } from '../robot/port.ts';")).toHaveLength(1);
    expect(wrongImports('robot', file, "import type { A } from '../view/session/session.ts';")).toHaveLength(1);
    expect(wrongImports('view', file, "const x = await import('../sim/worker.ts');")).toHaveLength(1);
    expect(wrongImports('model', file, "import * as THREE from 'three';")).toHaveLength(1);
});

test('no listing of ours uses document, window or storage below the view', () => {
    const browser = /\b(document\.(body|create|get|query|add|documentElement)|(window|localStorage|indexedDB)\b\.)/; // not a motion document
    for (const folder of ['model', 'robot', 'sim', 'servos', 'files']) {
        for (const name of sourcesIn(folder)) {
            expect(browser.test(readFileSync(resolve(ROOT, folder, name), 'utf8')), `${folder}/${name}`).toBe(false);
        }
    }
});
