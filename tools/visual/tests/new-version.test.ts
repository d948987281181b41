// SPDX-License-Identifier: MIT
// A new version of the page replaces its files on the host, and an open page that the browser does not keep asks for one of the old ones.
import { afterEach, expect, test, vi } from 'vitest';
import { robotImages, servosModule } from '../app/assets.ts';
import { RobotImages } from '../app/robot-images.ts';
import type { ImageParts } from '../app/robot-images.ts';
import { StatusMessages } from '../app/status-messages.ts';
import type { SessionState } from '../view/session/session.ts';
import { Store } from '../view/store.ts';

afterEach(() => {
    vi.unstubAllGlobals();
});

/** What is said, and whether the new version is offered, when the host answers so and Edit is to run. */
async function whenHostAnswers(status: number, load: (image: 'play' | 'edit') => Promise<unknown>) {
    vi.stubGlobal('fetch', () => Promise.resolve(new Response('no', { status })));
    const state = new Store({ image: 'play', hasNewVersion: false } as SessionState);
    const messages = new StatusMessages(state);
    const robot = { restart: (image: 'play' | 'edit') => load(image) } as unknown as ReturnType<ImageParts['robot']>;
    const failed = new Promise<void>(resolve => {
        const fail = (error: unknown): void => {
            messages.fail(error);
            resolve();
        };
        const parts = { state, robot: () => robot, isWriting: () => false, say: () => undefined, fail } as unknown as ImageParts;
        new RobotImages(parts).run('edit');
    });
    await failed;
    const { message, hasNewVersion, image } = state.get();
    return { text: message?.text, hasNewVersion, image };
}

test.each([robotImages, servosModule])('the file is gone: the new version is told and offered', async load => {
    const { text, hasNewVersion, image } = await whenHostAnswers(404, load);
    expect(text).toMatch(/^There is a new version of this page.*Reload the page/);
    expect(hasNewVersion).toBe(true);
    expect(image).toBe('play'); // which goes on
});

test('a host in trouble has no new version', async () => {
    const { text, hasNewVersion } = await whenHostAnswers(503, robotImages);
    expect(text).toMatch(/^The firmware could not be loaded/);
    expect(hasNewVersion).toBe(false);
});
