// SPDX-License-Identifier: MIT
// Edits that a person agrees to in a dialog. Meanwhile a dropped file, for example, may replace the motions that the question is about.

import { firstDifferent } from '../../model/document.ts';
import type { MotionDocument } from '../../model/document.ts';
import { refuse } from '../../model/result.ts';
import type { Result } from '../../model/result.ts';
import type { Transaction } from '../../model/transaction.ts';
import type { Editor } from '../session/editor.ts';

/** Applies the edit if these pages are as they were when the question was asked: in the document `asked`. false: refused, as by dispatch(). */
export function dispatchAsked(
    editor: Editor,
    asked: MotionDocument,
    pages: readonly number[],
    edit: (document: MotionDocument) => Result<Transaction>,
): boolean {
    const { document } = editor.state.get();
    const changed = firstDifferent(editor.format, pages, asked, document);
    return editor.dispatch(changed === undefined ? edit(document) : refuse('page-changed', String(changed)));
}
