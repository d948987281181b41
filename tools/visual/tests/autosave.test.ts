// SPDX-License-Identifier: MIT
// The autosave: a tab that is closed at any moment has kept every finished edit, and nothing of one that was not finished.
import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import { KeptDocuments } from '../app/documents.ts';
import { DocumentEditor } from '../app/editor.ts';
import type { Body } from '../model/body.ts';
import { emptyDocument, imageOf, pageOf } from '../model/document.ts';
import type { MotionDocument } from '../model/document.ts';
import { PassingStorage, sortKept } from '../view/document-storage.ts';
import type { DocumentStorage } from '../view/document-storage.ts';
import { libraryDocument, makeFormat, makeMotion } from './motion-bench.ts';
import { randomNumbers, settle } from './robot-bench.ts';

const body = JSON.parse(readFileSync(new URL('../../../build/wasm/body.json', import.meta.url), 'utf8')) as Body;
const { format } = await makeFormat();
const player = await makeMotion();
const library = await libraryDocument('My motions');
let ids = 0;

/** A tab of a browser whose disk is `storage`. */
async function openTab(storage: DocumentStorage, options: { taken?: string } = {}) {
  const failures: unknown[] = [];
  const editor: DocumentEditor = new DocumentEditor(body, { format, player, document: library }, {
    changed: (document) => documents.keep(document), refused: () => undefined, opened: () => undefined,
  });
  const documents: KeptDocuments = new KeptDocuments({
    open: (document) => editor.open(document), rename: (name) => editor.rename(name), document: () => editor.state.get().document,
  }, {
    storage, isKept: true, empty: emptyDocument(format, ''), nowMs: () => ++ids, newId: () => `id${++ids}`,
    hold: (id) => Promise.resolve(id !== options.taken), failed: (error) => failures.push(error),
  });
  await documents.start(library);
  return { editor, documents, failures };
}

function now(editor: DocumentEditor): MotionDocument {
  return editor.state.get().document;
}

test('closed at 500 moments: all that was finished is there, an open gesture is not', async () => {
  for (let seed = 1; seed <= 500; seed++) {
    const random = randomNumbers(seed);
    const disk = new PassingStorage();
    const { editor } = await openTab(disk);
    const versions: Uint8Array[] = [imageOf(now(editor))]; // what a person has seen finished, as undo goes through it
    let at = 0;
    let open: ReturnType<DocumentEditor['gesture']> | null = null;
    const finished = (): void => {
      versions.length = ++at;
      versions.push(imageOf(now(editor)));
    };
    for (let moment = Math.floor(random() * 16); moment >= 0; moment--) {
      const page = 1 + Math.floor(random() * 30);
      const kind = open ? (random() < 0.5 ? 'change' : 'finish') : (['edit', 'edit', 'undo', 'redo', 'begin'] as const)[Math.floor(random() * 5)];
      if (kind === 'edit' && editor.dispatch(editor.edits.rename(now(editor), page, `n${seed}_${moment}`))) finished();
      if (kind === 'undo' && at > 0) (editor.undo(), at--);
      if (kind === 'redo' && at < versions.length - 1) (editor.redo(), at++);
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
    const { editor: next } = await openTab(disk); // the first tab is gone, in whatever it was doing
    expect(Buffer.from(imageOf(now(next))).equals(Buffer.from(versions[at] ?? [])), `seed ${seed}`).toBe(true);
  }
}, 120_000);

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
  expect(editor.state.get().history.done).toHaveLength(1); // a new name keeps the history
  const again = await openTab(disk);
  expect(now(again.editor).name).toBe('Bows');
  expect(again.documents.state.get().documents.map((one) => one.name).sort()).toEqual(['Bows', 'Dances']);
  await again.documents.remove();
  expect(now(again.editor).name).toBe('Dances');
});

test('a document that another tab has opens as a copy', async () => {
  const disk = new PassingStorage();
  const { documents } = await openTab(disk);
  const second = await openTab(disk, { taken: documents.state.get().openId });
  expect(now(second.editor).name).toBe('My motions (copy)');
  expect(second.documents.state.get().documents).toHaveLength(2);
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
  expect(documents.state.get().backups.map((one) => one.robot)).toEqual(['other', 'usb', 'usb']);
  expect((await disk.load()).backups).toHaveLength(3);
});
