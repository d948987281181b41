// SPDX-License-Identifier: MIT
// The bytes are written by hand as in PROTOCOL.md. The CRC was calculated elsewhere.
import { expect, test } from 'vitest';
import { framed, isAnswer, parseLine } from '../robot/line-parser.ts';
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

function parseSplit(text: string, random: () => number) {
    const bytes = encode(text);
    const events: LineEvent[] = [];
    let state: LineState = null;
    for (let at = 0; at < bytes.length; ) {
        const count = 1 + Math.floor(random() * 12);
        const [next, some] = parseLine(state, bytes.slice(at, at + count));
        state = next;
        events.push(...some);
        at += count;
    }
    return told(events);
}

const cases: [string, string, { text: string; answers?: string[]; flow?: boolean[] }][] = [
    ['without a frame all is text', '@ver\r\n@ver image=play OK\r\n] ', { text: '@ver\r\n@ver image=play OK\r\n] ' }],
    ['an answer within a word', 'sett\x1e@ver image=play OK\r\nings', { text: 'settings', answers: ['@ver image=play OK'] }],
    ['an answer within an escape sequence', '\x1b[1\x1e@stop OK\r\n2;3H', { text: '\x1b[12;3H', answers: ['@stop OK'] }],
    ['a refusal', '\x1e@play ERR 3 Page must be 0..127\r\n', { text: '', answers: ['@play ERR 3 Page must be 0..127'] }],
    [
        'XOFF and XON inside an answer',
        '\x1e@ver im\x13age\x11=edit OK\r\n',
        { text: '', answers: ['@ver image=edit OK'], flow: [false, true] },
    ],
    ['two at once', '\x1e@stop OK\r\n\x1e@where state=idle OK\r\n', { text: '', answers: ['@stop OK', '@where state=idle OK'] }],
    ['an answer whose end was lost', '\x1e@where sta\x1e@where state=idle OK\r\n', { text: '', answers: ['@where state=idle OK'] }],
];

test.each(cases)('%s', (_name, bytes, wanted) => {
    const { text, answers = [], flow = [] } = { ...wanted };
    for (let seed = 1; seed <= 60; seed++) {
        expect(parseSplit(bytes, randomNumbers(seed)), `seed ${seed}`).toEqual({ text, answers, flow });
    }
});

test('noise of any kind never throws, and the answer behind it is heard', () => {
    const random = randomNumbers(20261122);
    for (let round = 0; round < 200; round++) {
        const noise = Array.from({ length: 200 }, () => '@] \r\nOK\x1b\xff\x1e'.charCodeAt(Math.floor(random() * 11)));
        const { answers } = parseSplit(`${String.fromCharCode(...noise)}\x1e@where OK\r\n`, random);
        expect(answers.at(-1)).toBe('@where OK');
    }
});

test('a request is framed with its CRC', () => {
    expect(framed('@ver')).toEqual(encode('\x1e@ver 5F4A\r'));
});

test('isAnswer wants the same word and an end, or the refusal of a line that has lost some of it', () => {
    expect(isAnswer('@play 3', '@play OK')).toBe(true);
    expect(isAnswer('@play 3', '@player OK')).toBe(false);
    expect(isAnswer('@play 3', '@play 3')).toBe(false);
    expect(isAnswer('@play 3', '@pla ERR 15 Bytes of this line were lost: nothing was done')).toBe(true);
});
