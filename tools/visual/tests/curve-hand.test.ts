// SPDX-License-Identifier: MIT
// Keys on the curves of a motion without steps; two fingers.
import { expect, test, vi } from 'vitest';
import { DocumentEditor } from '../app/editor.ts';
import { emptyDocument } from '../model/document.ts';
import { JOINTS } from '../model/motion.ts';
import { CurveHand } from '../view/editor/curve-hand.ts';
import { easyStep } from '../view/editor/editing.ts';
import { changeStep } from '../view/editor/joint-edits.ts';
import type { Session } from '../view/session/session.ts';
import { BODY as body, makeFormat, makeMotion } from './motion-bench.ts';

async function emptyEditor() {
    const { format } = await makeFormat();
    const refused = vi.fn();
    const parts = { format, player: await makeMotion(), document: emptyDocument(format, 'mine') };
    return { editor: new DocumentEditor(body, parts, { changed: () => undefined, refused, opened: () => undefined }), refused };
}

test.each(['ArrowLeft', 'ArrowRight'])('%s, and then a first step: it is the chosen one, and can be deleted', async key => {
    const { editor, refused } = await emptyEditor();
    const hand = new CurveHand({ editor, body } as unknown as Session);
    hand.key({ key } as KeyboardEvent);
    const { page, document } = editor.state.get();
    editor.dispatch(changeStep(editor, document, new Map([[1, 600]]), null)); // a drag in the picture
    expect([...editor.state.get().steps]).toEqual([0]);
    editor.dispatch(editor.edits.deleteSteps(editor.state.get().document, page, editor.state.get().steps));
    expect(editor.page(page).steps).toEqual([]);
    expect(refused).not.toHaveBeenCalled();
});

test.each([{ step: 1, steps: new Set([1]) }, { page: 2 }])(
    'a drag ends when another finger chooses %o: it stays where it began',
    async other => {
        const { editor, refused } = await emptyEditor();
        const pose = (first: number) => Array.from({ length: JOINTS }, (_, id) => (id === 3 ? first : null));
        const steps = [400, 500].map(first => easyStep(pose(first), pose(first)));
        const { page, document } = editor.state.get();
        editor.dispatch(editor.edits.insertSteps(document, page, 0, steps));
        editor.select({ step: 0, steps: new Set([0]) });
        const drag = editor.gesture('set-joints');
        const moveTo = (position: number) => drag.change(changeStep(editor, drag.start, new Map([[3, position]]), null));
        moveTo(600);
        editor.select({ joints: new Set([3]) });
        expect(moveTo(610)).toBe(true);
        editor.select(other);
        expect(moveTo(620)).toBe(false);
        drag.cancel();
        expect(editor.page(page).steps.map(({ positions }) => positions[3])).toEqual([610, 500]);
        expect(editor.page(2).steps).toEqual([]);
        editor.undo(); // one step
        expect(editor.page(page).steps.map(({ positions }) => positions[3])).toEqual([400, 500]);
        expect(refused).not.toHaveBeenCalled();
    },
);
