// SPDX-License-Identifier: MIT
// Another image for the robot in the page or for My servos, when something goes wrong meanwhile.
import { expect, onTestFinished, test, vi } from 'vitest';
import { RobotImages } from '../app/robot-images.ts';
import type { ImageParts } from '../app/robot-images.ts';
import type { PageFormat } from '../model/page-format.ts';
import type { Connection } from '../robot/connection.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { SessionState } from '../view/session/session.ts';
import { Store } from '../view/store.ts';

/** What a test does not name does nothing. */
function imagesWith(parts: Pick<ImageParts, 'state' | 'robot'> & Partial<ImageParts>): RobotImages {
    const nothing = {
        format: {} as PageFormat,
        isWriting: () => false,
        isHalfSent: () => Promise.resolve(false),
        say: () => undefined,
        fail: () => undefined,
    };
    return new RobotImages({ ...nothing, ...parts });
}

test('the adapter is out when another image is to run: the page says that, not that the firmware could not be loaded', async () => {
    const state = new Store({ image: 'play' } as SessionState);
    const out = new RobotError('adapter-out');
    const robot = { restart: () => Promise.reject(out), prepare: vi.fn(), connection: null };
    const told: unknown[] = [];
    const images = imagesWith({
        state,
        robot: () => robot,
        fail: error => told.push(error),
    });
    images.run('edit');
    await vi.waitFor(() => expect(told).toEqual([out]));
    expect(state.get().image).toBe('play');
});

test('a robot that crashes as it starts is not waited for', async () => {
    const state = new Store({ source: 'simulated', image: 'play', connection: 'asking', version: null, stopped: null } as SessionState);
    const robot = { restart: () => Promise.resolve(), prepare: vi.fn(), connection: null };
    const images = imagesWith({
        state,
        robot: () => robot,
    });
    const becomes = expect(images.becomeEdit()).rejects.toMatchObject({ code: 'no-answer' });
    await Promise.resolve();
    state.set({ stopped: 'crashed' });
    await becomes;
    expect(robot.prepare).not.toHaveBeenCalled();
}, 2000);

test.each([
    ['simulated', ['The robot in the page restarts with Edit, the firmware that saves motions.']],
    ['servos', []],
] as const)(
    '%s: who restarts is said of the robot in the page alone',
    async (source, said) => {
        const state = new Store({ source, image: 'play', connection: 'asking', version: null, stopped: null } as unknown as SessionState);
        const robot = { restart: () => Promise.resolve(), prepare: () => Promise.resolve(), connection: null };
        const told: string[] = [];
        const images = imagesWith({
            state,
            robot: () => robot,
            say: ({ text }) => told.push(text),
        });
        const becomes = images.becomeEdit();
        await Promise.resolve();
        state.set({ connection: 'ready', version: { image: 'edit' } as SessionState['version'] });
        await becomes;
        expect(told).toEqual(said);
    },
    2000,
);

test('a key of the remote while the page writes motions: Edit goes on, and it is said that it writes', async () => {
    const ready = { source: 'simulated', image: 'edit', connection: 'ready', version: { image: 'edit' }, physics: 'on', stopped: null };
    const ask = (text: string) => Promise.resolve(text.startsWith('@crcs') ? '0001'.repeat(128) : '0002'); // half of a page is in RAM
    const robot = { restart: vi.fn(), prepare: vi.fn(), connection: { requests: { ask } } };
    const images = imagesWith({
        state: new Store(ready as unknown as SessionState),
        format: { crc: () => 0 } as unknown as PageFormat,
        robot: () => robot as unknown as ReturnType<ImageParts['robot']>,
        isWriting: () => true,
    });
    await expect(images.becomeDriven()).rejects.toMatchObject({ code: 'transfer-busy' });
    expect(robot.restart).not.toHaveBeenCalled();
});

test.each([true, false])(
    'a key of the remote while Edit has a page in RAM that the page has half sent (%s): Play starts, else not',
    async isHalfSent => {
        const ready = { source: 'simulated', image: 'edit', connection: 'ready', version: { image: 'edit' }, physics: 'on', stopped: null };
        const ask = vi.fn((text: string) => Promise.resolve(text.startsWith('@crcs') ? '0001'.repeat(128) : '0002'));
        const told: unknown[] = [];
        const restart = vi.fn(() => Promise.resolve());
        const robot = { restart, prepare: () => Promise.resolve(), connection: { requests: { ask } } };
        const state = new Store(ready as unknown as SessionState);
        restart.mockImplementation(() => Promise.resolve(state.set({ version: { image: 'play' } as SessionState['version'] })));
        const images = imagesWith({
            state,
            format: { crc: () => 0 } as unknown as PageFormat,
            robot: () => robot as unknown as ReturnType<ImageParts['robot']>,
            isHalfSent: () => Promise.resolve(isHalfSent),
            fail: error => told.push(error),
        });
        const driven = images.becomeDriven();
        if (isHalfSent) await driven;
        else await expect(driven).rejects.toMatchObject({ code: 'page-unsaved' });
        expect(restart.mock.calls).toEqual(isHalfSent ? [['play']] : []);
        if (isHalfSent) return;
        images.run('play'); // nor by a button
        await vi.waitFor(() => expect(told).toMatchObject([{ code: 'page-unsaved' }]));
        ask.mockRejectedValue(new RobotError('no-answer'));
        state.set({ speed: 0 });
        images.run('play');
        await vi.waitFor(() => expect(told).toMatchObject([{}, { code: 'time-stands' }]));
        state.set({ speed: 1 });
        images.run('play'); // but a robot that hangs is restarted
        await vi.waitFor(() => expect(restart.mock.calls).toEqual([['play']]));
    },
);

