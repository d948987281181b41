// SPDX-License-Identifier: MIT
// The autosave: a tab closed at any moment has kept every finished edit and nothing of an unfinished one.
import { expect, test, vi } from 'vitest';
import { KeptDocuments } from '../app/documents.ts';
import type { Hold } from '../app/documents.ts';
import { DocumentEditor } from '../app/editor.ts';
import { copyName, emptyDocument, imageOf, pageOf } from '../model/document.ts';
import type { MotionDocument } from '../model/document.ts';
import { EMPTY_LOG, advance, restored } from '../model/history-log.ts';
import type { Transaction } from '../model/transaction.ts';
import { PassingStorage, sortKept } from '../view/document-storage.ts';
import type { DocumentStorage } from '../view/document-storage.ts';
import { BODY as body, libraryDocument, makeFormat, makeMotion, must } from './motion-bench.ts';
import { randomNumbers, settle } from './robot-bench.ts';

const { format } = await makeFormat();
const player = await makeMotion();
const library = await libraryDocument('My motions');
let ids = 0;

/** A tab of a browser whose disk is `storage`. */
async function openTab(storage: DocumentStorage, options: { taken?: string; hold?: Hold } = {}) {
    const failures: unknown[] = [];
    const copies: string[] = [];
    const gone: string[] = [];
    const editor: DocumentEditor = new DocumentEditor(
        body,
        { format, player, document: library },
        {
            changed: () => documents.keep(),
            refused: () => undefined,
            opened: () => undefined,
        },
    );
    const documents: KeptDocuments = new KeptDocuments(editor, {
        storage,
        isKept: true,
        empty: emptyDocument(format, ''),
        nowMs: () => ++ids,
        newId: () => `id${++ids}`,
        hold: options.hold ?? (id => Promise.resolve(id === options.taken ? null : () => undefined)),
        failed: error => failures.push(error),
        copied: name => copies.push(name),
        gone: name => gone.push(name),
    });
    await documents.start(library);
    return { editor, documents, failures, copies, gone };
}

function now(editor: DocumentEditor): MotionDocument {
    return editor.state.get().document;
}

/** Undo and redo, all the way, go through the same versions of the document as before. */
function checkUndo(editor: DocumentEditor, versions: readonly Uint8Array[], at: number, where: string): void {
    const is = (version: Uint8Array | undefined): boolean => Buffer.from(imageOf(now(editor))).equals(Buffer.from(version ?? []));
    const { done, undone } = editor.state.get().history;
    expect([done.length, undone.length], where).toEqual([at, versions.length - 1 - at]);
    for (let i = at; i > 0; i--) {
        editor.undo();
        expect(is(versions[i - 1]), `${where}, undone to ${i - 1}`).toBe(true);
    }
    for (let i = 1; i < versions.length; i++) {
        editor.redo();
        expect(is(versions[i]), `${where}, redone to ${i}`).toBe(true);
    }
}

test('closed at 500 moments: all that was finished is there, with its undo and redo; an open gesture is not', async () => {
    const closed = { edits: 0, inGesture: 0, undone: 0 };
    for (let seed = 1; seed <= 500; seed++) {
        const random = randomNumbers(seed);
        const disk = new PassingStorage();
        const { editor } = await openTab(disk);
        const versions: Uint8Array[] = [imageOf(now(editor))]; // the finished versions, as undo passes through them
        let at = 0;
        let open: ReturnType<DocumentEditor['gesture']> | null = null;
        const finished = (): void => {
            versions.length = ++at;
            versions.push(imageOf(now(editor)));
        };
        for (let moment = Math.floor(random() * 16); moment >= 0; moment--) {
            const page = 1 + Math.floor(random() * 30);
            const kind = open
                ? random() < 0.5
                    ? 'change'
                    : 'finish'
                : (['edit', 'edit', 'undo', 'redo', 'begin'] as const)[Math.floor(random() * 5)];
            if (kind === 'edit' && editor.dispatch(editor.edits.rename(now(editor), page, `n${seed}_${moment}`))) finished();
            if (kind === 'undo' && at > 0) {
                editor.undo();
                at--;
            }
            if (kind === 'redo' && at < versions.length - 1) {
                editor.redo();
                at++;
            }
            if (kind === 'begin' || kind === 'change') {
                open ??= editor.gesture('drag');
                open.change(editor.edits.setLink(open.start, page, 'exit', 1 + Math.floor(random() * 127)));
            }
            if (kind === 'finish') {
                const before = versions[at];
                open?.finish();
                open = null;
                if (before && !Buffer.from(imageOf(now(editor))).equals(Buffer.from(before))) finished();
            }
        }
        closed.edits += at;
        closed.inGesture += Number(open !== null);
        closed.undone += Number(at < versions.length - 1);
        const { editor: next } = await openTab(disk); // the first tab is gone, whatever it was doing
        expect(Buffer.from(imageOf(now(next))).equals(Buffer.from(versions[at] ?? [])), `seed ${seed}`).toBe(true);
        checkUndo(next, versions, at, `seed ${seed}`);
    }
    expect(closed.edits).toBeGreaterThan(500);
    expect(closed.inGesture).toBeGreaterThan(50);
    expect(closed.undone).toBeGreaterThan(50);
});

