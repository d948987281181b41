// SPDX-License-Identifier: MIT
// Asks for the list of the robot's pages again when they were written: by the page, or by Edit in the robot in the page.

import type { EditorState } from '../model/editor-state.ts';
import type { TransferState } from '../view/session/transfer.ts';
import type { Store } from '../view/store.ts';
import { onChange } from './causes.ts';

export interface PageListParts {
    readonly editor: Store<EditorState>;
    readonly transfer: Store<TransferState>;
    isSimulated(): boolean;
    mayAsk(): boolean;
    ask(): void;
}

export function watchPageList({ editor, transfer, isSimulated, mayAsk, ask }: PageListParts): void {
    onChange(
        transfer,
        state => state.phase,
        phase => (phase === 'written' || phase === 'stopped') && mayAsk() && ask(),
    );
    onChange(
        editor,
        state => state.robot,
        () => isSimulated() && mayAsk() && ask(),
    );
}
