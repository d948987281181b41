// SPDX-License-Identifier: MIT
// A question in a dialog of the page, with answers to choose or a line of text. Escape and Cancel give no answer.

import { make } from '../element.ts';
import { TEXTS } from '../texts/texts.ts';

type Answer = readonly [title: string, value: string];

interface Shown {
    readonly answer: Promise<string | null>;
    close(): void;
}

function show(title: string, answers: readonly Answer[], ...content: HTMLElement[]): Shown {
    const dialog = make('dialog', { class: 'ask-dialog', 'aria-label': title });
    const buttons = answers.map(([text, value], i) => make('button', { value, class: i === 0 ? 'primary' : '' }, text));
    const cancel = make('button', { value: '', formnovalidate: true, type: 'button', onclick: () => dialog.close('') }, TEXTS.page.cancel);
    dialog.append(
        make('form', { method: 'dialog' }, make('h2', {}, title), ...content, make('div', { class: 'buttons' }, cancel, ...buttons)),
    );
    document.body.append(dialog);
    dialog.returnValue = '';
    dialog.showModal();
    const answer = new Promise<string | null>(resolve => {
        dialog.addEventListener('close', () => {
            dialog.remove();
            resolve(dialog.returnValue === '' ? null : dialog.returnValue);
        });
        dialog.addEventListener('cancel', () => {
            dialog.returnValue = '';
        });
    });
    return { answer, close: () => dialog.close('') };
}

/** Resolves with the value of the chosen answer; null: none. */
export function ask(title: string, text: string, answers: readonly Answer[], ...content: HTMLElement[]): Promise<string | null> {
    return show(title, answers, make('p', {}, text), ...content).answer;
}

/** Shows `content` until `done` settles, so that nobody begins something else that its end would interrupt. false: cancelled before. */
export async function awaited(title: string, done: Promise<unknown>, ...content: HTMLElement[]): Promise<boolean> {
    const { answer, close } = show(title, [], ...content);
    try {
        return await Promise.race([answer.then(() => false), done.then(() => true)]);
    } finally {
        close();
    }
}

/** More than blanks, which are trimmed. */
const SOMETHING = '.*\\S.*';

/** Resolves with the trimmed text; null: cancelled. */
export async function askText(
    title: string,
    label: string,
    value: string,
    options: { maxLength?: number; pattern?: string; hint?: string } = {},
): Promise<string | null> {
    const input = make('input', {
        type: 'text',
        value,
        required: true,
        maxlength: options.maxLength ?? 60,
        autofocus: true,
        pattern: options.pattern ?? SOMETHING,
        ...(options.hint ? { title: options.hint } : {}),
    });
    input.addEventListener('focus', () => input.select());
    const answer = await show(
        title,
        [[TEXTS.page.ok, 'ok']],
        make('label', {}, label, input),
        ...(options.hint ? [make('p', {}, options.hint)] : []),
    ).answer;
    return answer === null ? null : input.value.trim();
}
