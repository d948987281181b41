// SPDX-License-Identifier: MIT
// A file that is too large, is unreadable, or whose reading is cancelled.
import { execFileSync } from 'node:child_process';
import { expect, test } from 'vitest';
import { DocumentEditor } from '../app/editor.ts';
import { DocumentFiles } from '../app/files.ts';
import { FormatsClient } from '../files/formats-client.ts';
import type { FromFiles, ToFiles } from '../files/messages.ts';
import { MOST_BYTES } from '../model/file-formats.ts';
import { BODY as body, libraryDocument, makeFormat, makeMotion } from './motion-bench.ts';
import { settle } from './robot-bench.ts';

const ROOT = new URL('../../../', import.meta.url).pathname;

/** A worker that receives no messages while it works, like Python. The test decides when it answers. */
class BusyWorker {
    static readonly all: BusyWorker[] = [];
    onmessage: ((event: { data: FromFiles }) => void) | null = null;
    onerror: ((event: { message: string }) => void) | null = null;
    isEnded = false;
    readonly asked: ToFiles[] = [];

    constructor() {
        BusyWorker.all.push(this);
    }

    postMessage(message: ToFiles): void {
        this.asked.push(message);
    }

    terminate(): void {
        this.isEnded = true;
    }

    answer(answer: unknown): void {
        const question = this.asked.findLast(message => message.kind === 'question');
        if (question?.kind === 'question') this.onmessage?.({ data: { kind: 'answer', id: question.id, answer } });
    }
}

async function openPage() {
    BusyWorker.all.length = 0;
    const { format } = await makeFormat();
    const client = new FormatsClient({ wasmUrl: '', libraryUrl: '' }, () => new BusyWorker() as unknown as Worker);
    const parts = { format, player: await makeMotion(), document: await libraryDocument() };
    const editor = new DocumentEditor(body, parts, { changed: () => undefined, refused: () => undefined, opened: () => undefined });
    return { client, editor, files: new DocumentFiles(editor, client, { cancel: () => client.cancel(), create: () => Promise.resolve() }) };
}

const last = (): BusyWorker => {
    const worker = BusyWorker.all.at(-1);
    if (!worker) throw new Error('no worker was started');
    return worker;
};

test('a reading is cancelled: its worker ends, nothing is said or changed, what else was asked is answered, and the next file is read', async () => {
    const { client, editor, files } = await openPage();
    const { document } = editor.state.get();
    const checked = client.check(new Uint8Array(65536));
    void files.choose(new File(['motion512 1'], 'long.m512'));
    await settle();
    expect(files.state.get().busy).toContain('long.m512');
    files.cancel();
    await settle();
    expect(files.state.get()).toMatchObject({ busy: null, trouble: null, opened: null });
    expect(BusyWorker.all.map(({ isEnded }) => isEnded)).toEqual([true, false]);
    last().answer([]);
    expect(await checked).toEqual([]);
    void files.choose(new File(['x'], 'next.m512'));
    await settle();
    expect(files.state.get().busy).toContain('next.m512');
    expect(editor.state.get().document).toBe(document);
});

test('a file that does not come is told from the press on, and once its reading is cancelled it is not opened when it comes', async () => {
    const { files } = await openPage();
    let come = (_: ArrayBuffer): void => undefined;
    const late = files.choose({ name: 'late.m512', size: 1, arrayBuffer: () => new Promise(resolve => (come = resolve)) });
    expect(files.state.get().busy).toContain('late.m512');
    files.cancel();
    expect(files.state.get().busy).toBeNull();
    come(new ArrayBuffer(1));
    await late;
    expect([files.state.get().busy, BusyWorker.all.flatMap(({ asked }) => asked)]).toEqual([null, []]);
});

test('without a reading there is nothing to cancel', async () => {
    const { files } = await openPage();
    files.cancel();
    expect(BusyWorker.all).toEqual([]);
});

test('a file that is too large is not read at all; m512 has the same bound', async () => {
    const { files } = await openPage();
    let isRead = false;
    const arrayBuffer = async (): Promise<ArrayBuffer> => {
        isRead = true;
        return new ArrayBuffer(1);
    };
    await files.choose({ name: 'film.mtn', size: MOST_BYTES + 1, arrayBuffer });
    expect(files.state.get().trouble).toMatch(/^film.mtn is larger than 4 MB/);
    expect([isRead, BusyWorker.all]).toEqual([false, []]);
    const bound = execFileSync(`${ROOT}build/venv/bin/python`, ['-c', 'from m512.files.storage import MOST_BYTES; print(MOST_BYTES)']);
    expect(MOST_BYTES).toBe(Number(bound));
});

test('a file that cannot be read (a folder, or gone) is told', async () => {
    const { files } = await openPage();
    await files.choose({ name: 'folder', size: 4096, arrayBuffer: () => Promise.reject(new DOMException('gone', 'NotFoundError')) });
    expect(files.state.get()).toMatchObject({ busy: null, trouble: expect.stringMatching(/^folder cannot be read/) });
});

test('a file that is only looked at: cancelled, refused, unreadable and without Python it ends with a word, and the next one is read', async () => {
    const { files } = await openPage();
    const never = { name: 'slow.m512', size: 9, arrayBuffer: () => new Promise<ArrayBuffer>(() => undefined) };
    const slow = files.look(never); // as from a network drive that is gone
    files.cancel();
    expect(await slow).toEqual({ kind: 'cancelled' });
    const long = files.look(new File(['motion512 1'], 'long.m512'));
    await settle();
    expect(BusyWorker.all.map(({ isEnded }) => isEnded)).toEqual([false]);
    files.cancel();
    expect(await long).toEqual({ kind: 'cancelled' });
    expect(last().isEnded).toBe(true);
    const gone = { name: 'folder', size: 1, arrayBuffer: () => Promise.reject(new DOMException('gone', 'NotFoundError')) };
    expect(await files.look(gone)).toMatchObject({ kind: 'refused', text: expect.stringMatching(/^folder cannot be read/) });
    const crashes = files.look(new File(['x'], 'crash.m512'));
    await settle();
    last().onerror?.({ message: 'out of memory' });
    expect(await crashes).toMatchObject({ kind: 'refused', text: expect.stringContaining('out of memory') });
    const bad = files.look(new File(['x'], 'bad.m512'));
    await settle();
    last().answer({ kind: 'refused', text: 'no motion file' });
    expect(await bad).toEqual({ kind: 'refused', text: 'no motion file' });
    const image = new Uint8Array(65536);
    const good = files.look(new File(['x'], 'good.m512'));
    await settle();
    last().answer({ kind: 'opened', image, notes: [], losses: [] });
    expect(await good).toEqual({ kind: 'read', image });
    expect(files.state.get()).toMatchObject({ busy: null, opened: null, trouble: null });
});
