// SPDX-License-Identifier: MIT
// The page over plain http from another machine, as a school may offer it: the browser has no locks, no clipboard and no crypto.randomUUID
// there.
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { makeDocuments } from '../app/document-parts.ts';
import { DocumentEditor } from '../app/editor.ts';
import { holdDocument } from '../app/hold-document.ts';
import { withPort } from '../app/serial-ports.ts';
import { TabLocks } from '../app/tab-locks.ts';
import { copyText } from '../view/clipboard.ts';
import { PassingStorage } from '../view/document-storage.ts';
import { BODY as body, libraryDocument, makeFormat, makeMotion } from './motion-bench.ts';

beforeEach(() => {
    const { crypto } = globalThis;
    vi.stubGlobal('crypto', { getRandomValues: (bytes: Uint8Array<ArrayBuffer>) => crypto.getRandomValues(bytes) });
    vi.stubGlobal('navigator', {});
});
afterEach(() => {
    vi.unstubAllGlobals();
});

test('the serial ports are missing for the sake of http, which is said; a browser without them is another matter', async () => {
    vi.stubGlobal('isSecureContext', false);
    await expect(withPort(() => Promise.resolve())).rejects.toMatchObject({ code: 'plain-http' });
    vi.stubGlobal('isSecureContext', true);
    await expect(withPort(() => Promise.resolve())).rejects.toMatchObject({ code: 'no-serial' });
});

test('the first document opens, and the next one is another', async () => {
    const { format } = await makeFormat();
    const library = await libraryDocument();
    const parts = { format, player: await makeMotion(), document: library };
    const editor = new DocumentEditor(body, parts, { changed: () => undefined, refused: () => undefined, opened: () => undefined });
    const events = { failed: vi.fn(), copied: vi.fn(), gone: vi.fn() };
    const documents = makeDocuments(editor, { storage: new PassingStorage(), isKept: true }, events);
    await documents.start(library);
    const first = documents.state.get().openId;
    await documents.create('another');
    expect(first).not.toBe('');
    expect(documents.state.get().documents.map(({ id }) => id)).toEqual([first, documents.state.get().openId]);
    expect(documents.state.get().openId).not.toBe(first);
});

test('two tabs: what one has the other does not get, until it is let go; and no tab gets it twice', async () => {
    const [first, second] = [new TabLocks(), new TabLocks()];
    const release = await first.request('document-1');
    expect(release).not.toBeNull();
    expect([await first.request('document-1'), await second.request('document-1')]).toEqual([null, null]);
    expect(await second.request('document-2')).not.toBeNull();
    release?.();
    expect(await second.request('document-1')).not.toBeNull();
    expect(await first.request('document-1')).toBeNull();
});

test('a browser that may not store data refuses its locks as well: the tabs ask each other', async () => {
    vi.stubGlobal('navigator', { locks: { request: () => Promise.reject(new DOMException('The request was denied.', 'SecurityError')) } });
    expect([await holdDocument('1'), await holdDocument('1')]).toEqual([expect.any(Function), null]);
});

test('three tabs that ask at the same time, or while another one waits for answers: one of them gets it', async () => {
    for (const betweenMs of [0, 100]) {
        const tabs = [new TabLocks(), new TabLocks(), new TabLocks()];
        const asked: Promise<unknown>[] = [];
        for (const tab of tabs) {
            asked.push(tab.request(`robot ${betweenMs}`));
            await new Promise(resolve => setTimeout(resolve, betweenMs));
        }
        expect((await Promise.all(asked)).filter(lock => lock !== null)).toHaveLength(1);
    }
});

test('who sends a link is shown it, although it cannot be copied', async () => {
    expect(await copyText('a link')).toBe(false);
});

test('a browser with a clipboard has it copied, unless it refuses', async () => {
    const writeText = vi.fn().mockResolvedValueOnce(undefined).mockRejectedValueOnce(new DOMException('', 'NotAllowedError'));
    vi.stubGlobal('navigator', { clipboard: { writeText } });
    expect([await copyText('a link'), await copyText('a link')]).toEqual([true, false]);
    expect(writeText).toHaveBeenCalledWith('a link');
});
