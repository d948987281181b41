// SPDX-License-Identifier: MIT
// Which steps are chosen. The one that is shown is always one of them.
import { expect, test } from 'vitest';
import { chosenSteps } from '../view/editor/step-choice.ts';
import type { StepChoice } from '../view/editor/step-choice.ts';

const PLAIN = { shiftKey: false, ctrlKey: false, metaKey: false };
const SHIFT = { ...PLAIN, shiftKey: true };
const MORE = [
    { ...PLAIN, ctrlKey: true },
    { ...PLAIN, metaKey: true },
];
const at = (step: number, ...steps: number[]): StepChoice => ({ step, steps: new Set(steps) });

test('alone, a row from the cursor in both directions, and one more', () => {
    expect(chosenSteps(at(1, 1, 2), 4, PLAIN)).toEqual(at(4, 4));
    expect(chosenSteps(at(1, 1), 3, SHIFT)).toEqual(at(3, 1, 2, 3));
    expect(chosenSteps(at(5, 5), 4, SHIFT)).toEqual(at(4, 5, 4));
    for (const keys of MORE) expect(chosenSteps(at(1, 1), 4, keys)).toEqual(at(4, 1, 4));
});

test('one less: the nearest of the others is shown; the last one stays chosen', () => {
    for (const keys of MORE) {
        expect(chosenSteps(at(4, 0, 3, 4), 4, keys)).toEqual(at(3, 0, 3));
        expect(chosenSteps(at(4, 4), 4, keys)).toEqual(at(4, 4));
    }
});
