// SPDX-License-Identifier: MIT
// Files through the page's Python and through m512 on this computer: the same bytes, losses and messages.
import { execFile } from 'node:child_process';
import { mkdtemp, readFile, readdir, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { promisify } from 'node:util';
import { loadPyodide } from 'pyodide';
import { afterAll, beforeAll, expect, onTestFinished, test, vi } from 'vitest';
import { LOCK } from '../files/lock.ts';
import { decodeMotion, encodeMotion } from '../files/motion-link.ts';
import { PythonFormats } from '../files/python-formats.ts';
import { SUFFIXES } from '../model/file-formats.ts';

const ROOT = new URL('../../../', import.meta.url).pathname;
const run = promisify(execFile);
let formats: PythonFormats;
let folder: string;

beforeAll(async () => {
    folder = await mkdtemp(join(tmpdir(), 'm512-files-'));
    formats = new PythonFormats(await loadPyodide({ stdLibURL: join(ROOT, 'build/wasm/python.zip'), lockFileContents: LOCK }));
});
afterAll(() => rm(folder, { recursive: true }));

interface Told {
    readonly notes: string[];
    readonly losses: string[];
}

/** Runs the m512 that is installed here. */
async function m512(...words: string[]): Promise<string> {
    return (await run(join(ROOT, 'build/venv/bin/python'), ['-m', 'm512', ...words], { cwd: folder })).stdout;
}

/** Converts the files of this folder to 0.bin, 1.bin ... in one process. Prints the exit code of each, and what was said. */
const CONVERT = `
import json, sys
from click.testing import CliRunner
from m512.cli import main
for number, path in enumerate(sys.argv[1:]):
    done = CliRunner().invoke(main, ["convert", path, f"{number}.bin"])
    print(json.dumps([done.exit_code, done.output]))
`;

async function library(): Promise<Uint8Array> {
    return new Uint8Array(await readFile(join(ROOT, 'build/motions/motions.bin')));
}

test.each(SUFFIXES)('our library as %s: written and read as m512 does', async suffix => {
    const image = await library();
    await writeFile(join(folder, 'library.bin'), image);
    const told = JSON.parse(await m512('convert', 'library.bin', `one${suffix}`, '--json')) as Told;
    const saved = await formats.save(`one${suffix}`, image);
    if (saved.kind !== 'saved') throw new Error(saved.text);
    expect(Buffer.from(saved.file).equals(await readFile(join(folder, `one${suffix}`)))).toBe(true);
    expect(saved.losses).toEqual(told.losses);

    const back = JSON.parse(await m512('convert', `one${suffix}`, `back${suffix}.bin`, '--json')) as Told;
    const opened = await formats.open(`one${suffix}`, saved.file);
    if (opened.kind !== 'opened') throw new Error(opened.kind);
    expect(Buffer.from(opened.image).equals(await readFile(join(folder, `back${suffix}.bin`)))).toBe(true);
    expect([opened.notes, opened.losses]).toEqual([back.notes, back.losses]);
});

test('a text that includes another file: what to do, because the page has no other', async () => {
    const text = new TextEncoder().encode('motion512 1\ninclude "body.m512"\n');
    expect(await formats.open('dance.m512', text)).toEqual({
        kind: 'refused',
        text: expect.stringMatching(/^dance\.m512:2: cannot read body\.m512: .*m512 convert dance\.m512 dance\.bin/),
    });
});

/** A file as it is found, cut in the middle, with a byte changed, one more behind it; a text without its mark, with other line ends, and
 *  without its checksum. */
function damagedToo(name: string, file: Buffer): (readonly [string, Buffer])[] {
    const changed = Buffer.from(file);
    changed[file.length >> 1] = (changed[file.length >> 1] ?? 0) ^ 0x11;
    return [
        [name, file],
        [`cut-${name}`, file.subarray(0, file.length >> 1)],
        [`changed-${name}`, changed],
        [`longer-${name}`, Buffer.concat([file, Buffer.of(0x41)])],
        ...(name.endsWith('.mtn')
            ? ([
                  [`plain-${name}`, file.subarray(3)],
                  [`dos-${name}`, Buffer.from(file.toString('latin1').replaceAll('\n', '\r\n'), 'latin1')],
                  [`open-${name}`, file.subarray(0, -2)],
              ] as const)
            : []),
    ];
}

test('files as they are found, those of others where they are there, and all of them damaged: the same image or sentence as from m512', async () => {
    const samples = join(ROOT, 'tests/samples');
    const folders = [samples, join(process.env.M512_SHARED ?? join(ROOT, '../shared'), 'data')];
    const lists = await Promise.all(folders.map(async data => (await readdir(data).catch(() => [])).map(name => join(data, name))));
    const paths = lists.flat().filter(path => /\.(mtn|bin|hex)$/.test(path));
    expect(paths.length).toBeGreaterThan(2);
    const files = (await Promise.all(paths.map(async path => damagedToo(basename(path), await readFile(path))))).flat();
    await Promise.all(files.map(([name, file]) => writeFile(join(folder, name), file)));
    const { stdout } = await run(join(ROOT, 'build/venv/bin/python'), ['-c', CONVERT, ...files.map(([name]) => name)], { cwd: folder });
    const told = stdout
        .trim()
        .split('\n')
        .map(line => JSON.parse(line) as [number, string]);
    expect(told).toHaveLength(files.length);
    let refused = 0;
    for (const [number, [name, file]] of files.entries()) {
        const [code, said] = told[number] ?? [];
        const opened = await formats.open(name, new Uint8Array(file));
        if (opened.kind === 'refused') {
            refused++;
            expect(said, name).toContain(opened.text.split(' … ')[0]); // a long sentence is cut in the page
        } else if (opened.kind === 'opened' && code === 0 && !opened.notes.some(note => note.includes('scaled'))) {
            const bytes = await readFile(join(folder, `${number}.bin`));
            expect(Buffer.from(opened.image).equals(bytes.subarray(0, 65536)) || bytes.length !== 65536, name).toBe(true);
            for (const note of opened.notes) expect(said, name).toContain(note);
        }
    }
    expect(refused).toBeGreaterThan(4);
});

test("a damaged file is refused with m512's sentence", async () => {
    const hex = new TextEncoder().encode(':10E00000');
    expect(await formats.open('x.hex', hex)).toEqual({ kind: 'refused', text: expect.stringContaining('end record is missing') });
    expect(await formats.open('x.txt', new Uint8Array(3))).toEqual({ kind: 'refused', text: expect.stringContaining('x.txt') });
    expect(await formats.save('x.doc', await library())).toEqual({ kind: 'refused', text: expect.stringContaining('suffix') });
});

test('pages of a larger board are asked about, never lost in silence', async () => {
    const image = await library();
    const large = new Uint8Array(131072);
    large.set(image);
    for (let page = 128; page < 256; page++) large.set(image.subarray(5 * 512, 6 * 512), page * 512);
    expect(await formats.open('large.bin', large)).toEqual({ kind: 'no-room', pages: 'pages 128..255' });
    const opened = await formats.open('large.bin', large, true);
    expect(opened.kind === 'opened' && opened.losses.join()).toContain('128..255');
});

test('a file without page 0: motion n is motion n, and the trim is empty', async () => {
    const image = await library();
    await writeFile(join(folder, 'short.bin'), image.subarray(512));
    await m512('convert', 'short.bin', 'short.m512');
    for (const name of ['short.bin', 'short.m512']) {
        const opened = await formats.open(name, new Uint8Array(await readFile(join(folder, name))));
        if (opened.kind !== 'opened') throw new Error(opened.kind);
        expect(Buffer.from(opened.image).equals(image), name).toBe(true); // the library has no trim
        expect([opened.notes, opened.losses], name).toEqual([[], []]);
    }
});

test('checks and differences in the words of m512', async () => {
    const image = await library();
    const other = image.slice();
    other[7 * 512 + 100] = (other[7 * 512 + 100] ?? 0) ^ 1;
    await writeFile(join(folder, 'a.bin'), image);
    await writeFile(join(folder, 'b.bin'), other);
    const said = await m512('diff', 'a.bin', 'b.bin').catch((error: { stdout: string }) => error.stdout);
    expect((await formats.differences(image, other)).map(({ text }) => text).join('\n')).toBe(said.trim());
    const found = await m512('pages', 'b.bin', 'check', '--json').catch((error: { stdout: string }) => error.stdout);
    const wanted = (JSON.parse(found) as { page: number; problem?: string; note?: string }[]).map(({ page, problem, note }) => ({
        page,
        text: problem ?? note,
        isFault: problem !== undefined,
    }));
    expect(await formats.check(other)).toEqual(wanted);
});

test('motions in an address: there and back, and nothing of one that was cut or changed on its way', async () => {
    const image = await library();
    const pages = new Map([20, 21, 127].map(page => [page, image.slice(page * 512, (page + 1) * 512)]));
    const text = await encodeMotion(pages);
    expect(text).toMatch(/^[\w-]+$/);
    expect(await decodeMotion(text)).toEqual(pages);
    for (let length = 0; length < text.length; length += 7)
        expect(await decodeMotion(text.slice(0, length)), `cut at ${length}`).toBeNull();
    for (const strange of ['', '!', 'AAAA', btoa('no motion')]) expect(await decodeMotion(strange), strange).toBeNull();
});

test('a whole link with something behind it or before it, as mail programs and people leave it', async () => {
    const image = await library();
    const pages = new Map([[20, image.slice(20 * 512, 21 * 512)]]);
    const text = await encodeMotion(pages);
    for (const behind of ['=', '==', '%20', ' ', '&motion=x', '&utm_source=mail', '.', ')', '%3D', '>', '%0A', '?x=1', '/'])
        expect(await decodeMotion(text + behind), `behind it ${behind}`).toEqual(pages);
    for (const before of ['%20', ' ', '<']) expect(await decodeMotion(before + text), `before it ${before}`).toEqual(pages);
    expect(await decodeMotion(`${text.slice(0, 40)}%20${text.slice(40)}`), 'broken in the middle').toBeNull();
});

test('a link cannot fill the memory', async () => {
    let inflated = 0;
    const Real = DecompressionStream;
    vi.stubGlobal(
        'DecompressionStream',
        class {
            readonly writable: WritableStream;
            readonly readable: ReadableStream;

            constructor(format: CompressionFormat) {
                const real = new Real(format);
                const count = new TransformStream<Uint8Array, Uint8Array>({
                    transform(chunk, out) {
                        inflated += chunk.length;
                        out.enqueue(chunk);
                    },
                });
                this.writable = real.writable;
                this.readable = real.readable.pipeThrough(count);
            }
        },
    );
    onTestFinished(() => void vi.unstubAllGlobals());
    const bomb = new Blob([new Uint8Array(50_000_000)]).stream().pipeThrough(new CompressionStream('deflate-raw'));
    const packed = Buffer.from(await new Response(bomb).arrayBuffer()).toString('base64url');
    expect(packed.length).toBeLessThan(100_000);
    expect(await decodeMotion(packed)).toBeNull();
    await new Promise(resolve => setTimeout(resolve, 50)); // it must not continue after the answer
    expect(inflated).toBeGreaterThan(0);
    expect(inflated).toBeLessThan(1_000_000);
});