test('a history that goes on over three tabs; the names of its steps too', async () => {
    const disk = new PassingStorage();
    for (const [i, name] of ['one', 'two', 'three'].entries()) {
        const { editor } = await openTab(disk);
        expect(editor.state.get().history.done.map(step => step.label)).toEqual(
            Array.from({ length: 2 * i }, (_, k) => (k % 2 ? 'set-link' : 'rename')),
        );
        editor.dispatch(editor.edits.rename(now(editor), 2, name));
        editor.dispatch(editor.edits.setLink(now(editor), 3, 'exit', i + 1));
        editor.undo();
        editor.redo();
    }
    const { editor, documents } = await openTab(disk);
    for (let i = 0; i < 6; i++) editor.undo();
    expect(imageOf(now(editor))).toEqual(imageOf(library));
    expect(documents.state.get().forgotten).toBe(0);
});

test('a step that is damaged or missing on the disk: what is older is forgotten, and told; the document is whole', async () => {
    for (const [spoil, left] of [
        ['missing', 2],
        ['torn', 2],
        ['of another document', 2],
    ] as const) {
        const disk = new PassingStorage();
        const { editor } = await openTab(disk);
        for (const name of ['a', 'b', 'c', 'd', 'e']) editor.dispatch(editor.edits.rename(now(editor), 2, name));
        const last = imageOf(now(editor));
        const readSteps = disk.readSteps.bind(disk);
        disk.readSteps = async id =>
            (await readSteps(id)).flatMap(step => {
                const found = step as { number: number; changes: { after: Uint8Array }[] };
                if (found.number !== 2) return [step];
                const other = { ...found.changes[0], after: library.pages[9] };
                return spoil === 'missing'
                    ? []
                    : [{ ...found, changes: spoil === 'torn' ? [{ ...found.changes[0], after: new Uint8Array(3) }] : [other] }];
            });
        const { editor: next, documents } = await openTab(disk);
        expect(imageOf(now(next)), spoil).toEqual(last);
        expect(next.state.get().history.done, spoil).toHaveLength(left);
        expect(documents.state.get().forgotten, spoil).toBe(3);
    }
});

test('a history too long for its room: the oldest steps go, undo goes back as far as was kept', () => {
    const step = (i: number): Transaction => ({
        label: 'rename',
        changes: [{ page: 2, before: library.pages[i] ?? format.empty, after: library.pages[i + 1] ?? format.empty }],
    });
    const steps = Array.from({ length: 50 }, (_, i) => step(i + 1));
    let log = EMPTY_LOG;
    const kept = new Map<number, unknown>();
    for (let count = 1; count <= steps.length; count++) {
        const made = advance(log, { done: steps.slice(0, count), undone: [] }, 20 * 1200);
        log = made.log;
        for (const number of [...kept.keys()]) if (number < made.change.dropBefore || number >= made.change.dropFrom) kept.delete(number);
        for (const one of made.change.add) kept.set(one.number, one);
    }
    expect(kept.size).toBe(21);
    const document = { ...library, pages: library.pages.map((bytes, page) => (page === 2 ? (library.pages[51] ?? bytes) : bytes)) };
    const { history, log: again } = restored(document, 50, [...kept.values()]);
    expect(history.done).toHaveLength(21);
    expect(again.base).toBe(29);
});

