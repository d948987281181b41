// SPDX-License-Identifier: MIT
// The port of a servo adapter: a change of rate, a refusal, an unplugged and replugged adapter.
import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { Adapter } from '../servos/adapter.ts';
import { AdapterPorts } from '../servos/adapter-ports.ts';
import { BytePort } from '../sim/byte-port.ts';

const LONG_MS = 5000;

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

class Bench {
    readonly sent: number[] = [];
    readonly rates: number[] = [];
    /** The port takes no further bytes until it resolves. */
    taken: Promise<void> | undefined;
    readonly told: boolean[] = [];
    isPlugged = true;
    isRefused = false;
    readonly port = new BytePort('adapter', bytes => {
        this.sent.push(...bytes);
        return this.taken;
    });
    readonly adapter = new Adapter(() => Promise.resolve(this.isPlugged ? this : null), {
        news: () => undefined,
        isThere: isThere => void this.told.push(isThere),
    });

    get readable() {
        return this.port.readable;
    }

    get writable() {
        return this.port.writable;
    }

    open({ baudRate }: { baudRate: number }): Promise<void> {
        if (this.isRefused) return Promise.reject(new Error('another program has it'));
        this.rates.push(baudRate);
        return this.port.open();
    }

    close(): Promise<void> {
        if (this.port.readable?.locked || this.port.writable?.locked) return Promise.reject(new TypeError('locked'));
        return this.port.close();
    }

    heard(): number[] {
        const bytes = new Uint8Array(4);
        return Array.from(bytes.subarray(0, this.adapter.read(bytes)));
    }
}

async function opened(): Promise<Bench> {
    const bench = new Bench();
    const open = bench.adapter.open(1_000_000);
    await vi.advanceTimersByTimeAsync(LONG_MS);
    await open;
    return bench;
}

test('bytes go both ways, in pieces that the program has room for', async () => {
    const bench = await opened();
    void bench.adapter.write(Uint8Array.of(1, 2));
    for (const piece of [
        [3, 4, 5],
        [6, 7],
    ])
        bench.port.push(Uint8Array.from(piece));
    await vi.advanceTimersByTimeAsync(1);
    expect(bench.sent).toEqual([1, 2]);
    expect([bench.heard(), bench.heard(), bench.heard()]).toEqual([[3, 4, 5, 6], [7], []]);
});

test.each(['takes them', 'is pulled out'])('bytes that the port does not take are waited for until it %s', async end => {
    const bench = await opened();
    let take = (): void => undefined;
    bench.taken = new Promise(resolve => {
        take = resolve;
    });
    const done = vi.fn();
    void bench.adapter.write(Uint8Array.of(1)).then(done);
    await vi.advanceTimersByTimeAsync(LONG_MS);
    expect(done).not.toHaveBeenCalled();
    if (end === 'takes them') take();
    else bench.port.unplug();
    await vi.advanceTimersByTimeAsync(1);
    expect(done).toHaveBeenCalled();
});

test('another rate: the port is opened anew, what was sent before has left, and it goes on', async () => {
    const bench = await opened();
    void bench.adapter.write(Uint8Array.of(1));
    const set = bench.adapter.setRate(57_142);
    await vi.advanceTimersByTimeAsync(LONG_MS);
    await set;
    void bench.adapter.write(Uint8Array.of(2));
    bench.port.push(Uint8Array.of(9));
    await vi.advanceTimersByTimeAsync(1);
    expect(bench.rates).toEqual([1_000_000, 57_142]);
    expect(bench.sent).toEqual([1, 2]);
    expect(bench.heard()).toEqual([9]);
    expect(bench.told).toEqual([]);
});

test('a port that cannot be opened says why; one that is not there, too', async () => {
    const bench = new Bench();
    bench.isRefused = true;
    await expect(bench.adapter.open(1_000_000)).rejects.toThrow('another program has it');
    bench.isPlugged = false;
    await expect(bench.adapter.open(1_000_000)).rejects.toThrow('no such port');
});

test('a plug that is pulled out is told, nothing is sent, and the port is taken again when it is back', async () => {
    const bench = await opened();
    bench.port.push(Uint8Array.of(1));
    bench.isPlugged = false;
    bench.port.unplug();
    await vi.advanceTimersByTimeAsync(LONG_MS);
    expect(bench.told).toEqual([false]);
    expect(bench.adapter.isThere()).toBe(false);
    void bench.adapter.write(Uint8Array.of(5));
    bench.isPlugged = true;
    await vi.advanceTimersByTimeAsync(LONG_MS);
    expect(bench.told).toEqual([false, true]);
    expect(bench.heard()).toEqual([]); // bytes received before the loss are dropped: they answer nothing
    void bench.adapter.write(Uint8Array.of(6));
    await vi.advanceTimersByTimeAsync(1);
    expect(bench.sent).toEqual([6]);
});

test('once it is given back it is not taken again', async () => {
    const bench = await opened();
    await bench.adapter.close();
    await vi.advanceTimersByTimeAsync(LONG_MS);
    expect(bench.rates).toEqual([1_000_000]);
    expect(bench.port.readable).toBe(null);
});

test('a plug that is pulled out while the rate changes is lost, and taken again when it is back', async () => {
    const bench = await opened();
    bench.isRefused = true;
    bench.isPlugged = false;
    const set = bench.adapter.setRate(57_142);
    await vi.advanceTimersByTimeAsync(LONG_MS);
    await set;
    expect(bench.told).toEqual([false]);
    bench.isRefused = false;
    bench.isPlugged = true;
    await vi.advanceTimersByTimeAsync(LONG_MS);
    expect(bench.told).toEqual([false, true]);
});

test('a plug that has a loose contact, and is out again right after it is taken, is not said to be back', async () => {
    const bench = await opened();
    bench.port.unplug();
    await vi.advanceTimersByTimeAsync(1050); // it is open again, and settles
    expect(bench.rates).toHaveLength(2);
    bench.isPlugged = false;
    bench.port.unplug();
    await vi.advanceTimersByTimeAsync(LONG_MS);
    expect(bench.told.at(-1)).toBe(false);
    bench.isPlugged = true;
    await vi.advanceTimersByTimeAsync(LONG_MS);
    expect(bench.told.at(-1)).toBe(true);
});

test('a cable of the same kind is not taken for an adapter that is out; the adapter is, once it is back as a new port', () => {
    const port = (usbProductId: number) => ({ getInfo: () => ({ usbVendorId: 0x0403, usbProductId }) });
    const [chosen, back, cable, later, modem] = [port(1), port(1), port(1), port(1), port(2)];
    const ports = new AdapterPorts(chosen);
    expect(ports.find([cable, chosen])).toBe(chosen);
    expect(ports.find([cable, chosen, later])).toBe(chosen);
    expect(ports.find([cable, later, modem])).toBe(null);
    expect(ports.find([cable, back, later, modem])).toBe(back);
    expect(ports.find([cable, later])).toBe(null);
});
