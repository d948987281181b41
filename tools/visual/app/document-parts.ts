// SPDX-License-Identifier: MIT
// Connects the editor to the documents of this browser and to the robot.

import { emptyDocument } from '../model/document.ts';
import { hexOf } from '../robot/hex.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { DocumentStorage } from '../view/document-storage.ts';
import { KeptDocuments } from './documents.ts';
import type { DocumentsParts } from './documents.ts';
import type { DocumentEditor } from './editor.ts';
import { holdDocument } from './hold-document.ts';
import { SENT_PAGES } from './sent-pages.ts';
import { RobotTransfer } from './transfer.ts';
import type { TransferParts } from './transfer.ts';

/** Where documents are kept. isKept is false if they are lost when the page closes. */
export interface ChosenStorage {
    readonly storage: DocumentStorage;
    readonly isKept: boolean;
}

/** What a transfer of pages needs from the robot in use. name: identifies its backups. */
type RobotForPages = Pick<TransferParts, 'requests' | 'becomeEdit'> & { readonly name: () => string };

/** Not crypto.randomUUID(), which is missing over plain http from another machine. */
function newId(): string {
    return hexOf(crypto.getRandomValues(new Uint8Array(16)));
}

export function makeDocuments(
    editor: DocumentEditor,
    { storage, isKept }: ChosenStorage,
    events: Pick<DocumentsParts, 'failed' | 'copied' | 'gone'>,
): KeptDocuments {
    return new KeptDocuments(editor, {
        storage,
        isKept,
        ...events,
        hold: holdDocument,
        empty: emptyDocument(editor.format, ''),
        nowMs: () => Date.now(),
        newId,
    });
}

export function makeTransfer(editor: DocumentEditor, documents: KeptDocuments, robot: RobotForPages): RobotTransfer {
    return new RobotTransfer({
        format: editor.format,
        document: () => editor.state.get().document,
        robot: () => editor.state.get().robot,
        setRobot: pages => editor.setRobot(pages),
        requests: robot.requests,
        becomeEdit: robot.becomeEdit,
        backUp: pages =>
            documents.backUp(robot.name(), pages).catch((cause: unknown) => {
                throw new RobotError('no-backup', '', { cause });
            }),
        sent: SENT_PAGES,
    });
}
