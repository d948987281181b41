// SPDX-License-Identifier: MIT
// Questions about pages: a file that is dropped while one is open may replace those pages.
import { beforeEach, expect, test, vi } from 'vitest';
import { DocumentEditor } from '../app/editor.ts';
import type { Body } from '../model/body.ts';
import { pageOf } from '../model/document.ts';
import { ask, askText } from '../view/editor/ask-dialog.ts';
import { PageActions } from '../view/editor/page-actions.ts';
import type { DocumentsState } from '../view/session/documents.ts';
import { Store } from '../view/store.ts';
import { libraryDocument, makeFormat, makeMotion, must } from './motion-bench.ts';

vi.mock('../view/editor/ask-dialog.ts', () => ({ ask: vi.fn(), askText: vi.fn() }));
vi.mock('../view/element.ts', () => ({ make: () => ({ checked: true }) }));

const { format } = await makeFormat();
const library = await libraryDocument();
const player = await makeMotion();
const [ONE, OTHER, FREE, ELSEWHERE] = [3, 25, 57, 20];

/** changed: the page that is replaced while the question is open. */
function open(changed: number) {
    const refused: string[] = [];
    const editor = new DocumentEditor(
        { joints: [] } as unknown as Body,
        { format, player, document: library },
        { changed: () => undefined, refused: ({ code, words }) => refused.push(`${code} ${words}`), opened: () => undefined },
    );
    const replaced = (answer: string) => () => {
        editor.dispatch(editor.edits.replacePages(editor.state.get().document, new Map([[changed, pageOf(library, 2)]])));
        return Promise.resolve(answer);
    };
    const documents = { state: new Store({ openId: 'mine' } as DocumentsState) };
    return { editor, refused, replaced, documents, actions: new PageActions(editor, documents) };
}

beforeEach(() => void vi.resetAllMocks());

const ACTIONS: readonly (readonly [title: string, answer: string, page: number, act: (actions: PageActions) => Promise<void>])[] = [
    ['rename', 'mine', ONE, actions => actions.rename(ONE)],
    ['clear', 'clear', ONE, actions => actions.clear(ONE)],
    ['copy to what was free', 'copy', FREE, actions => actions.transfer(ONE, FREE)],
    ['move', 'move', ONE, actions => actions.transfer(ONE, FREE)],
    ['swap', 'swap', OTHER, actions => actions.transfer(ONE, OTHER)],
];

test.each(ACTIONS)(
    '%s: a motion that was replaced while the question was open stays, and the page says so',
    async (_, answer, page, act) => {
        const { editor, refused, replaced, actions } = open(page);
        vi.mocked(ask).mockImplementation(replaced(answer));
        vi.mocked(askText).mockImplementation(replaced(answer));
        await act(actions);
        expect(refused).toEqual([`page-changed ${page}`]);
        const wanted = must(editor.edits.replacePages(library, new Map([[page, pageOf(library, 2)]]))).changes;
        expect(editor.state.get().document.pages).toEqual(
            library.pages.map((bytes, at) => wanted.find(one => one.page === at)?.after ?? bytes),
        );
    },
);

test.each(ACTIONS)('%s: another motion may change meanwhile', async (_, answer, __, act) => {
    const { editor, refused, replaced, actions } = open(ELSEWHERE);
    vi.mocked(ask).mockImplementation(replaced(answer));
    vi.mocked(askText).mockImplementation(replaced(answer));
    await act(actions);
    expect(refused).toEqual([]);
    const { document } = editor.state.get();
    expect(pageOf(document, ELSEWHERE)).toEqual(pageOf(library, 2));
    expect([ONE, OTHER, FREE].some(page => !format.isSame(pageOf(document, page), pageOf(library, page)))).toBe(true);
});

test('a motion taken by Ctrl+C is put by Ctrl+V, but not into another document, where its number is another motion', async () => {
    const { documents, actions } = open(ELSEWHERE);
    actions.take(ONE);
    documents.state.set({ openId: 'theirs' });
    await actions.putTaken(FREE);
    expect(ask).not.toHaveBeenCalled();
    documents.state.set({ openId: 'mine' });
    await actions.putTaken(FREE);
    expect(ask).toHaveBeenCalledOnce();
});
