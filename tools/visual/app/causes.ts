// SPDX-License-Identifier: MIT
// Clears a trouble when its cause is gone: a refused edit after the next edit or page change, robot trouble once the robot answers and is
// idle, storage trouble once the document is saved again.

import type { EditorState } from '../model/editor-state.ts';
import type { SessionState } from '../view/session/session.ts';
import type { DocumentsState } from '../view/session/documents.ts';
import type { Store } from '../view/store.ts';
import type { StatusMessages } from './status-messages.ts';

export interface CausesParts {
    readonly messages: StatusMessages;
    readonly robot: Store<SessionState>;
    readonly editor: Store<EditorState>;
    readonly documents: Store<DocumentsState>;
}

export function watchCauses({ messages, robot, editor, documents }: CausesParts): void {
    onChange(
        editor,
        state => state.document,
        () => messages.over('edit'),
    );
    onChange(
        editor,
        state => state.page,
        () => messages.over('edit'),
    );
    onChange(robot, isQuiet, quiet => quiet && messages.over('robot'));
    onChange(
        documents,
        state => state.saving,
        saving => saving === 'saved' && messages.over('storage'),
    );
}

/** It answers and does not move. */
function isQuiet({ connection, where }: SessionState): boolean {
    return connection === 'ready' && (where === null || where.state === 'idle' || where.state === 'ready');
}

export function onChange<T extends object, V>(store: Store<T>, part: (state: T) => V, changed: (now: V) => unknown): void {
    let before = part(store.get());
    store.watch(state => {
        const now = part(state);
        if (now === before) return;
        before = now;
        changed(now);
    });
}
