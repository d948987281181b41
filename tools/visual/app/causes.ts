// SPDX-License-Identifier: MIT
// When the cause of a trouble has gone: the next edit or another page for one that was refused, a robot that answers again or has ended
// what it played, a document that is kept again.

import type { EditorState } from '../model/editor-state.ts';
import type { DeskState } from '../view/desk.ts';
import type { DocumentsState } from '../view/documents-desk.ts';
import type { Store } from '../view/store.ts';
import type { Strip } from './strip.ts';

export interface CausesParts {
    readonly strip: Strip;
    readonly robot: Store<DeskState>;
    readonly editor: Store<EditorState>;
    readonly documents: Store<DocumentsState>;
}

export function watchCauses({ strip, robot, editor, documents }: CausesParts): void {
    onChange(
        editor,
        state => state.document,
        () => strip.over('edit'),
    );
    onChange(
        editor,
        state => state.page,
        () => strip.over('edit'),
    );
    onChange(robot, isQuiet, quiet => quiet && strip.over('robot'));
    onChange(
        documents,
        state => state.saving,
        saving => saving === 'saved' && strip.over('storage'),
    );
}

/** It answers, and nothing moves. */
function isQuiet({ connection, where }: DeskState): boolean {
    return connection === 'ready' && (where === null || where.state === 'idle' || where.state === 'ready');
}

function onChange<T extends object, V>(store: Store<T>, part: (state: T) => V, changed: (now: V) => unknown): void {
    let before = part(store.get());
    store.watch(state => {
        const now = part(state);
        if (now === before) return;
        before = now;
        changed(now);
    });
}
