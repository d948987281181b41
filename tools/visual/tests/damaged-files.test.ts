// SPDX-License-Identifier: MIT
// Damaged, hostile and strange files: every file that m512's own tests read (recorded by m512_cases.py during those tests), opened in the
// page. CASES=all: all of them (minutes); otherwise one for each kind of answer.
import { execFile } from 'node:child_process';
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { promisify } from 'node:util';
import { loadPyodide } from 'pyodide';
import { expect, test } from 'vitest';
import { DocumentEditor } from '../app/editor.ts';
import { DocumentFiles } from '../app/files.ts';
import { LOCK } from '../files/lock.ts';
import { PythonFormats } from '../files/python-formats.ts';
import type { Body } from '../model/body.ts';
import { imageOf } from '../model/document.ts';
import { libraryDocument, makeFormat, makeMotion } from './motion-bench.ts';

const ROOT = new URL('../../../', import.meta.url).pathname;
const body = JSON.parse(readFileSync(`${ROOT}build/wasm/body.json`, 'utf8')) as Body;
const how = process.env.CASES === 'all' ? 'all' : 'quick';

/** The result of m512 for a file on this computer. */
interface Case {
    readonly test: string;
    readonly name: string;
    /** base64 */
    readonly data: string;
    readonly error?: string;
    readonly no_room?: string;
    readonly sha256?: string;
    readonly is_empty?: boolean;
    readonly notes?: readonly string[];
    readonly losses?: readonly string[];
}

async function recorded(): Promise<{ cases: Case[]; counts: { tests: number; files: number; refused: number } }> {
    const { stdout } = await promisify(execFile)(`${ROOT}build/venv/bin/python`, [`${ROOT}tools/visual/tests/m512_cases.py`, how], {
        maxBuffer: 1 << 30,
    });
    const lines = stdout
        .trim()
        .split('\n')
        .map(line => JSON.parse(line) as unknown);
    return { counts: lines.pop() as { tests: number; files: number; refused: number }, cases: lines as Case[] };
}

async function openPage() {
    const { format } = await makeFormat();
    const formats = new PythonFormats(await loadPyodide({ stdLibURL: `${ROOT}build/wasm/python.zip`, lockFileContents: LOCK }));
    const parts = { format, player: await makeMotion(), document: await libraryDocument() };
    const editor = new DocumentEditor(body, parts, { changed: () => undefined, refused: () => undefined, opened: () => undefined });
    return { editor, files: new DocumentFiles(editor, formats, { cancel: () => undefined, create: () => Promise.resolve() }) };
}

/** Why another file cannot be read depends on the place: a page has no folder. */
function withoutReason(sentence: string): string {
    return sentence.replace(/(: cannot read [^:]+): .*/, '$1');
}

test("every file of m512's tests: the same image, or one sentence that names file and fault; the document stays as it is", async () => {
    const [{ cases, counts }, { editor, files }] = await Promise.all([recorded(), openPage()]);
    const { document, history } = editor.state.get();
    const before = Buffer.from(imageOf(document));
    for (const { test: from, name, data, error, no_room, sha256, is_empty, notes, losses } of cases) {
        const where = `${from}: ${name}, ${data.slice(0, 60)}`;
        await files.open(name, new Uint8Array(Buffer.from(data, 'base64')));
        const { opened, tooLarge, trouble, busy } = files.state.get();
        expect(busy, where).toBeNull();
        if (error !== undefined) {
            expect(withoutReason(trouble ?? ''), where).toBe(withoutReason(error));
            expect(trouble, where).toContain(name);
            expect(trouble?.length, where).toBeLessThan(420);
            expect(trouble, where).not.toMatch(/\n|Traceback|^\w*Error\b/);
            expect([opened, tooLarge], where).toEqual([null, null]);
        } else if (no_room !== undefined) {
            expect([trouble, opened, tooLarge], where).toEqual([null, null, { name, pages: no_room }]);
        } else if (is_empty) {
            expect([trouble, opened], where).toEqual([`${name} holds no motions: all of them are empty. Nothing was changed.`, null]);
        } else {
            expect(trouble, where).toBeNull();
            expect(
                createHash('sha256')
                    .update(opened?.image ?? new Uint8Array())
                    .digest('hex'),
                where,
            ).toBe(sha256);
            expect([opened?.notes, opened?.losses], where).toEqual([notes, losses]);
        }
        expect(editor.state.get().document, where).toBe(document);
        expect(editor.state.get().history, where).toBe(history);
        files.dismiss();
    }
    expect(Buffer.from(imageOf(editor.state.get().document)).equals(before)).toBe(true);
    console.log(
        `${counts.tests} tests of m512 read ${counts.files} files; ${cases.length} of them opened in the page, ${counts.refused} refused (${how})`,
    );
    expect(counts.tests).toBeGreaterThan(150);
    expect(counts.refused).toBeGreaterThan(70);
    expect(cases.map(({ name }) => name)).toEqual(expect.arrayContaining(['case.bin', 'case.hex', 'case.mtn', 'case.m512']));
}, 1_800_000);