test('no room for document and history: the history goes, the document stays', async () => {
    const disk = new PassingStorage();
    const { editor, failures } = await openTab(disk);
    const put = disk.putDocument.bind(disk);
    disk.putDocument = (document, steps) => (steps.add.length > 0 ? Promise.reject(new Error('QuotaExceededError')) : put(document, steps));
    editor.dispatch(editor.edits.rename(now(editor), 2, 'curtsy'));
    await settle();
    expect(failures).toEqual([]);
    const next = await openTab(disk);
    expect(next.editor.page(2).name).toBe('curtsy');
    expect(next.editor.state.get().history.done).toEqual([]);
    expect(next.documents.state.get().forgotten).toBe(1);
});

test('several documents, each with its own pages; the one edited last is opened', async () => {
    const disk = new PassingStorage();
    const { editor, documents } = await openTab(disk);
    const first = documents.state.get().openId;
    await documents.create('Dances');
    expect(format.isEmpty(pageOf(now(editor), 2))).toBe(true);
    expect(editor.state.get().history.done).toHaveLength(0);
    await documents.open(first);
    expect(imageOf(now(editor))).toEqual(imageOf(library));
    editor.dispatch(editor.edits.rename(now(editor), 2, 'curtsy'));
    documents.rename('Bows');
    expect(editor.state.get().history.done).toHaveLength(1); // renaming keeps the history
    const again = await openTab(disk);
    expect(now(again.editor).name).toBe('Bows');
    expect(
        again.documents.state
            .get()
            .documents.map(one => one.name)
            .sort(),
    ).toEqual(['Bows', 'Dances']);
    await again.documents.remove(again.documents.state.get().openId);
    expect(now(again.editor).name).toBe('Dances');
});

test('a name that another document has is numbered: for a new one, a renamed one, and again', async () => {
    const { documents } = await openTab(new PassingStorage());
    const names = (): string[] => documents.state.get().documents.map(one => one.name);
    await documents.create('My motions');
    await documents.create('My motions (2)');
    await documents.create('Dances');
    documents.rename('My motions');
    expect(names()).toEqual(['My motions', 'My motions (2)', 'My motions (3)', 'My motions (4)']);
    documents.rename('My motions (4)'); // its own
    expect(names().at(-1)).toBe('My motions (4)');
});

test('what is edited right after a copy was asked for belongs to the copy, and the first document stays as it was', async () => {
    const disk = new PassingStorage();
    const { editor, documents } = await openTab(disk);
    const first = documents.state.get().openId;
    const made = documents.create('My motions (copy)', now(editor));
    editor.dispatch(editor.edits.rename(now(editor), 2, 'curtsy')); // before the browser has given the copy's lock to this tab
    await made;
    await settle();
    const kept = new Map((await disk.load()).documents.map(one => [one.name, one.image]));
    expect(Buffer.from(kept.get('My motions') ?? []).equals(imageOf(library))).toBe(true);
    expect(now(editor).name).toBe('My motions (copy)');
    expect(Buffer.from(kept.get('My motions (copy)') ?? []).equals(imageOf(now(editor)))).toBe(true);
    expect(editor.page(2).name).toBe('curtsy');
    await documents.open(first);
    expect(editor.page(2).name).toBe('bow');
});

test('a document that another tab has opens as a copy', async () => {
    const disk = new PassingStorage();
    const { documents } = await openTab(disk);
    const second = await openTab(disk, { taken: documents.state.get().openId });
    expect(now(second.editor).name).toBe('My motions (copy)');
    expect(second.documents.state.get().documents).toHaveLength(2);
    expect(second.copies).toEqual(['My motions (copy)']); // the page reports it
});

