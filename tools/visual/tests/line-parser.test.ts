// SPDX-License-Identifier: MIT
// Bytes here are written down by hand, as the boards send them (PROTOCOL.md; a recording of Play and Edit).
import { expect, test } from 'vitest';
import { LINE_START, expectAnswer, forgetAnswer, isAnswer, parseLine } from '../robot/line-parser.ts';
import type { LineEvent, LineState } from '../robot/line-parser.ts';
import { randomNumbers } from './robot-bench.ts';

const encode = (text: string): Uint8Array => Uint8Array.from(text, c => c.charCodeAt(0));

function told(events: readonly LineEvent[]): { text: string; answers: string[]; flow: boolean[] } {
    const all = { text: '', answers: [] as string[], flow: [] as boolean[] };
    for (const event of events) {
        if (event.kind === 'text') all.text += String.fromCharCode(...event.bytes);
        else if (event.kind === 'answer') all.answers.push(event.line);
        else all.flow.push(event.go);
    }
    return all;
}

function parseSplit(start: LineState, text: string, random: () => number) {
    const bytes = encode(text);
    const events: LineEvent[] = [];
    let state = start;
    for (let at = 0; at < bytes.length; ) {
        const count = 1 + Math.floor(random() * 12);
        const [next, some] = parseLine(state, bytes.slice(at, at + count));
        state = next;
        events.push(...some);
        at += count;
    }
    return told(events);
}

const asking = (...requests: string[]): LineState => requests.reduce(expectAnswer, LINE_START);

const cases: [string, LineState, string, { text: string; answers?: string[]; flow?: boolean[] }][] = [
    ['nothing asked, all is text', LINE_START, '@ver\r\n@ver image=play OK\r\n] ', { text: '@ver\r\n@ver image=play OK\r\n] ' }],
    [
        'Play: echo, answer and second prompt are taken out',
        parseLine(asking('@ver'), encode('] '))[0],
        '@ver\r\n@ver image=play OK\r\n] ready',
        { text: 'ready', answers: ['@ver image=play OK'] },
    ],
    ['Edit: no echo, no prompt', asking('@ver'), '\r\n@ver image=edit OK\r\nPage', { text: '\r\nPage', answers: ['@ver image=edit OK'] }],
    ['a refusal', asking('@play 300'), '@play ERR 3 Page must be 0..127\r\n', { text: '', answers: ['@play ERR 3 Page must be 0..127'] }],
    [
        'XOFF and XON inside an answer',
        asking('@ver'),
        '@ver im\x13age\x11=edit OK\r\n',
        { text: '', answers: ['@ver image=edit OK'], flow: [false, true] },
    ],
    [
        'two at once',
        asking('@stop', '@where'),
        '@stop OK\r\n@where state=idle OK\r\n',
        { text: '', answers: ['@stop OK', '@where state=idle OK'] },
    ],
    [
        'a line of a person that looks like one',
        asking('@where'),
        'a@where x\r\n@where state=idle OK\r\n',
        { text: 'a@where x\r\n', answers: ['@where state=idle OK'] },
    ],
    [
        'text between echo and answer',
        asking('@where'),
        '] @where\r\nPage 3 step 2\r\n@where state=playing OK\r\n] x',
        { text: '] Page 3 step 2\r\nx', answers: ['@where state=playing OK'] },
    ],
    [
        'an answer behind a screen that Edit is drawing, which has no line ends',
        asking('@crcs 1 2'),
        'HELP explains, EXIT leaves@crcs F1FCEE6C OK\r\n',
        { text: 'HELP explains, EXIT leaves', answers: ['@crcs F1FCEE6C OK'] },
    ],
    ['an address in a text is no answer', asking('@where'), 'mail a@whole.world now', { text: 'mail a@whole.world now' }],
    [
        'not ours: an unknown @ line stays text',
        asking('@where'),
        '@what is this\r\n@where OK\r\n',
        { text: '@what is this\r\n', answers: ['@where OK'] },
    ],
    [
        'a status line right behind the answer',
        asking('@stop'),
        '] @stop\r\n@stop OK\r\nStopped after page 2\r\n] ',
        { text: '] Stopped after page 2\r\n] ', answers: ['@stop OK'] },
    ],
];

test.each(cases)('%s', (_name, state, bytes, wanted) => {
    const { text, answers = [], flow = [] } = { ...wanted };
    for (let seed = 1; seed <= 60; seed++) {
        expect(parseSplit(state, bytes, randomNumbers(seed)), `seed ${seed}`).toEqual({ text, answers, flow });
    }
});

test('noise of any kind never throws and loses no byte while nothing is asked', () => {
    const random = randomNumbers(20261122);
    for (let round = 0; round < 200; round++) {
        const noise = Array.from({ length: 200 }, () => '@] \r\nOK\x1b\xff'.charCodeAt(Math.floor(random() * 10)));
        const text = String.fromCharCode(...noise);
        expect(parseSplit(LINE_START, text, random).text).toBe(text);
    }
});

test('noise while something is asked still lets the answer through', () => {
    const random = randomNumbers(7);
    for (let round = 0; round < 200; round++) {
        const noise = Array.from({ length: 60 }, () => '@] \r\nwhere'.charCodeAt(Math.floor(random() * 10)));
        const bytes = `${String.fromCharCode(...noise)}\r\n@where state=idle OK\r\n`;
        expect(parseSplit(asking('@where'), bytes, random).answers).toEqual(['@where state=idle OK']);
    }
});

test('forgotten requests are text again', () => {
    expect(parseSplit(forgetAnswer(asking('@where')), '@where OK\r\n', randomNumbers(1)).text).toBe('@where OK\r\n');
});

test('isAnswer wants the same word and an end', () => {
    expect(isAnswer('@play 3', '@play OK')).toBe(true);
    expect(isAnswer('@play 3', '@player OK')).toBe(false);
    expect(isAnswer('@play 3', '@play 3')).toBe(false);
});
