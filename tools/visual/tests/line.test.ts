// SPDX-License-Identifier: MIT
// A line obeys XOFF and XON, however they arrive.
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { wallClock } from '../robot/clock.ts';
import { Line } from '../robot/line.ts';
import { BytePort } from '../sim/byte-port.ts';

const XON = 0x11;
const XOFF = 0x13;

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

test.each([
    ['XOFF', [XOFF]],
    ['XOFF, then XON and XOFF together', [XOFF, XON, XOFF]],
])('%s: nothing is sent until the last XON', async (_, bytes) => {
    const sent: number[] = [];
    const port = new BytePort('robot', bytes => void sent.push(...bytes));
    await port.open();
    const line = new Line(port, wallClock, { text: () => undefined, answer: () => undefined, lost: () => undefined });
    const [first = XOFF, ...others] = bytes;
    port.push(Uint8Array.of(first));
    await vi.advanceTimersByTimeAsync(1);
    const written = line.write(Uint8Array.of(7));
    port.push(Uint8Array.from(others));
    await vi.advanceTimersByTimeAsync(1);
    expect(sent).toEqual([]);
    port.push(Uint8Array.of(XON));
    await vi.advanceTimersByTimeAsync(1);
    await written;
    expect(sent).toEqual([7]);
    await line.close();
});

test('a write that the port refuses is a lost port, even if the reader notices nothing', async () => {
    const port = new BytePort('robot', () => {
        throw new DOMException('the device has been lost', 'NetworkError');
    });
    await port.open();
    const lost = vi.fn();
    const line = new Line(port, wallClock, { text: () => undefined, answer: () => undefined, lost });
    await expect(line.write(Uint8Array.of(7))).rejects.toMatchObject({ code: 'port-lost' });
    expect(lost.mock.calls).toMatchObject([[{ name: 'NetworkError' }]]);
    await expect(line.write(Uint8Array.of(7))).rejects.toMatchObject({ code: 'not-connected' });
    await line.close();
});
