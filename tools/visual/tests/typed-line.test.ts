// SPDX-License-Identifier: MIT
// A line that somebody types, and the page's questions, which wait for its end.
import { expect, test } from 'vitest';
import type { Clock } from '../robot/clock.ts';
import { Requests } from '../robot/requests.ts';
import { typedLine } from '../robot/typed-line.ts';

test.each([
  ['', 'pla', 'pla'], ['pla', 'y 3', 'play 3'], ['play 3', '\r', ''], ['pl', '\x03', ''], ['pl', '\x15', ''], ['pl', '\x7f', 'p'], ['p', '\x7f\x7f', ''],
  ['', '\x1b[A', ''], ['', '\x1b[12;40R', ''], ['a', '\rb', 'b'], ['', '\t', ''],
])('%j and the keys %j: %j', (before, keys, after) => {
  expect(typedLine(before, keys)).toBe(after);
});

/** A line that keeps what is sent, and a clock that a test moves. */
function bench() {
  const sent: string[] = [];
  const timers = new Map<number, { at: number; call: () => void }>();
  let now = 0;
  let count = 0;
  const clock: Clock = {
    now: () => now,
    after: (delayMs, call) => {
      const key = count++;
      timers.set(key, { at: now + delayMs, call });
      return () => timers.delete(key);
    },
  };
  const pass = (ms: number): void => {
    now += ms;
    for (const [key, { at, call }] of [...timers]) if (at <= now && timers.delete(key)) call();
  };
  const line = { write: async (bytes: Uint8Array) => void sent.push(new TextDecoder().decode(bytes)), expect: () => undefined, forget: () => undefined };
  return { requests: new Requests(line, clock), sent, pass };
}

test('questions wait while somebody types, keep their order, and none is lost', async () => {
  const { requests, sent, pass } = bench();
  const first = requests.ask('@where');
  requests.holdOff(5000); // a key, while a question is under way
  const second = requests.ask('@page 1');
  const third = requests.ask('@pose');
  requests.take('@where state=idle OK');
  expect(await first).toBe('state=idle');
  expect(sent).toEqual(['@where\r']);
  pass(4000);
  requests.holdOff(5000); // another key
  pass(4000);
  expect(sent).toHaveLength(1);
  requests.holdOff(0); // Enter
  expect(sent).toEqual(['@where\r', '@page 1\r']);
  requests.take('@page 1 00 OK');
  requests.take('@pose 1:512:0 OK');
  expect(await second).toBe('1 00');
  expect(await third).toBe('1:512:0');
});

test('a line that is left half typed keeps them back for five seconds only; the time limit of a question counts from its sending', async () => {
  const { requests, sent, pass } = bench();
  requests.holdOff(5000);
  const asked = requests.ask('@where', { timeoutMs: 1000 });
  pass(4999);
  expect(sent).toEqual([]);
  pass(1);
  expect(sent).toEqual(['@where\r']);
  requests.take('@where state=idle OK');
  expect(await asked).toBe('state=idle');
});

test('a line that is lost meanwhile ends them', async () => {
  const { requests, sent, pass } = bench();
  requests.holdOff(5000);
  const asked = requests.ask('@where');
  requests.end('port-lost');
  await expect(asked).rejects.toMatchObject({ code: 'port-lost' });
  pass(6000);
  expect(sent).toEqual([]);
});
