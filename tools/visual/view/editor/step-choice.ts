// SPDX-License-Identifier: MIT
// Which steps are chosen by a click or a key: one alone, with Shift all from the cursor to it, with Ctrl or Cmd one more or one less.

export interface StepChoice {
    /** The cursor: the step that is shown. */
    readonly step: number;
    readonly steps: ReadonlySet<number>;
}

/** Never none. The cursor is one of the chosen steps: one that is chosen no more is not shown and edited either. */
export function chosenSteps(
    { step, steps }: StepChoice,
    index: number,
    { shiftKey, ctrlKey, metaKey }: Pick<KeyboardEvent, 'shiftKey' | 'ctrlKey' | 'metaKey'>,
): StepChoice {
    let chosen = new Set([index]);
    if (shiftKey) chosen = new Set([...steps, ...Array.from({ length: Math.abs(index - step) + 1 }, (_, i) => Math.min(index, step) + i)]);
    else if (ctrlKey || metaKey) {
        chosen = new Set(steps);
        if (!chosen.delete(index)) chosen.add(index);
        if (chosen.size === 0) chosen.add(index);
    }
    const [nearest = index] = [...chosen].sort((a, b) => Math.abs(a - index) - Math.abs(b - index));
    return { step: nearest, steps: chosen };
}
