// SPDX-License-Identifier: MIT
// The check of types goes by contents: files that are older than the last check, as in a build directory that was copied, are checked.
import { execFileSync } from 'node:child_process';
import { chmodSync, copyFileSync, mkdirSync, mkdtempSync, rmSync, utimesSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { expect, test } from 'vitest';

const HERE = new URL('..', import.meta.url).pathname;
const TSC = join(HERE, 'node_modules/.bin/tsc');

/** A checkout with one file, which is older than everything else. */
function checkout() {
    const root = mkdtempSync(join(tmpdir(), 'types-'));
    const visual = join(root, 'tools/visual');
    for (const folder of [visual, join(root, 'build/wasm'), join(root, 'bin')]) mkdirSync(folder, { recursive: true });
    copyFileSync(join(HERE, 'types'), join(visual, 'types'));
    writeFileSync(join(root, 'build/wasm/facts.ts'), '');
    writeFileSync(join(visual, 'node.sh'), `PATH=${root}/bin:$PATH\n`);
    const compilerOptions = { composite: true, rootDir: '.', outDir: '../../build/visual-types', types: [] };
    writeFileSync(join(visual, 'tsconfig.json'), JSON.stringify({ compilerOptions, files: ['one.ts'] }));
    const npx = join(root, 'bin/npx');
    const useCompiler = (line: string): void => {
        writeFileSync(npx, `#!/bin/sh\n${line}\n`);
        chmodSync(npx, 0o755);
    };
    useCompiler(`shift; exec "${TSC}" "$@"`);
    return {
        useCompiler,
        write: (text: string): void => {
            writeFileSync(join(visual, 'one.ts'), text);
            utimesSync(join(visual, 'one.ts'), new Date('2001-01-01'), new Date('2001-01-01'));
        },
        check: (): string => {
            try {
                return execFileSync(join(visual, 'types'), { encoding: 'utf8' });
            } catch (error) {
                return `failed: ${(error as { stdout: string }).stdout}`;
            }
        },
        remove: (): void => rmSync(root, { recursive: true }),
    };
}

test('files that are older than their types, but others', () => {
    const { write, check, useCompiler, remove } = checkout();
    write('export const one: number = 1;');
    expect(check()).toBe('');
    write("export const one: number = '1';");
    expect(check()).toMatch(/^failed: .*error TS2322/s);
    expect(check()).toMatch(/^failed: .*error TS2322/s); // a failure is not remembered as right
    write('export const one: number = 2;');
    expect(check()).toBe('');
    useCompiler('exit 1');
    expect(check()).toBe(''); // nothing has changed
    write('export const one: number = 3;');
    expect(check()).toMatch(/^failed/);
    remove();
});
