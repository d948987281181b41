// SPDX-License-Identifier: MIT
// The documents of this browser: which there are, which is open, and the autosave: every finished edit is handed to the
// storage at once. Only one tab may have a document open; a second tab gets a copy.

import { documentFrom, imageOf } from '../model/document.ts';
import type { MotionDocument } from '../model/document.ts';
import type { Backup, DocumentStorage, KeptDocument } from '../view/document-storage.ts';
import type { Documents, DocumentsState } from '../view/documents-desk.ts';
import { Store } from '../view/store.ts';

/** Where a document is shown. */
export interface Shown {
  open(document: MotionDocument): void;
  /** The same document under another name. */
  rename(name: string): void;
  document(): MotionDocument;
}

/** Takes a document for this tab, or says that another tab has it. The last one taken is given back. */
export type Hold = (id: string) => Promise<boolean>;

export interface DocumentsParts {
  readonly storage: DocumentStorage;
  /** false: this browser keeps nothing, and the storage ends with the page. */
  readonly isKept: boolean;
  /** Opens as a document with nothing in it. */
  readonly empty: MotionDocument;
  readonly hold: Hold;
  readonly nowMs: () => number;
  readonly newId: () => string;
  /** It could not be kept. */
  readonly failed: (error: unknown) => void;
}

const NEWEST_FIRST = (a: { savedMs: number }, b: { savedMs: number }): number => b.savedMs - a.savedMs;

export class KeptDocuments implements Documents {
  readonly state = new Store<DocumentsState>({ documents: [], openId: '', backups: [], unreadable: [], saving: 'saved' });
  private readonly parts: DocumentsParts;
  private readonly shown: Shown;
  private underWay = 0;

  constructor(shown: Shown, parts: DocumentsParts) {
    this.shown = shown;
    this.parts = parts;
    if (!parts.isKept) this.state.set({ saving: 'off' });
  }

  /** Opens what was edited last; `first` when there is nothing, or when it cannot be read. */
  async start(first: MotionDocument): Promise<void> {
    const kept = await this.load();
    this.state.set({ backups: [...kept.backups].sort((a, b) => b.takenMs - a.takenMs), unreadable: kept.unreadable });
    const [newest] = [...kept.documents].sort(NEWEST_FIRST);
    this.state.set({ documents: kept.documents.map(entryOf) });
    if (!newest) return this.create(first.name, first);
    const document = documentFrom(newest.image, newest.name);
    if (await this.parts.hold(newest.id)) this.show(newest.id, document);
    else await this.create(`${newest.name} (copy)`, document);
  }

  async create(name: string, from?: MotionDocument): Promise<void> {
    const id = this.parts.newId();
    await this.parts.hold(id);
    const document = { ...(from ?? this.parts.empty), name };
    this.state.set({ documents: [...this.state.get().documents, { id, name, savedMs: this.parts.nowMs() }] });
    this.show(id, document);
    this.keep(document);
  }

  async open(id: string): Promise<void> {
    if (id === this.state.get().openId) return;
    const kept = await this.find(id);
    if (!kept) return;
    const document = documentFrom(kept.image, kept.name);
    if (await this.parts.hold(id)) this.show(id, document);
    else await this.create(`${kept.name} (copy)`, document);
  }

  rename(name: string): void {
    this.shown.rename(name);
    this.keep(this.shown.document());
  }

  async remove(): Promise<void> {
    const { openId, documents } = this.state.get();
    const left = documents.filter((entry) => entry.id !== openId);
    this.state.set({ documents: left });
    const [next] = [...left].sort(NEWEST_FIRST);
    if (next) await this.open(next.id);
    else await this.create('My motions');
    await this.parts.storage.removeDocument(openId).catch((error: unknown) => this.parts.failed(error));
  }

  async read(id: string): Promise<MotionDocument | null> {
    const kept = await this.find(id);
    return kept ? documentFrom(kept.image, kept.name) : null;
  }

  /** A finished edit: it is in the storage's hands when this returns. */
  keep(document: MotionDocument): void {
    const { storage } = this.parts;
    const { openId, documents } = this.state.get();
    const entry = { id: openId, name: document.name, savedMs: this.parts.nowMs() };
    this.state.set({ documents: documents.map((one) => (one.id === openId ? entry : one)) });
    if (openId === '') return;
    this.follow(storage.putDocument({ ...entry, image: imageOf(document) }));
  }

  /** Keeps a robot's pages, unless the newest backup of that robot is the same. */
  async backUp(robot: string, pages: readonly Uint8Array[]): Promise<void> {
    const image = imageOf({ name: robot, pages });
    const { backups } = this.state.get();
    const last = backups.find((backup) => backup.robot === robot);
    if (last?.image.every((byte, i) => byte === image[i])) return;
    const backup: Backup = { id: this.parts.newId(), robot, image, takenMs: this.parts.nowMs() };
    this.state.set({ backups: [backup, ...backups] });
    await this.parts.storage.putBackup(backup);
  }

  private show(id: string, document: MotionDocument): void {
    this.state.set({ openId: id });
    this.shown.open(document);
  }

  private async load(): ReturnType<DocumentStorage['load']> {
    const nothing = { documents: [], backups: [], unreadable: [] };
    try {
      return await this.parts.storage.load();
    } catch (error) {
      this.parts.failed(error);
      return nothing;
    }
  }

  private async find(id: string): Promise<KeptDocument | undefined> {
    return (await this.load()).documents.find((kept) => kept.id === id);
  }

  private follow(put: Promise<void>): void {
    this.underWay++;
    if (this.parts.isKept) this.state.set({ saving: 'saving' });
    put.then(() => this.ended(null), (error: unknown) => this.ended(error));
  }

  private ended(error: unknown): void {
    this.underWay--;
    if (error !== null) this.parts.failed(error);
    const saving = error !== null || !this.parts.isKept ? 'off' : this.underWay === 0 ? 'saved' : 'saving';
    this.state.set({ saving });
  }
}

function entryOf({ id, name, savedMs }: KeptDocument): { id: string; name: string; savedMs: number } {
  return { id, name, savedMs };
}
