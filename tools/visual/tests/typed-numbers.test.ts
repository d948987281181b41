// SPDX-License-Identifier: MIT
// Numbers typed into the fields of Steps: what is not possible changes nothing, and it is said which are. What was said goes with the next one.
import { expect, test } from 'vitest';
import { DocumentEditor } from '../app/editor.ts';
import type { Body } from '../model/body.ts';
import { setStepField, setTimes } from '../view/editor/typed-numbers.ts';
import { libraryDocument, makeFormat, makeMotion } from './motion-bench.ts';

const { format } = await makeFormat();
const library = await libraryDocument();
const player = await makeMotion();
const [BOW, STEP] = [3, 1];

function steps() {
    const nothing = (): void => undefined;
    const events = { changed: nothing, refused: nothing, opened: nothing };
    const editor = new DocumentEditor({ joints: [] } as unknown as Body, { format, player, document: library }, events);
    editor.select({ page: BOW });
    let said: string | null = null;
    const say = (notice: { readonly text: string } | null): void => {
        said = notice?.text ?? null;
    };
    return { editor, parts: { editor, say }, page: () => editor.page(BOW), said: () => said };
}

test.each(['0', '256', '-3', '', '1.5', '1e2'])('"%s" times', typed => {
    const { parts, page, said } = steps();
    setTimes(parts, '7');
    setTimes(parts, typed);
    expect(page().repetitions).toBe(7);
    expect(said()).toBe('Nothing was changed: whole numbers from 1 to 255 are possible here.');
    setTimes(parts, '7');
    expect(said()).toBeNull(); // also when nothing changes
});

test.each(['1', '255'])('%s times', typed => {
    const { parts, page, said } = steps();
    setTimes(parts, typed);
    expect(page().repetitions).toBe(Number(typed));
    expect(said()).toBeNull();
});

test.each(['0', '0.004', '-1', '', '3'])('a step of "%s" seconds', typed => {
    const { editor, parts, said } = steps();
    const before = editor.state.get().document;
    setStepField(parts, STEP, 'time', typed);
    expect(editor.state.get().document).toBe(before);
    expect(said()).toBe('Nothing was changed: from 0.01 to 1.99 seconds are possible here.');
    setStepField(parts, STEP, 'time', '0.01');
    expect(editor.state.get().document).not.toBe(before);
    expect(said()).toBeNull();
});

test('a pause may be none, and the increment above the longest is the longest', () => {
    const { parts, page, said } = steps();
    setStepField(parts, STEP, 'pause', '0');
    expect(page().steps[STEP]?.pause).toBe(0);
    setStepField(parts, STEP, 'time', '2');
    expect(page().steps[STEP]?.time).toBe(255);
    expect(said()).toBeNull();
});
