// SPDX-License-Identifier: MIT
// Texts on the robot, in the current language.

import type { Joint } from '../../model/body.ts';
import { idsIn } from '../../robot/protocol.ts';
import type { Where } from '../../robot/protocol.ts';
import type { RobotError } from '../../robot/robot-error.ts';
import type { RobotState } from '../../robot/robot-state.ts';
import type { SessionState } from '../session/session.ts';
import { TEXTS } from './texts.ts';

/** One sentence for an error, followed by the board's own words. */
export function errorText(error: RobotError): string {
    if (error.code === 'needs-edit') return TEXTS.robot.needsEdit(error.words);
    const sentence = TEXTS.robot.errors[error.code];
    if (error.words === '' || error.code === 'no-answer') return sentence;
    // The board's sentences have no full stop, and neither have numbers, behind which another sentence may follow.
    const end = /[.?!]$/.test(error.words) ? '' : sentence.endsWith('：') ? '。' : '.';
    return `${sentence} ${error.words}${end}`;
}

/** Rising numbers, three or more in a row as "5-7", as the board writes them. */
export function ranges(numbers: readonly number[]): string[] {
    const rows: number[][] = [];
    for (const number of numbers) {
        const row = rows.at(-1);
        if (row?.at(-1) === number - 1) row.push(number);
        else rows.push([number]);
    }
    return rows.flatMap(row => (row.length > 2 ? [`${row[0]}-${row.at(-1)}`] : row.map(String)));
}

/** For example "right hip pitch". */
export function jointTitle(joint: Joint): string {
    return TEXTS.joints[joint.name] ?? joint.name.replaceAll('_', ' ');
}

/** link: name in the body file. For example "right forearm". */
export function limbTitle(link: string): string {
    return TEXTS.limbs[link] ?? link.replaceAll('_', ' ');
}

function motionTitle(state: SessionState, page: number): string {
    return TEXTS.motion.title(page, state.pages.find(entry => entry.page === page)?.name ?? '');
}

/** What the robot does, in one sentence. */
export function doingText(state: SessionState, where: Where | null): string {
    if (state.stopped !== null) return state.stopped;
    const shown = state.shownPage === null ? '' : TEXTS.status.shownOnly(TEXTS.motion.title(state.shownPage, state.shownName ?? ''));
    return [shown, robotText(state, where)].filter(Boolean).join(' ');
}

function robotText(state: SessionState, where: Where | null): string {
    const { status, robot } = TEXTS;
    if (state.source === 'simulated' && !state.isPowered) return status.isOff;
    if (state.adapter) return state.adapter === 'out' ? robot.adapterOut : robot.adapterBack;
    if (state.connection !== 'ready') {
        if (state.connection === 'waiting' && state.isPortBusy) return robot.errors['port-busy'];
        if (state.source === 'yours') return robot.connections[state.connection];
        if (state.source === 'servos') return status.searches;
        return state.isLate ? status.startsNot : status.starts;
    }
    const isEdit = state.version?.image === 'edit';
    if (!where) return isEdit ? status.editRuns : status.ready;
    switch (where.state) {
        case 'idle':
        case 'ready':
            return isEdit ? status.editRuns : movedText(where) || status.waits;
        case 'approach':
            return where.page === 0 ? status.moves : status.approaches(motionTitle(state, where.page));
        case 'paused':
            return status.paused(motionTitle(state, where.page), where.step);
        case 'playing':
            return `${status.playing(motionTitle(state, where.page), where.step)}${changedText(where)}`;
        default:
            return where.state satisfies never;
    }
}

/** Speed and size that are not as stored: a motion of size 0 does not move. */
function changedText({ shape }: Where): string {
    const changed = (['rate', 'amplitude'] as const).filter(name => shape && shape[name] !== 100);
    return changed.map(name => ` ${TEXTS.remote.shapes[name]}: ${shape?.[name]} %.`).join('');
}

/** That the robot in the page lies or is held; '' otherwise. What it reported last is not true of another robot, which may not answer. */
export function postureText(
    { source }: Pick<SessionState, 'source'>,
    { hasFallen, isHeld }: Pick<RobotState, 'hasFallen' | 'isHeld'>,
): string {
    if (source !== 'simulated') return '';
    return hasFallen ? TEXTS.status.fallen : isHeld ? TEXTS.status.held : '';
}

/** For announcements of start and end: what the robot does, without steps and preview. */
export function startText(state: SessionState): string {
    const { where } = state;
    if (where === null || where.state === 'idle' || where.state === 'ready' || where.page === 0) return robotText(state, where);
    const motion = motionTitle(state, where.page);
    return where.state === 'paused' ? TEXTS.status.pauses(motion) : TEXTS.status.plays(motion);
}

/** The joints moved by code; '' if there are none. */
function movedText({ aimed }: Where): string {
    const ids = idsIn(aimed);
    return ids.length > 0 ? TEXTS.layers.moved(ids) : '';
}

/** The second page that plays and the joints moved by code, as the robot reports them. The page may be one beyond the document's. */
export function layersText(state: SessionState): string {
    const { where } = state;
    if (where === null) return TEXTS.layers.none;
    const page = Number(where.fields.get('layer') ?? 0);
    const parts = [page > 0 ? TEXTS.layers.laid(motionTitle(state, page)) : '', movedText(where)];
    return parts.filter(Boolean).join(' ') || TEXTS.layers.none;
}

/** When the shape of a play applies, or why not: this page brings Play back, but not to your robot. */
export function shapeText({ version, source }: Pick<SessionState, 'version' | 'source'>): string {
    if (version === null || version.image === 'play') return TEXTS.remote.shaped;
    return source === 'yours' ? TEXTS.robot.editNoRemote(version.board) : TEXTS.remote.shapeNeedsPlay;
}
