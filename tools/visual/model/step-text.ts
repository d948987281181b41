// SPDX-License-Identifier: MIT
// Steps as text for the clipboard: lines of a .m512 file (tools/m512/FORMAT.md, "A step") with plain ticks and positions, so that they can
// be pasted there too. Only this form is read back; a whole file is opened as a file.
//
//     step 40 pause 8 | 1:600 2:424

import { JOINTS, POSITION_MAX } from './motion.ts';
import { BYTE_MAX } from './page.ts';
import type { Step } from './page.ts';

const LINE = /^step (\d{1,3})(?: pause (\d{1,3}))? \|((?: \d{1,2}:\d{1,4})*)$/;

export function stepsToText(steps: readonly Step[]): string {
    return steps
        .map(({ positions, time, pause }) => {
            const joints = positions.flatMap((position, id) => (position === null ? [] : [` ${id}:${position}`]));
            return `step ${time}${pause > 0 ? ` pause ${pause}` : ''} |${joints.join('')}\n`;
        })
        .join('');
}

function stepFrom(line: string): Step | null {
    const [, time, pause, joints = ''] = LINE.exec(line) ?? [];
    if (time === undefined || Number(time) > BYTE_MAX || Number(pause ?? 0) > BYTE_MAX) return null;
    const positions = new Array<number | null>(JOINTS).fill(null);
    for (const [, id, position] of joints.matchAll(/(\d+):(\d+)/g)) {
        if (Number(id) >= JOINTS || Number(position) > POSITION_MAX) return null;
        positions[Number(id)] = Number(position);
    }
    return { positions, time: Number(time), pause: Number(pause ?? 0) };
}

/** null: not a text of steps. Blank lines and indents are ignored. */
export function stepsFromText(text: string): Step[] | null {
    const lines = text
        .split('\n')
        .map(line => line.trim().replaceAll(/\s+/g, ' '))
        .filter(line => line !== '');
    const steps = lines.map(stepFrom);
    return steps.length > 0 && steps.every(step => step !== null) ? steps : null;
}