test('a copy for a second tab is kept from its first edit on: tabs that only look leave none behind', async () => {
    const disk = new PassingStorage();
    const { editor, documents } = await openTab(disk);
    const taken = documents.state.get().openId;
    const kept = async (): Promise<string[]> => (await disk.load()).documents.map(one => one.name).sort();
    for (let visit = 0; visit < 3; visit++) {
        editor.dispatch(editor.edits.rename(now(editor), 2, `bow${visit}`)); // the first tab's document is the newest again
        const { copies } = await openTab(disk, { taken });
        expect(copies).toEqual(['My motions (copy)']);
        expect(await kept()).toEqual(['My motions']);
    }
    const second = await openTab(disk, { taken });
    second.editor.dispatch(second.editor.edits.rename(now(second.editor), 3, 'mine'));
    await settle();
    expect(await kept()).toEqual(['My motions', 'My motions (copy)']);
    expect(second.editor.page(3).name).toBe('mine');
    const third = await openTab(disk, { taken });
    expect(now(third.editor).name).toBe('My motions (copy)'); // the edited copy, which no tab has open now
    expect(third.editor.page(3).name).toBe('mine');
});

test('documents of one name that two tabs have made: each is kept with its edits, and the next tab tells them apart', async () => {
    const disk = new PassingStorage();
    const first = await openTab(disk);
    const taken = first.documents.state.get().openId;
    const tabs = [await openTab(disk, { taken }), await openTab(disk, { taken }), first, await openTab(disk, { taken })];
    for (const { documents } of tabs.slice(2)) await documents.create('Dances');
    for (const [i, { editor }] of tabs.entries()) editor.dispatch(editor.edits.rename(now(editor), 2, `tab${i}`));
    await settle();
    const { documents, editor } = await openTab(disk);
    const list = documents.state.get().documents;
    expect(list.map(one => one.name).sort()).toEqual(['Dances', 'Dances (2)', 'My motions', 'My motions (copy)', 'My motions (copy) (2)']);
    const opened: string[] = [];
    for (const { id, name } of list) {
        await documents.open(id);
        expect(now(editor).name).toBe(name);
        opened.push(editor.page(2).name);
    }
    expect(opened.sort()).toEqual(['bow', 'tab0', 'tab1', 'tab2', 'tab3']);
    expect(documents.state.get().documents).toEqual(list); // nothing was stored by looking
});

test('a copy that was not edited is no document to go back to', async () => {
    const disk = new PassingStorage();
    const { documents } = await openTab(disk);
    await documents.create('Dances');
    const second = await openTab(disk, { taken: documents.state.get().openId });
    const dances = second.documents.state.get();
    expect(dances.documents.map(one => one.name).sort()).toEqual(['Dances', 'Dances (copy)', 'My motions']);
    await second.documents.open(dances.documents.find(one => one.name === 'My motions')?.id ?? '');
    expect(
        second.documents.state
            .get()
            .documents.map(one => one.name)
            .sort(),
    ).toEqual(['Dances', 'My motions']);
    expect(now(second.editor).name).toBe('My motions');
});

test('copies are numbered: of a document, and of a copy', () => {
    expect(copyName('walk', ['walk'], 'copy')).toBe('walk (copy)');
    expect(copyName('walk (copy)', ['walk', 'walk (copy)'], 'copy')).toBe('walk (copy 2)');
    expect(copyName('walk', ['walk (copy)', 'walk (copy 2)'], 'copy')).toBe('walk (copy 3)');
});

test('it opens where somebody worked last, over a reload too; a document in which nobody did, on a new page', async () => {
    const disk = new PassingStorage();
    const { editor } = await openTab(disk);
    const { page } = editor.state.get();
    expect(page).toBeGreaterThan(0);
    expect(editor.page(page).steps).toEqual([]);
    editor.dispatch(editor.edits.rename(now(editor), 12, 'mine'));
    editor.select({ page: 40 });
    const again = await openTab(disk);
    expect(again.editor.state.get().page).toBe(12);
});

