// SPDX-License-Identifier: MIT
// A trouble in the status bar is removed when its cause is gone, but not before it could be read.
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { watchCauses } from '../app/causes.ts';
import { StatusMessages } from '../app/status-messages.ts';
import type { EditorState } from '../model/editor-state.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { SessionState } from '../view/session/session.ts';
import type { DocumentsState } from '../view/session/documents.ts';
import { Store } from '../view/store.ts';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

function session() {
    const robot = new Store({ connection: 'ready', where: null, message: null } as unknown as SessionState);
    const editor = new Store({ document: {}, page: 0, step: 0 } as unknown as EditorState);
    const documents = new Store({ saving: 'saved' } as unknown as DocumentsState);
    const messages = new StatusMessages(robot);
    watchCauses({ messages, robot, editor, documents });
    const where = (state: string): void => robot.set({ where: { state } as unknown as SessionState['where'] });
    return { robot, editor, documents, messages, where, message: () => robot.get().message?.text ?? null };
}

test('a refused edit: until the next edit, or another page; the cursor alone changes nothing', () => {
    const { editor, messages, message } = session();
    messages.complain('Page 0 holds the trim.', 'edit');
    editor.set({ step: 1 });
    expect(message()).toBe('Page 0 holds the trim.');
    editor.set({ page: 5 });
    expect(message()).toBeNull();
    messages.complain('The page is full.', 'edit');
    editor.set({ document: {} as EditorState['document'] });
    expect(message()).toBeNull();
});

test('a robot that was busy: until what it played has ended, and six seconds at least', () => {
    const { messages, where, message } = session();
    where('playing');
    messages.fail(new RobotError('refused', 'Busy: stop what is playing first'));
    const busy = message();
    expect(busy).toContain('Busy');
    vi.advanceTimersByTime(1000);
    where('idle');
    expect(message()).toBe(busy);
    vi.advanceTimersByTime(5000);
    expect(message()).toBeNull();
});

test('what a robot has said leaves with it, even half a line; a message of the page stays', () => {
    const { messages, message } = session();
    vi.advanceTimersByTime(1000);
    messages.hear(new TextEncoder().encode('Ended after page 1 (ready)\r\nServo 5 does'));
    expect(message()).toBe('Ended after page 1 (ready)');
    messages.leaveRobot();
    expect(message()).toBeNull();
    messages.hear(new TextEncoder().encode(' not answer\r\n'));
    expect(message()).toBe('not answer');
    messages.tell({ text: '18 servos answer.', tone: 'good' });
    messages.leaveRobot();
    expect(message()).toBeNull();
    messages.say({ text: 'Copied.', tone: 'good' });
    messages.leaveRobot();
    expect(message()).toBe('Copied.');
});

test('what was asked while servos are looked for is not blamed on a robot that is off', () => {
    const { robot, messages, message } = session();
    robot.set({ source: 'servos', connection: 'asking' });
    messages.fail(new RobotError('no-answer'));
    expect(message()).toContain('still being looked for');
    robot.set({ connection: 'ready' });
    messages.fail(new RobotError('no-answer'));
    expect(message()).toContain('did not answer');
});

test('a pulled cable: until the robot answers again', () => {
    const { robot, messages, message } = session();
    robot.set({ connection: 'waiting' });
    messages.fail(new RobotError('port-lost'));
    vi.advanceTimersByTime(60_000);
    expect(message()).toContain('The cable was pulled');
    robot.set({ connection: 'ready' });
    expect(message()).toBeNull();
});

test('what could not be kept: until it is kept; and what was said since stays', () => {
    const { documents, editor, messages, message } = session();
    documents.set({ saving: 'off' });
    messages.complain('not kept', 'storage');
    editor.set({ page: 5 });
    documents.set({ saving: 'saving' });
    expect(message()).toBe('not kept');
    messages.say({ text: 'Battery 9.6 V', tone: 'calm' });
    documents.set({ saving: 'saved' });
    expect(message()).toBe('Battery 9.6 V');
    documents.set({ saving: 'off' });
    messages.complain('not kept', 'storage');
    documents.set({ saving: 'saved' });
    expect(message()).toBeNull();
});

test('a step that plays is told beside, counted from 1: what the board says of it is no message', () => {
    const { messages, message } = session();
    const hear = (text: string): void => messages.hear(new TextEncoder().encode(text));
    vi.advanceTimersByTime(1);
    hear('\r\nNext link to page 22 (walk_l)\r\n] ');
    for (const line of ['Playing page 22 (walk_l) step 1 repetition 1', 'Page 22 step 2 repetition 1', 'Page 5 step 0 repetition 12']) {
        hear(`\r${line}\r\n] `);
        expect(message()).toBe('Next link to page 22 (walk_l)');
    }
    hear('\rPage 22 is damaged\r\n] ');
    expect(message()).toBe('Page 22 is damaged');
});

test('why a motion was broken off stays beside its end, and is a trouble', () => {
    const { robot, messages, message } = session();
    const hear = (line: string): void => messages.hear(new TextEncoder().encode(`${line}\r\n`));
    vi.advanceTimersByTime(1);
    hear('Broken off in page 21 (walk_r)'); // by the person
    expect(robot.get().message).toMatchObject({ text: 'Broken off in page 21 (walk_r)', tone: 'calm' });
    for (const why of ['The computer came 0.1 s late: breaking off', 'The servo adapter is gone: plug it in, then on']) {
        hear(why);
        hear('Broken off in page 21 (walk_r)');
        expect(robot.get().message).toMatchObject({ text: `${why}. Broken off in page 21 (walk_r)`, tone: 'bad' });
    }
    expect(message()).toContain('adapter');
});

test('what is kept: the board takes it away by a trouble alone, the page by whatever it says next', () => {
    const { messages, message } = session();
    const hear = (line: string): void => messages.hear(new TextEncoder().encode(`${line}\r\n`));
    const kept = { text: 'This tab has a copy.', tone: 'calm' } as const;
    messages.keep(kept);
    vi.advanceTimersByTime(60_000);
    hear('18 servos: 1-18');
    expect(message()).toBe(kept.text);
    messages.say(null);
    hear('18 servos: 1-18');
    expect(message()).toBe('18 servos: 1-18');
    messages.keep(kept);
    hear('Servo 3 does not answer');
    expect(message()).not.toBe(kept.text);
});

test.each(['Battery is low: 6.5 V', 'Servo 3 is hot: 85 C', 'Servo 5 does not answer'])('"%s" from the board is a trouble', line => {
    const { robot, messages } = session();
    messages.hear(new TextEncoder().encode(`${line}\r\n] `));
    expect(robot.get().message).toEqual({ text: line, tone: 'bad' });
});
