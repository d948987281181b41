// SPDX-License-Identifier: MIT
// Actions on the chosen steps: buttons, their keys, and the clipboard.

import { stepsFromText, stepsToText } from '../../model/step-text.ts';
import { easyStep, robotPositions } from './editing.ts';
import type { RobotState } from '../../robot/robot-state.ts';
import { copyText } from '../clipboard.ts';
import { keyOf } from '../key-of.ts';
import { define, make, setDisabled } from '../element.ts';
import { TEXTS } from '../texts/texts.ts';
import { watchRobot } from '../watch-robot.ts';
import { SessionElement } from '../session-element.ts';

/** Letters of a line that a message quotes. */
const LINE_SHOWN = 60;

interface Action {
    /** Key of its texts. */
    readonly name: 'insert' | 'duplicate' | 'between' | 'mirrorLeft' | 'mirrorRight' | 'exchange' | 'copy' | 'paste' | 'remove';
    /** Works while the row of steps has the focus. */
    readonly key?: string;
    readonly run: () => void;
    readonly needs: 'nothing' | 'step' | 'two';
}

export class StepActions extends SessionElement {
    /** Last state of the robot in use; null: unknown. */
    private robot: RobotState | null = null;
    private readonly buttons = new Map<Action, HTMLButtonElement>();
    readonly actions: readonly Action[] = [
        { name: 'insert', key: 'Insert', run: () => this.insert(), needs: 'step' },
        { name: 'duplicate', key: 'd', run: () => this.duplicate(), needs: 'step' },
        { name: 'between', key: 'b', run: () => this.between(), needs: 'two' },
        { name: 'mirrorLeft', key: 'm', run: () => this.mirror('right'), needs: 'step' },
        { name: 'mirrorRight', key: 'M', run: () => this.mirror('left'), needs: 'step' },
        { name: 'exchange', key: 'x', run: () => this.exchange(), needs: 'step' },
        { name: 'copy', run: () => void this.copy(), needs: 'step' },
        { name: 'paste', run: () => void this.paste(), needs: 'nothing' },
        { name: 'remove', key: 'Delete', run: () => this.deleteSteps(), needs: 'step' },
    ];

    connectedCallback(): void {
        this.setAttribute('role', 'toolbar');
        this.setAttribute('aria-label', TEXTS.steps.chosen);
        this.replaceChildren(
            ...this.actions.map(action => {
                const hint = TEXTS.steps[`${action.name}Hint`];
                const title = action.key ? TEXTS.steps.withKey(hint, keyName(action.key)) : hint;
                const button = make('button', { title, onclick: action.run }, TEXTS.steps[action.name]);
                this.buttons.set(action, button);
                return button;
            }),
        );
        this.disposals.push(
            this.session.editor.state.watch(() => this.render()),
            watchRobot(this.session, robot => (this.robot = robot)),
        );
    }

    /** Handles a key of the row of steps. true: it was an action's key. */
    key(event: KeyboardEvent): boolean {
        if (event.ctrlKey || event.metaKey || event.altKey) return false;
        const pressed = keyOf(event);
        const action = this.actions.find(({ key }) => key === pressed);
        const button = action && this.buttons.get(action);
        if (!button || button.disabled) return false;
        action.run();
        return true;
    }

    /** Clipboard events, unlike navigator.clipboard, need no permission. */
    onCopy(event: ClipboardEvent): void {
        const text = this.text();
        if (text === '') return; // the page has no steps: the clipboard keeps what it has
        event.clipboardData?.setData('text/plain', text);
        event.preventDefault();
    }

    onCut(event: ClipboardEvent): void {
        this.onCopy(event);
        if (event.defaultPrevented) this.deleteSteps();
    }

    onPaste(event: ClipboardEvent): void {
        this.take(event.clipboardData?.getData('text/plain') ?? '');
        event.preventDefault();
    }

    addFromRobot(): void {
        if (!this.robot) return;
        const { editor } = this.session;
        const { page, step, document } = editor.state.get();
        const count = editor.page(page).steps.length;
        const positions = robotPositions(this.robot);
        const before = count > 0 ? editor.poseAfter(page, step) : positions;
        const at = count > 0 ? step + 1 : 0;
        if (editor.dispatch(editor.edits.insertSteps(document, page, at, [easyStep(positions, before)]))) this.choose(at, 1);
    }

