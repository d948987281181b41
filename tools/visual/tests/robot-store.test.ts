// SPDX-License-Identifier: MIT
// The memory of the robot in the page: what the disk has not taken is not reported as stored. And a storage that does not answer at all.
import { afterEach, expect, test, vi } from 'vitest';
import { BrowserStorage } from '../view/document-storage.ts';
import { LastPuts } from '../view/last-puts.ts';
import { forgetRobot, loadRobot, saveRobot } from '../view/robot-store.ts';

const ROBOT = { flash: new Uint8Array(1), eeprom: new Uint8Array(1), servos: new Uint8Array(1) };

afterEach(() => {
    vi.unstubAllGlobals();
    vi.useRealTimers();
});

/** A database that takes every request. A full disk aborts its transactions afterwards, as browsers do. */
function disk({ isFull }: { isFull: boolean }): void {
    const full = new DOMException('no room', 'QuotaExceededError');
    const answered = (result: unknown, after = (): void => undefined) => {
        const request = { result, onsuccess: (): void => undefined };
        setTimeout(() => {
            request.onsuccess();
            after();
        });
        return request;
    };
    const transaction = () => {
        const one = { error: isFull ? full : null, oncomplete: (): void => undefined, onabort: (): void => undefined };
        const end = (): void => void setTimeout(() => (isFull ? one.onabort() : one.oncomplete()));
        const store = { put: () => answered('cm5', end), delete: () => answered(undefined, end) };
        return Object.assign(one, { objectStore: () => store });
    };
    vi.stubGlobal('indexedDB', { open: () => answered({ transaction, close: () => undefined }) });
}

test('a disk that is full', async () => {
    disk({ isFull: true });
    await expect(saveRobot('cm5', ROBOT)).rejects.toThrow('no room');
    await expect(forgetRobot('cm5')).rejects.toThrow('no room');
});

test('a disk with room', async () => {
    disk({ isFull: false });
    await saveRobot('cm5', ROBOT);
    await forgetRobot('cm5');
});

test('a storage that does not answer counts as none after a few seconds, and one that answers later is let go', async () => {
    vi.useFakeTimers();
    const close = vi.fn();
    const asked: { result: object; onsuccess?: () => void }[] = [];
    vi.stubGlobal('indexedDB', { open: () => (asked[asked.length] = { result: { close } }) });
    for (const open of [() => loadRobot('cm5'), () => BrowserStorage.open(), () => LastPuts.open()]) {
        let is = 'waiting';
        open().catch((error: Error) => (is = error.message));
        await vi.advanceTimersByTimeAsync(6000);
        expect(is).toBe('the storage does not answer');
        asked.at(-1)?.onsuccess?.();
    }
    expect(close).toHaveBeenCalledTimes(3);
});
