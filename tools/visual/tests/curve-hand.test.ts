// SPDX-License-Identifier: MIT
// Keys on the curves of a motion without steps.
import { readFileSync } from 'node:fs';
import { expect, test, vi } from 'vitest';
import { DocumentEditor } from '../app/editor.ts';
import type { Body } from '../model/body.ts';
import { emptyDocument } from '../model/document.ts';
import { CurveHand } from '../view/editor/curve-hand.ts';
import { changeStep } from '../view/editor/joint-edits.ts';
import type { Session } from '../view/session/session.ts';
import { makeFormat, makeMotion } from './motion-bench.ts';

const body = JSON.parse(readFileSync(new URL('../../../build/wasm/body.json', import.meta.url), 'utf8')) as Body;

test.each(['ArrowLeft', 'ArrowRight'])('%s, and then a first step: it is the chosen one, and can be deleted', async key => {
    const { format } = await makeFormat();
    const refused = vi.fn();
    const parts = { format, player: await makeMotion(), document: emptyDocument(format, 'mine') };
    const editor = new DocumentEditor(body, parts, { changed: () => undefined, refused, opened: () => undefined });
    const hand = new CurveHand({ editor, body } as unknown as Session);
    hand.key({ key } as KeyboardEvent);
    const { page, document } = editor.state.get();
    editor.dispatch(changeStep(editor, document, new Map([[1, 600]]), null)); // a drag in the picture
    expect([...editor.state.get().steps]).toEqual([0]);
    editor.dispatch(editor.edits.deleteSteps(editor.state.get().document, page, editor.state.get().steps));
    expect(editor.page(page).steps).toEqual([]);
    expect(refused).not.toHaveBeenCalled();
});
