// SPDX-License-Identifier: MIT
// A trouble in the strip goes when its cause has gone, and not before somebody could read it.
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { watchCauses } from '../app/causes.ts';
import { Strip } from '../app/strip.ts';
import type { EditorState } from '../model/editor-state.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { DeskState } from '../view/desk.ts';
import type { DocumentsState } from '../view/documents-desk.ts';
import { Store } from '../view/store.ts';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

function desk() {
    const robot = new Store({ connection: 'ready', where: null, said: null } as unknown as DeskState);
    const editor = new Store({ document: {}, page: 0, step: 0 } as unknown as EditorState);
    const documents = new Store({ saving: 'saved' } as unknown as DocumentsState);
    const strip = new Strip(robot);
    watchCauses({ strip, robot, editor, documents });
    const where = (state: string): void => robot.set({ where: { state } as unknown as DeskState['where'] });
    return { robot, editor, documents, strip, where, said: () => robot.get().said?.text ?? null };
}

test('a refused edit: until the next edit, or another page; the cursor alone changes nothing', () => {
    const { editor, strip, said } = desk();
    strip.complain('Page 0 holds the trim.', 'edit');
    editor.set({ step: 1 });
    expect(said()).toBe('Page 0 holds the trim.');
    editor.set({ page: 5 });
    expect(said()).toBeNull();
    strip.complain('The page is full.', 'edit');
    editor.set({ document: {} as EditorState['document'] });
    expect(said()).toBeNull();
});

test('a robot that was busy: until what it played has ended, and six seconds at least', () => {
    const { strip, where, said } = desk();
    where('playing');
    strip.fail(new RobotError('refused', 'Busy: stop what is playing first'));
    const busy = said();
    expect(busy).toContain('Busy');
    vi.advanceTimersByTime(1000);
    where('idle');
    expect(said()).toBe(busy);
    vi.advanceTimersByTime(5000);
    expect(said()).toBeNull();
});

test('a pulled cable: until the robot answers again', () => {
    const { robot, strip, said } = desk();
    robot.set({ connection: 'waiting' });
    strip.fail(new RobotError('port-lost'));
    vi.advanceTimersByTime(60_000);
    expect(said()).toContain('The cable was pulled');
    robot.set({ connection: 'ready' });
    expect(said()).toBeNull();
});

test('what could not be kept: until it is kept; and what was said since stays', () => {
    const { documents, editor, strip, said } = desk();
    documents.set({ saving: 'off' });
    strip.complain('not kept', 'storage');
    editor.set({ page: 5 });
    documents.set({ saving: 'saving' });
    expect(said()).toBe('not kept');
    strip.say({ text: 'Battery 9.6 V', tone: 'calm' });
    documents.set({ saving: 'saved' });
    expect(said()).toBe('Battery 9.6 V');
    documents.set({ saving: 'off' });
    strip.complain('not kept', 'storage');
    documents.set({ saving: 'saved' });
    expect(said()).toBeNull();
});

test('a step that plays is told beside, counted from 1: what the board says of it is no message', () => {
    const { strip, said } = desk();
    const hear = (text: string): void => strip.hear(new TextEncoder().encode(text));
    vi.advanceTimersByTime(1);
    hear('\r\nNext link to page 22 (walk_l)\r\n] ');
    for (const line of ['Playing page 22 (walk_l) step 1 repetition 1', 'Page 22 step 2 repetition 1', 'Page 5 step 0 repetition 12']) {
        hear(`\r${line}\r\n] `);
        expect(said()).toBe('Next link to page 22 (walk_l)');
    }
    hear('\rPage 22 is damaged\r\n] ');
    expect(said()).toBe('Page 22 is damaged');
});
