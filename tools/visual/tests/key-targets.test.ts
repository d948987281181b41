// SPDX-License-Identifier: MIT
// The pages that keys lead to in the motion library, against the table in tools/motions/README.md.
import { readFile } from 'node:fs/promises';
import { beforeAll, expect, test } from 'vitest';
import { targetsFromRest, targetsFrom } from '../model/key-targets.ts';
import type { RobotPages, KeyTarget } from '../model/key-targets.ts';
import type { PageFormat } from '../model/page-format.ts';
import { libraryDocument, makeFormat } from './motion-bench.ts';

let format: PageFormat;
let pages: RobotPages;
beforeAll(async () => {
    ({ format } = await makeFormat());
    ({ pages } = await libraryDocument());
});

/** "U 3" as a code: the sum of its keys. */
const KEYS: Readonly<Record<string, number>> = { U: 1, D: 2, L: 4, R: 8, 1: 16, 2: 32, 3: 64, 4: 128 };
const code = (keys: string): number =>
    keys
        .split(' ')
        .filter(Boolean)
        .reduce((sum, key) => sum + (KEYS[key] ?? NaN), 0);
const words = (targets: readonly KeyTarget[]): string[] => targets.map(({ kind, name, code: by }) => `${kind} ${by} ${name}`).sort();

test('every row of the table: its keys, and its targets on', async () => {
    const text = await readFile(new URL('../../motions/README.md', import.meta.url), 'utf8');
    const rows = [...text.matchAll(/^\| (\d+) \| `(\w+)` \| ([UDLR1-4 ]*?) *\|[^|]*\|([^|]*)\|$/gm)];
    expect(rows.length).toBeGreaterThan(30);
    const calls = targetsFromRest(format, pages);
    for (const [, number, name, keys = '', onward = ''] of rows) {
        const page = Number(number);
        expect(
            calls.filter(target => target.page === page).map(target => target.code),
            name,
        ).toEqual(keys.trim() ? [code(keys.trim())] : []);
        const wanted = [...onward.matchAll(/(next|exit|[UDLR1-4 ]+:) `(\w+)`/g)].map(([, by = '', to = '']) => {
            const target = to === 'self' ? name : to;
            return by === 'next'
                ? `then 0 ${target}`
                : by === 'exit'
                  ? `stop 0 ${target}`
                  : `linked ${code(by.slice(0, -1).trim())} ${target}`;
        });
        expect(words(targetsFrom(format, pages, page)), name).toEqual(wanted.sort());
    }
});

test('of two pages with one code the lowest is called, as the firmware does; erased and damaged pages lead nowhere', () => {
    const walk = pages[20] ?? null;
    const twice = pages.map((bytes, page) => (page === 90 ? walk : bytes));
    expect(targetsFromRest(format, twice).find(target => target.code === 1)?.page).toBe(20);
    const damaged = pages.map((bytes, page) =>
        page === 20 && bytes ? Uint8Array.from(bytes, (byte, at) => (at === 100 ? byte ^ 1 : byte)) : bytes,
    );
    expect(targetsFromRest(format, damaged).some(target => target.code === 1)).toBe(false);
    expect(targetsFrom(format, damaged, 20)).toEqual([]);
    expect(targetsFrom(format, [], 20)).toEqual([]);
});