test('a key in Edit may have edited: until the robot says otherwise, leaving the page would lose that', async () => {
    vi.useFakeTimers();
    onTestFinished(() => void vi.useRealTimers());
    const ready = { source: 'simulated', image: 'edit', connection: 'ready', version: { image: 'edit' }, stopped: null, hasEdits: false };
    const state = new Store(ready as unknown as SessionState);
    let ram = '0002';
    const ask = vi.fn((text: string) => Promise.resolve(text.startsWith('@crcs') ? '0001'.repeat(128) : ram));
    const robot = { restart: () => Promise.resolve(), prepare: vi.fn(), connection: { requests: { ask } } };
    const images = imagesWith({
        state,
        format: { crc: () => 0 } as unknown as PageFormat,
        robot: () => robot as unknown as ReturnType<ImageParts['robot']>,
    });
    /** Right behind the key, and when the robot has been asked. */
    const afterKey = async (): Promise<boolean[]> => {
        images.typed();
        const { hasEdits } = state.get();
        await vi.advanceTimersByTimeAsync(2000);
        return [hasEdits, state.get().hasEdits];
    };
    expect(await afterKey()).toEqual([true, true]);
    ram = '0001'; // saved
    expect(await afterKey()).toEqual([true, false]);
    state.set({ source: 'yours' }); // which keeps its edits
    expect(await afterKey()).toEqual([false, false]);
    state.set({ source: 'simulated' });
    ask.mockRejectedValue(new RobotError('no-answer'));
    expect(await afterKey()).toEqual([true, true]);
    images.run('play');
    await vi.advanceTimersByTimeAsync(0);
    expect(state.get().hasEdits).toBe(false);
});

test('a key for My servos with Edit does not wait for the robot in the page, whose time stands still', async () => {
    const state = new Store({
        source: 'simulated',
        image: 'edit',
        connection: 'ready',
        version: { image: 'edit' },
        physics: 'on',
        stopped: null,
    } as unknown as SessionState);
    const never = { requests: { ask: () => new Promise(() => undefined) } };
    const inPage = { restart: vi.fn(), prepare: vi.fn(), connection: never as unknown as Connection };
    const restart = vi.fn(async () =>
        state.set({ stopped: null, connection: 'ready', version: { image: 'play' } as SessionState['version'] }),
    );
    const servos = { restart, prepare: vi.fn(), connection: null };
    let robot: typeof inPage | typeof servos = inPage;
    const images = imagesWith({
        state,
        robot: () => robot,
    });
    void images.becomeDriven();
    await Promise.resolve();
    robot = servos;
    state.set({ source: 'servos', stopped: 'crashed' }); // so there is no edit to ask for
    await images.becomeDriven();
    expect(restart).toHaveBeenCalledWith('play');
    expect(inPage.restart).not.toHaveBeenCalled();
}, 2000);

test('no image can be had, twice at once: the page knows which one goes on', async () => {
    const state = new Store({ source: 'simulated', image: 'play', version: { image: 'play' } } as unknown as SessionState);
    const offline = () => Promise.reject(new TypeError('Failed to fetch'));
    const fail = vi.fn();
    const robot = { restart: offline, prepare: vi.fn(), connection: null };
    const images = imagesWith({
        state,
        robot: () => robot,
        fail,
    });
    images.run('edit');
    images.run('play');
    await vi.waitFor(() => expect(fail).toHaveBeenCalledTimes(2));
    expect(state.get().image).toBe('play');
});

test('another robot is chosen before it is known that the image cannot be had: nothing is changed or said there', async () => {
    const state = new Store({ source: 'simulated', image: 'edit', version: { image: 'edit' } } as unknown as SessionState);
    let offline = (_: Error): void => undefined;
    const restart = () => new Promise<void>((_, reject) => (offline = reject));
    const fail = vi.fn();
    const images = imagesWith({
        state,
        robot: () => ({ restart, prepare: vi.fn(), connection: null }),
        fail,
    });
    images.run('play');
    state.set({ source: 'servos', image: 'play', version: null });
    offline(new TypeError('Failed to fetch'));
    await new Promise(resolve => setTimeout(resolve));
    expect(state.get().image).toBe('play');
    expect(fail).not.toHaveBeenCalled();
});

test('another robot is chosen while the one before is asked for unsaved edits: it is not restarted in its place', async () => {
    const ready = { source: 'simulated', image: 'edit', connection: 'ready', version: { image: 'edit' }, physics: 'on', stopped: null };
    const state = new Store(ready as unknown as SessionState);
    let answer = (_: string): void => undefined;
    const ask = vi.fn(() => new Promise<string>(resolve => (answer = resolve)));
    const asked = { requests: { ask } } as unknown as Connection;
    const inPage = { restart: vi.fn(), prepare: vi.fn(), connection: asked };
    const servos = { restart: vi.fn(), prepare: vi.fn(), connection: null };
    let robot: ReturnType<ImageParts['robot']> = inPage;
    const images = imagesWith({
        state,
        format: { crc: () => 0 } as unknown as PageFormat,
        robot: () => robot,
    });
    const becomes = expect(images.becomeDriven()).rejects.toMatchObject({ code: 'cancelled' });
    await vi.waitFor(() => expect(ask).toHaveBeenCalled());
    robot = servos;
    state.set({ source: 'servos', image: 'play', version: null, connection: 'closed' });
    answer('0000'); // the empty page
    await becomes;
    expect(servos.restart).not.toHaveBeenCalled();
}, 2000);