test('a page of the library is one until it is changed; its copy is under a name of its own, without its key, and links as it does', async () => {
    const editor = new DocumentEditor(
        body,
        { format, player, document: library, library: library.pages },
        { changed: () => undefined, refused: () => undefined, opened: () => undefined },
    );
    expect(editor.isOfLibrary(3)).toBe(true);
    const copy = must(editor.edits.copyForEditing(now(editor), 3));
    editor.dispatch({ ok: true, value: copy.edit });
    expect(editor.page(copy.page)).toMatchObject({ name: 'wave 2', code: 0, next: editor.page(3).next });
    expect(editor.page(copy.page).steps).toEqual(editor.page(3).steps);
    expect([editor.isOfLibrary(3), editor.isOfLibrary(copy.page)]).toEqual([true, false]);
    editor.undo(); // one undo step
    expect(editor.page(copy.page).steps).toEqual([]);
});

/** Locks as a browser keeps them: nobody, not even the same tab, gets one twice. */
function makeLocks() {
    const held = new Set<string>();
    const hold = (id: string): Promise<(() => void) | null> => {
        if (held.has(id)) return Promise.resolve(null);
        held.add(id);
        return Promise.resolve(() => void held.delete(id));
    };
    return { held, hold };
}

test('whatever is opened quickly, the last is shown and held, and no other, even if the disk answers late', async () => {
    const disk = new PassingStorage();
    const { held, hold } = makeLocks();
    const { editor, documents, copies } = await openTab(disk, { hold });
    const bows = documents.state.get().openId;
    await documents.create('Dances');
    const dances = documents.state.get().openId;
    await documents.create('Kicks');
    const kicks = documents.state.get().openId;
    for (const call of ['readDocument', 'readSteps'] as const)
        for (const [first, then] of [
            [bows, dances],
            [bows, bows], // twice the same
            [bows, kicks], // back to the open one
        ] as const) {
            const waiting: (() => void)[] = [];
            const real = disk[call].bind(disk) as (id: string) => Promise<never>;
            const late = vi.spyOn(disk, call).mockImplementation(async (id?: string) => {
                await new Promise<void>(resolve => waiting.push(resolve));
                return real(id ?? '');
            });
            const opened = documents.open(first);
            await settle();
            const next = documents.open(then);
            for (let answers = 0; answers < 4; answers++) {
                await settle();
                waiting.shift()?.();
            }
            await Promise.all([opened, next]);
            late.mockRestore();
            const { openId, documents: all } = documents.state.get();
            expect([openId, ...held], `${call}: ${first}, ${then}`).toEqual([then, then]);
            expect(now(editor).name).toBe(all.find(({ id }) => id === then)?.name);
            expect(copies).toEqual([]);
            await documents.open(kicks);
        }
    await Promise.all([documents.create('one'), documents.create('two')]);
    expect([...held]).toEqual([documents.state.get().openId]);
});

test.each(['readDocument', 'readSteps'] as const)('a document made while others are being opened stays, if %s answers late', async call => {
    const disk = new PassingStorage();
    const { held, hold } = makeLocks();
    const { editor, documents } = await openTab(disk, { hold });
    const bows = documents.state.get().openId;
    await documents.create('Dances');
    const dances = documents.state.get().openId;
    await documents.create('Kicks');
    const waiting: (() => void)[] = [];
    const real = disk[call].bind(disk) as (id: string) => Promise<never>;
    vi.spyOn(disk, call).mockImplementation(async (id?: string) => {
        await new Promise<void>(resolve => waiting.push(resolve));
        return real(id ?? '');
    });
    const opened = [documents.open(bows), documents.open(dances)]; // the second waits for the first
    await settle();
    const made = documents.create('Waves');
    const waves = documents.state.get().openId;
    for (let answers = 0; answers < 4; answers++) {
        await settle();
        waiting.shift()?.();
    }
    await Promise.all([...opened, made]);
    expect([now(editor).name, documents.state.get().openId, ...held]).toEqual(['Waves', waves, waves]);
});

