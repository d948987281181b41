// SPDX-License-Identifier: MIT
// What the document can be compared with: the robot, a backup, another document in this browser, a file.

import { documentFrom } from '../../model/document.ts';
import { ROBOT_IN_PAGE } from '../document-storage.ts';
import type { Session } from '../session/session.ts';
import { TEXTS } from '../texts/texts.ts';

export interface Compared {
    /** `robot`, `b:` and ID of a backup, `d:` and ID of a document, or `file`. */
    readonly key: string;
    readonly title: string;
}

/** All current choices, without files: those have a button of their own. */
export function comparables(session: Session): Compared[] {
    const { documents, backups, openId } = session.documents.state.get();
    const when = (ms: number): string => new Date(ms).toLocaleString(window.document.documentElement.lang);
    return [
        { key: 'robot', title: robotTitle(session) },
        ...backups.map(({ id, robot, takenMs }) => ({
            key: `b:${id}`,
            title: TEXTS.compare.backup(robot === ROBOT_IN_PAGE ? TEXTS.menu.robotInPage : robot, when(takenMs)),
        })),
        ...documents.filter(({ id }) => id !== openId).map(({ id, name }) => ({ key: `d:${id}`, title: TEXTS.compare.document(name) })),
    ];
}

export function robotTitle(session: Session): string {
    const { source, portName } = session.state.get();
    return source === 'simulated'
        ? TEXTS.compare.robotInPage
        : source === 'servos'
          ? TEXTS.compare.myServos
          : TEXTS.compare.yourRobot(portName);
}

/** The 128 pages; null: it no longer exists, or the robot has not been read. */
export async function pagesOf(session: Session, key: string): Promise<readonly (Uint8Array | null)[] | null> {
    const id = key.slice(2);
    if (key === 'robot') {
        const { robot } = session.editor.state.get();
        return robot.length > 0 ? robot : null;
    }
    if (key.startsWith('d:')) return (await session.documents.read(id))?.pages ?? null;
    const backup = session.documents.state.get().backups.find(one => one.id === id);
    return backup ? documentFrom(backup.image, backup.robot).pages : null;
}