    private render(): void {
        const { editor } = this.session;
        const { page, step } = editor.state.get();
        const count = editor.page(page).steps.length;
        for (const [{ needs }, button] of this.buttons)
            setDisabled(button, needs === 'step' ? count === 0 : needs === 'two' ? step + 1 >= count : false);
    }

    private choose(from: number, count: number): void {
        this.session.editor.select({ step: from, steps: new Set(Array.from({ length: count }, (_, i) => from + i)) });
    }

    private insert(): void {
        const { editor } = this.session;
        const { page, step, document } = editor.state.get();
        const { steps } = editor.page(page);
        const next = steps[step];
        if (!next) return;
        const before = editor.poseAfter(page, step - 1);
        const positions = next.positions.map((to, id) =>
            to === null ? null : Math.round((to + (step > 0 ? (before[id] ?? to) : to)) / 2),
        );
        if (editor.dispatch(editor.edits.insertSteps(document, page, step, [{ ...next, positions, pause: 0 }]))) this.choose(step, 1);
    }

    private duplicate(): void {
        const { editor } = this.session;
        const { page, steps, document } = editor.state.get();
        if (editor.dispatch(editor.edits.duplicateSteps(document, page, steps))) this.choose(Math.max(...steps) + 1, steps.size);
    }

    private between(): void {
        const { editor } = this.session;
        const { page, step, document } = editor.state.get();
        if (editor.dispatch(editor.edits.interpolate(document, page, step))) this.choose(step + 1, 1);
    }

    private mirror(from: 'right' | 'left'): void {
        const { editor } = this.session;
        const { page, steps, document } = editor.state.get();
        editor.dispatch(editor.edits.mirrorSteps(document, page, steps, editor.pairs, from));
    }

    private exchange(): void {
        const { editor } = this.session;
        const { page, steps, document } = editor.state.get();
        editor.dispatch(editor.edits.exchangeSteps(document, page, steps, editor.pairs));
    }

    private deleteSteps(): void {
        const { editor } = this.session;
        const { page, steps, document } = editor.state.get();
        const first = Math.min(...steps);
        if (editor.dispatch(editor.edits.deleteSteps(document, page, steps)))
            this.choose(Math.max(0, Math.min(first, editor.page(page).steps.length - 1)), 1);
    }

    private text(): string {
        const { editor } = this.session;
        const { page, steps } = editor.state.get();
        return stepsToText(editor.page(page).steps.filter((_, index) => steps.has(index)));
    }

    private async copy(): Promise<void> {
        const isCopied = await copyText(this.text());
        this.session.say(isCopied ? { text: TEXTS.steps.copied, tone: 'good' } : { text: TEXTS.steps.noClipboard, tone: 'bad' });
    }

    private async paste(): Promise<void> {
        try {
            this.take(await navigator.clipboard.readText());
        } catch {
            this.session.say({ text: TEXTS.steps.noClipboard, tone: 'bad' });
        }
    }

    private take(text: string): void {
        const { steps, unread } = stepsFromText(text);
        if (steps.length === 0) {
            const why = unread === null ? TEXTS.steps.noSteps : TEXTS.steps.unreadStep(unread.slice(0, LINE_SHOWN));
            return this.session.say({ text: why, tone: 'bad' });
        }
        const { editor } = this.session;
        const { page, document, steps: chosen } = editor.state.get();
        const at = editor.page(page).steps.length === 0 ? 0 : Math.max(...chosen) + 1;
        if (editor.dispatch(editor.edits.insertSteps(document, page, at, steps, 'paste-steps'))) this.choose(at, steps.length);
    }
}

/** The key's name as printed on keyboards. */
function keyName(key: string): string {
    const { insertKey, deleteKey, shiftKey } = TEXTS.steps;
    const letter = key.toUpperCase();
    return { Insert: insertKey, Delete: deleteKey }[key] ?? (key === letter ? `${shiftKey}+${letter}` : letter);
}

define('step-actions', StepActions);
