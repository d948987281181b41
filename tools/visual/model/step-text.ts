// SPDX-License-Identifier: MIT
// Steps as text for the clipboard: lines of a .m512 file (tools/m512/FORMAT.md, "A step") with plain ticks and positions. The first form is
// written, so that it can be pasted into such a file too. Both are read: the second is how m512 writes steps. Its values are those of the
// joints in the line above, without which nobody knows them. A whole file is opened as a file.
//
//     step 40 pause 8 | 1:600 2:424
//
//     # ID            |   1   2  19            or   row 1 2 19
//     step 40 pause 8 | 600 424   .

import { JOINTS, POSITION_MAX } from './motion.ts';
import { BYTE_MAX } from './page.ts';
import type { Step } from './page.ts';

const LINE = /^step (\d{1,3})(?: pause (\d{1,3}))? \|((?: \S+)*)$/;
const ROW = /^(?:# ID \||row)((?: \d{1,2}(?:\.\.\d{1,2})?)+)$/;
/** A joint that the step does not use: by itself, or because the motion does not. */
const UNUSED = /^(?:-|\.|~\d{1,4})$/;

export function stepsToText(steps: readonly Step[]): string {
    return steps
        .map(({ positions, time, pause }) => {
            const joints = positions.flatMap((position, id) => (position === null ? [] : [` ${id}:${position}`]));
            return `step ${time}${pause > 0 ? ` pause ${pause}` : ''} |${joints.join('')}\n`;
        })
        .join('');
}

function wordsOf(text: string): string[] {
    return text.split(' ').filter(word => word !== '');
}

function linesOf(text: string): string[] {
    return text.split('\n').map(line => line.trim().replaceAll(/\s+/g, ' '));
}

/** IDs of the values in the lines below: "1 2 5..7". null: the line is not one of these. */
function rowFrom(line: string): number[] | null {
    const [, ids] = ROW.exec(line) ?? [];
    if (ids === undefined) return null;
    return wordsOf(ids).flatMap(word => {
        const [first = 0, last = first] = word.split('..').map(Number);
        return Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => first + i);
    });
}

/** [ID, value] of each joint; null: it is not known which value belongs to which joint. */
function pairsFrom(words: readonly string[], row: readonly number[]): [id: number, value: string][] | null {
    const named = words.map(word => /^(\d{1,2}):(\d{1,4})$/.exec(word));
    if (named.every(one => one !== null)) return named.map(([, id, value = '']) => [Number(id), value]);
    return words.length === row.length ? words.map((word, i) => [row[i] ?? JOINTS, word]) : null;
}

function stepFrom(line: string, row: readonly number[]): Step | null {
    const [, time, pause = '0', joints = ''] = LINE.exec(line) ?? [];
    const pairs = pairsFrom(wordsOf(joints), row);
    if (time === undefined || !pairs || Number(time) > BYTE_MAX || Number(pause) > BYTE_MAX) return null;
    const positions = new Array<number | null>(JOINTS).fill(null);
    for (const [id, value] of pairs) {
        const position = UNUSED.test(value) ? null : Number(/^\d{1,4}$/.test(value) ? value : NaN);
        if (id >= JOINTS || (position !== null && !(position <= POSITION_MAX))) return null;
        positions[id] = position;
    }
    return { positions, time: Number(time), pause: Number(pause) };
}

/** Blank lines and indents are ignored. No steps: not a text of steps. unread: the line of the first step that cannot be read, if there is
    one. */
export function stepsFromText(text: string): { steps: Step[]; unread: string | null } {
    const steps: Step[] = [];
    let unread: string | null = null;
    let isText = true;
    let row: readonly number[] = [];
    for (const line of linesOf(text)) {
        const ids = rowFrom(line);
        const step = stepFrom(line, row);
        if (ids) row = ids;
        else if (step) steps.push(step);
        else if (line !== '') isText = false;
        if (!step && line.startsWith('step ')) unread ??= line;
    }
    return { steps: isText ? steps : [], unread };
}