test('an edit that another tab stores just before it closes is in the document that is opened here', async () => {
    const disk = new PassingStorage();
    const first = await openTab(disk);
    const bows = first.documents.state.get().openId;
    let isClosing = false;
    const hold: Hold = id => {
        if (isClosing && id === bows) first.editor.dispatch(first.editor.edits.rename(now(first.editor), 2, 'curtsy')); // its last edit
        return Promise.resolve(isClosing || id !== bows ? () => undefined : null);
    };
    const second = await openTab(disk, { hold });
    await second.documents.create('Dances');
    isClosing = true;
    await second.documents.open(bows);
    expect(second.editor.page(2).name).toBe('curtsy');
    expect(second.editor.state.get().history.done).toHaveLength(1);
});

test('a document that another tab has deleted is told of, and is no document to go back to', async () => {
    const disk = new PassingStorage();
    const { editor, documents, gone } = await openTab(disk);
    const bows = documents.state.get().openId;
    await documents.create('Dances');
    const dances = documents.state.get().openId;
    await documents.create('Kicks');
    await disk.removeDocument(dances);
    await documents.open(dances);
    expect(gone).toEqual(['Dances']);
    expect(documents.state.get().documents.map(one => one.name)).toEqual(['My motions', 'Kicks']);
    await disk.removeDocument(bows);
    await documents.remove(documents.state.get().openId);
    editor.dispatch(editor.edits.rename(now(editor), 2, 'curtsy'));
    await settle();
    const kept = (await disk.load()).documents;
    expect(kept.map(one => one.id)).toEqual([documents.state.get().openId]);
    expect(kept).toHaveLength(1);
});

test('another document opens while the question whether to delete this one is open: this one is deleted', async () => {
    const disk = new PassingStorage();
    const { editor, documents } = await openTab(disk);
    const bows = documents.state.get().openId;
    await documents.create('Dances');
    await documents.remove(bows);
    expect(now(editor).name).toBe('Dances');
    expect(documents.state.get().documents.map(one => one.name)).toEqual(['Dances']);
    expect((await disk.load()).documents.map(one => one.name)).toEqual(['Dances']);
});

test('a document that could not be read is not said to be deleted, and stays in the list', async () => {
    const disk = new PassingStorage();
    const { editor, documents, failures, gone } = await openTab(disk);
    const [mine] = documents.state.get().documents;
    await documents.create('Dances');
    vi.spyOn(disk, 'readDocument').mockRejectedValueOnce(new Error('UnknownError'));
    await documents.open(mine?.id ?? '');
    expect([failures.length, gone]).toEqual([1, []]);
    expect(now(editor).name).toBe('Dances');
    await documents.open(mine?.id ?? '');
    expect(now(editor).name).toBe('My motions');
});

test('a disk that is full is told of, and the work goes on', async () => {
    const disk = new PassingStorage();
    const { editor, documents, failures } = await openTab(disk);
    disk.putDocument = () => Promise.reject(new Error('QuotaExceededError'));
    editor.dispatch(editor.edits.rename(now(editor), 2, 'curtsy'));
    await settle();
    expect(failures).toHaveLength(1);
    expect(documents.state.get().saving).toBe('off');
    expect(editor.page(2).name).toBe('curtsy');
});

test('a document that could not be stored is not called saved when another one is, is shown as it was edited, and stored when there is room', async () => {
    const disk = new PassingStorage();
    const { held, hold } = makeLocks();
    const { editor, documents, gone } = await openTab(disk, { hold });
    const bows = documents.state.get().openId;
    const put = disk.putDocument.bind(disk);
    disk.putDocument = (document, steps) => (document.id === bows ? Promise.reject(new Error('QuotaExceededError')) : put(document, steps));
    editor.dispatch(editor.edits.rename(now(editor), 2, 'curtsy'));
    await settle();
    await documents.create('Dances');
    await settle();
    expect(documents.state.get().saving).toBe('off'); // so the browser asks before it closes the page
    expect(held).toContain(bows); // another tab would edit the older version
    await documents.open(bows);
    expect(editor.page(2).name).toBe('curtsy');
    expect(gone).toEqual([]);
    await documents.create('Kicks');
    disk.putDocument = put;
    editor.dispatch(editor.edits.rename(now(editor), 3, 'kick'));
    await settle();
    expect(documents.state.get().saving).toBe('saved');
    expect([...held]).toEqual([documents.state.get().openId]);
    await documents.open(bows);
    expect(editor.page(2).name).toBe('curtsy');
    expect((await disk.readDocument(bows))?.image).toEqual(imageOf(now(editor)));
});

