// SPDX-License-Identifier: MIT
// What the page says when a board refuses: a whole sentence, and what to do where something can be done.
import { expect, test } from 'vitest';
import { savePage } from '../robot/page-requests.ts';
import { RobotError } from '../robot/robot-error.ts';
import { EN } from '../view/texts/en.ts';
import { errorText } from '../view/texts/robot.ts';

/** The error of a save that the board refuses so. */
async function refusedSave(number: number, words: string): Promise<string> {
    const ask = () => Promise.reject(new RobotError('refused', words, { number }));
    const error: unknown = await savePage({ ask }, 5, 0x12ab).catch((cause: unknown) => cause);
    return errorText(error as RobotError);
}

test("the board's words end with a full stop", async () => {
    expect(await refusedSave(4, 'Something moves')).toBe('The robot refused: Something moves.');
    expect(await refusedSave(4, 'Something moves.')).toBe('The robot refused: Something moves.');
});

test('a number that a sentence ends with has a full stop: what follows may begin with a number, too', () => {
    expect(errorText(new RobotError('page-changed', '56'))).toMatch(/ Motion: 56\.$/);
    const { errors } = EN.robot;
    const codes = [
        'page-changed',
        'page-mixed',
        'page-not-saved',
        'save-pending',
        'pages-refused',
        'damaged-here',
        'servo-failed',
    ] as const;
    for (const code of codes) expect(errorText(new RobotError(code, '5, 56')), code).toBe(`${errors[code]} 5, 56.`);
});

test('the image to flash is that of the board; where the board is not known, both are named', () => {
    expect(errorText(new RobotError('needs-edit', 'cm2'))).toContain('m512 flash edit-cm2.hex, then try again.');
    expect(errorText(new RobotError('needs-edit', 'cm5'))).toContain('m512 flash edit-cm5.hex, then try again.');
    const { connections, errors } = EN.robot;
    for (const text of [connections.silent, connections.foreign, errors.foreign]) expect(text).toMatch(/edit-cm5\.hex .*edit-cm2\.hex/);
});

test('a board that cannot save: what it lacks, and that nothing is lost', async () => {
    const text = await refusedSave(11, 'No boot loader can write: kept in RAM');
    expect(text).toMatch(/^The robot could not save a motion: .*boot loader.*\. .*Your motions are safe here\.$/);
});
