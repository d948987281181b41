// SPDX-License-Identifier: MIT
// The page uses no host but its own, works under any sub-path, and needs no host at all on the second visit.
import { expect, onTestFinished, test } from 'vitest';
import { PageServer } from './page-bench.ts';
import { pageSuite } from './page-suite.ts';
import { ReleasedPage } from './release.ts';
import { comesLater, weights } from './weight.ts';

const suite = pageSuite();

test('the first load is at most 1 MB, compressed, with both images; physics, Python, My servos and other languages come behind it', () => {
    const { first, physics, python, servos, languages } = weights();
    expect(first).toBeLessThanOrEqual(1_000_000);
    expect(Math.min(physics, python)).toBeGreaterThan(1_000_000); // they exist and are not counted
    expect(servos).toBeGreaterThan(50_000);
    expect(languages).toBeGreaterThan(40_000);
});

test('a release while the page is open, under a sub-path: it goes on with its own files, says that there is a new version, becomes it when asked, and needs no server on the next visit', async () => {
    const page = await ReleasedPage.make();
    onTestFinished(() => page.remove());
    const server = await PageServer.start(page.folder, '--under', '/some/where');
    onTestFinished(() => server.stop());
    const asked: string[] = [];
    const visitor = await suite.come(
        {
            keepsPage: true,
            hasPhysics: true,
            hasPython: true,
            before: async empty => {
                empty.on('request', request => asked.push(request.url()));
            },
        },
        server.address,
    );
    await visitor.untilStanding();
    // The requests so far are the first load: no Python, My servos or other language, and every file is there.
    expect(asked.filter(url => ['python', 'servos', 'languages'].includes(comesLater(url, '') ?? ''))).toEqual([]);
    expect(asked.every(url => url.startsWith(server.address))).toBe(true);
    const caches = (): Promise<string[]> => visitor.page.evaluate(() => window.caches.keys());
    await visitor.page.evaluate(() => navigator.serviceWorker.ready);
    const [old] = await caches();
    await page.release();
    await visitor.page.evaluate(async () => (await navigator.serviceWorker.ready).update());
    const reload = visitor.button('New version: reload');
    await reload.waitFor();
    await visitor.open('Steps');
    await visitor.page
        .getByLabel('Motion file')
        .setInputFiles({ name: 'mine.m512', mimeType: 'text/plain', buffer: Buffer.from('m512 1\n') });
    const dialog = visitor.page.getByRole('dialog', { name: 'That did not work' });
    await dialog.waitFor();
    expect(await dialog.textContent()).not.toMatch(/could not be loaded/); // Python, 5 MB, came from the old version
    await visitor.page.keyboard.press('Escape');
    await server.stop();
    await reload.click();
    await visitor.page.waitForEvent('load');
    await visitor.untilStanding();
    expect(await reload.isVisible()).toBe(false);
    expect((await caches()).filter(name => name === old)).toEqual([]);
    await visitor.leave();
});

test('the policy holds: no code from text, in the page', async () => {
    const visitor = await suite.come();
    // Playwright's own scripts may bypass the policy. A text that the page runs later may not.
    const ran = await visitor.page.evaluate(async () => {
        (setTimeout as (code: string) => void)('document.title = "made from text"');
        await new Promise(resolve => setTimeout(resolve, 200));
        return document.title;
    });
    expect(ran).not.toBe('made from text');
    expect(visitor.faults.join()).toMatch(/content security policy/i);
});
