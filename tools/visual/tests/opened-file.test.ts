// SPDX-License-Identifier: MIT
// What an opened file does to the document: its motions and the pages they lead to go into free pages, unless the person chooses otherwise.
import { expect, test, vi } from 'vitest';
import { DocumentEditor } from '../app/editor.ts';
import { DocumentFiles } from '../app/files.ts';
import type { Body } from '../model/body.ts';
import { imageOf, pageOf } from '../model/document.ts';
import type { MotionDocument } from '../model/document.ts';
import type { FileFormats } from '../model/file-formats.ts';
import { writePage } from '../model/page.ts';
import { TEXTS } from '../view/texts/texts.ts';
import { libraryDocument, makeFormat, makeMotion, must } from './motion-bench.ts';

const { format } = await makeFormat();
const library = await libraryDocument();
const [WALK, WALK_R] = [20, 21];

/** A document with the library, and a file with these pages that has been read. */
async function opened(pages: ReadonlyMap<number, Uint8Array>) {
    const body = { joints: [] } as unknown as Body;
    const editor = new DocumentEditor(
        body,
        { format, player: await makeMotion(), document: library },
        { changed: () => undefined, refused: () => undefined, opened: () => undefined },
    );
    const created: MotionDocument[] = [];
    const image = imageOf({ name: '', pages: library.pages.map((_, page) => pages.get(page) ?? format.empty) });
    const formats = { open: () => Promise.resolve({ kind: 'opened', image, notes: [], losses: [] }) } as unknown as FileFormats;
    const files = new DocumentFiles(editor, formats, {
        cancel: () => undefined,
        create: (_, document) => Promise.resolve(void created.push(document)),
    });
    await files.open('found.mtn', new Uint8Array());
    return { editor, files, created };
}

const renamed = (page: number, name: string): Uint8Array => must(writePage(format, pageOf(library, page), { name }));

test('added: what is there stays, the links go to where the pages are now, and it is one undo step', async () => {
    const { editor, files } = await opened(
        new Map([
            [WALK, renamed(WALK, 'stroll')],
            [WALK_R, renamed(WALK_R, 'stroll_r')],
        ]),
    );
    files.addOpened();
    const { document, page } = editor.state.get();
    for (const [number, bytes] of library.pages.entries()) if (!format.isEmpty(bytes)) expect(pageOf(document, number)).toEqual(bytes);
    expect(editor.page(page).name).toBe('stroll');
    const leads = format.leads(pageOf(document, page)).map(({ to }) => editor.page(to).name);
    expect(leads).toContain('stroll_r');
    expect(files.state.get().opened).toBeNull();
    editor.undo();
    expect(imageOf(editor.state.get().document)).toEqual(imageOf(library));
});

test('what is there already is not doubled, unless it leads to something that came', async () => {
    const same = await opened(new Map(library.pages.entries()));
    same.files.addOpened();
    expect(imageOf(same.editor.state.get().document)).toEqual(imageOf(library));
    expect(same.files.state.get()).toMatchObject({
        opened: null,
        trouble: null,
        done: { name: 'found.mtn', text: expect.stringMatching(/^All motions of the file are here already/) },
    });
    const torn = await opened(
        new Map([...library.pages.entries()].map(([page, bytes]) => [page, page === WALK_R ? renamed(page, 'other') : bytes])),
    );
    torn.files.addOpened();
    const { document, page } = torn.editor.state.get();
    expect(pageOf(document, WALK)).toEqual(pageOf(library, WALK)); // my pages still lead to the same pages
    expect(torn.editor.page(page).steps.length).toBeGreaterThan(0);
});

test('damaged pages are counted before, and a file of nothing else is refused with a sentence', async () => {
    const damaged = Uint8Array.from(renamed(WALK, 'stroll'), (byte, at) => (at === 100 ? byte ^ 1 : byte));
    const some = await opened(
        new Map([
            [WALK, damaged],
            [WALK_R, renamed(WALK_R, 'stroll_r')],
        ]),
    );
    expect(some.files.state.get().opened).toMatchObject({ count: 2, damaged: 1 });
    const { editor, files } = await opened(new Map([[WALK, damaged]]));
    const { page } = editor.state.get();
    files.addOpened();
    expect(files.state.get()).toMatchObject({ opened: null, trouble: expect.stringContaining('No motion of the file is whole') });
    expect(editor.state.get().page).toBe(page);
});