test('a document that could not be stored is deleted: all that is left is saved', async () => {
    const disk = new PassingStorage();
    const { editor, documents } = await openTab(disk);
    const put = vi.spyOn(disk, 'putDocument').mockRejectedValue(new Error('QuotaExceededError'));
    editor.dispatch(editor.edits.rename(now(editor), 2, 'curtsy'));
    await settle();
    put.mockRestore();
    const bows = documents.state.get().openId;
    await documents.remove(bows);
    await settle();
    expect(documents.state.get().saving).toBe('saved');
    expect((await disk.load()).documents.map(({ id }) => id)).toEqual([documents.state.get().openId]);
});

test('what cannot be read is named, not dropped', () => {
    const good = { id: 'a', name: 'good', image: imageOf(library), savedMs: 1 };
    const kept = sortKept([good, { id: 'b', name: 'half', image: new Uint8Array(100) }, null], [{ id: 'c', robot: 'old robot' }]);
    expect(kept.documents).toEqual([good]);
    expect(kept.unreadable).toEqual(['half', 'without a name', 'old robot']);
});

test('a backup is kept once for each state of a robot', async () => {
    const disk = new PassingStorage();
    const { editor, documents } = await openTab(disk);
    await documents.backUp('usb', library.pages);
    await documents.backUp('usb', library.pages);
    editor.dispatch(editor.edits.rename(now(editor), 2, 'curtsy'));
    await documents.backUp('usb', now(editor).pages);
    await documents.backUp('other', library.pages);
    expect(documents.state.get().backups.map(one => one.robot)).toEqual(['other', 'usb', 'usb']);
    expect((await disk.load()).backups).toHaveLength(3);
});

test('a backup that could not be stored is not taken for one at the next try', async () => {
    const disk = new PassingStorage();
    const { documents } = await openTab(disk);
    const put = vi.spyOn(disk, 'putBackup').mockRejectedValue(new Error('QuotaExceededError'));
    await expect(documents.backUp('usb', library.pages)).rejects.toThrow('QuotaExceededError');
    await expect(documents.backUp('usb', library.pages)).rejects.toThrow('QuotaExceededError');
    expect(documents.state.get().backups).toEqual([]);
    put.mockRestore();
    await documents.backUp('usb', library.pages);
    expect((await disk.load()).backups).toHaveLength(1);
});

test('a backup that is gone from the storage is made again, and one that cannot be is refused', async () => {
    const disk = new PassingStorage();
    const { documents } = await openTab(disk);
    await documents.backUp('usb', library.pages);
    const emptied = new PassingStorage(); // the browser's data was deleted while the page is open
    vi.spyOn(disk, 'putBackup').mockImplementation(backup => emptied.putBackup(backup));
    await documents.backUp('usb', library.pages);
    expect((await emptied.load()).backups).toEqual(documents.state.get().backups);
    vi.spyOn(disk, 'putBackup').mockRejectedValue(new Error('InvalidStateError'));
    await expect(documents.backUp('usb', library.pages)).rejects.toThrow('InvalidStateError');
});

test.each(['first', 'second'])('of two edits the %s could not be stored at first: the second is what is kept', async refused => {
    const disk = new PassingStorage();
    const { editor } = await openTab(disk);
    let fail = (_: Error): void => undefined;
    const put = vi.spyOn(disk, 'putDocument');
    if (refused === 'second') put.mockResolvedValueOnce();
    put.mockReturnValueOnce(new Promise((_, reject) => (fail = reject)));
    editor.dispatch(editor.edits.rename(now(editor), 2, 'curtsy'));
    editor.dispatch(editor.edits.rename(now(editor), 3, 'salute'));
    if (refused === 'second') await settle(); // the first is stored before the second is refused
    fail(new Error('QuotaExceededError'));
    await settle();
    const [kept] = (await disk.load()).documents;
    expect(kept?.image).toEqual(imageOf(now(editor)));
});