test('a file without motions is told so, whether its pages are empty or were never written; one with a trim alone says that', async () => {
    const erased = await opened(new Map(library.pages.map((_, page) => [page, format.erased] as const)));
    for (const { files } of [await opened(new Map()), erased])
        expect(files.state.get()).toMatchObject({ opened: null, trouble: expect.stringMatching(/^found.mtn holds no motions/) });
    const trim = await opened(new Map([[0, renamed(WALK, 'trim')]]));
    expect(trim.files.state.get()).toMatchObject({ opened: { count: 0, hasTrim: true }, trouble: null });
    expect(TEXTS.files.opened(0, 0)).toMatch(/^No motions, only the trim/);
});

test('as a new document it is one of its own; replacing takes every page but the trim', async () => {
    const pages = new Map([[5, renamed(3, 'hello')]]);
    const one = await opened(pages);
    await one.files.createFromOpened();
    expect(one.created).toMatchObject([{ name: 'found' }]);
    expect(imageOf(one.editor.state.get().document)).toEqual(imageOf(library));
    const other = await opened(pages);
    other.files.replaceAll(false);
    expect(other.editor.page(5).name).toBe('hello');
    expect(format.isEmpty(pageOf(other.editor.state.get().document, WALK))).toBe(true);
});

test('of two files that are dropped quickly the last is shown, and it can be cancelled until it is read', async () => {
    const { files } = await opened(new Map());
    const answers: ((answer: object) => void)[] = [];
    vi.spyOn(files.formats, 'open').mockImplementation(() => new Promise(resolve => answers.push(resolve as (answer: object) => void)));
    const file = (name: string) => ({ name, size: 1, arrayBuffer: () => Promise.resolve(new ArrayBuffer(1)) });
    const image = imageOf(library);
    const first = files.choose(file('first.mtn'));
    await vi.waitFor(() => expect(answers).toHaveLength(1));
    const second = files.choose(file('second.mtn'));
    await vi.waitFor(() => expect(answers).toHaveLength(2));
    answers[0]?.({ kind: 'opened', image, notes: [], losses: [] });
    await first;
    expect(files.state.get()).toMatchObject({ opened: null, busy: TEXTS.files.reading('second.mtn') });
    files.dismiss(); // a dialog about something else is closed
    expect(files.state.get().busy).toBe(TEXTS.files.reading('second.mtn'));
    answers[1]?.({ kind: 'opened', image, notes: [], losses: [] });
    await second;
    expect(files.state.get()).toMatchObject({ opened: { name: 'second.mtn' }, busy: null });
});

test('a file that comes late, as from a network drive, does not take the place of one that was chosen after it', async () => {
    const { files } = await opened(new Map());
    const image = imageOf(library);
    vi.spyOn(files.formats, 'open').mockResolvedValue({ kind: 'opened', image, notes: [], losses: [] });
    let come = (_: ArrayBuffer): void => undefined;
    const late = files.choose({ name: 'late.mtn', size: 1, arrayBuffer: () => new Promise(resolve => (come = resolve)) });
    await files.choose({ name: 'soon.mtn', size: 1, arrayBuffer: () => Promise.resolve(new ArrayBuffer(1)) });
    come(new ArrayBuffer(1));
    await late;
    expect(files.state.get().opened?.name).toBe('soon.mtn');
});

const lost = { name: 'lost.mtn', size: 0, arrayBuffer: () => Promise.reject(new Error('gone')) };

test.each([
    ['two files', [lost, lost], TEXTS.files.oneOnly(2)],
    ['a file that cannot be read', [lost], TEXTS.files.unreadable('lost.mtn')],
] as const)('%s, dropped while another is being read: the sentence takes its place', async (_, [file, ...others], trouble) => {
    const { files } = await opened(new Map());
    let answer = (_: object): void => undefined;
    const asked = vi.spyOn(files.formats, 'open').mockImplementation(() => new Promise(resolve => (answer = resolve as typeof answer)));
    let come = (_: ArrayBuffer): void => undefined;
    const onItsWay = files.choose({ name: 'slow.mtn', size: 1, arrayBuffer: () => new Promise(resolve => (come = resolve)) });
    await files.choose(file, ...others);
    come(new ArrayBuffer(1));
    await onItsWay;
    expect(files.state.get()).toMatchObject({ busy: null, opened: null, trouble });
    const here = files.choose({ name: 'here.mtn', size: 1, arrayBuffer: () => Promise.resolve(new ArrayBuffer(1)) });
    await vi.waitFor(() => expect(asked).toHaveBeenCalledOnce());
    await files.choose(file, ...others);
    answer({ kind: 'opened', image: imageOf(library), notes: [], losses: [] });
    await here;
    expect(files.state.get()).toMatchObject({ busy: null, opened: null, trouble });
});
