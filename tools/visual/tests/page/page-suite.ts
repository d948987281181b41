// SPDX-License-Identifier: MIT
// Setup and teardown of all browser tests.

import { mkdir } from 'node:fs/promises';
import type { Browser, Page } from 'playwright-core';
import { afterEach, beforeAll } from 'vitest';
import { PageServer, Visitor, startBrowser } from './page-bench.ts';
import type { Visit } from './page-bench.ts';

/** Screenshots: build products. */
export const SHOTS = new URL('../../../../build/visual-shots/', import.meta.url).pathname;

export interface PageSuite {
    readonly browser: Browser;
    /** Address of the served page. */
    readonly address: string;
    /** Somebody opens the page, or another address of the server. */
    come(visit?: Visit, address?: string): Promise<Visitor>;
}

const TELL_MS = 20_000;

/** The page's content and state for the report of a failed test. A timed-out wait alone does not say why. */
async function told(page: Page): Promise<string> {
    const shows = page.evaluate(() => {
        type Known = {
            state: { get(): Record<string, unknown> };
            lastFrame: { trunk: unknown; isHeld: boolean; hasFallen: boolean } | null;
        };
        const shell = document.querySelector('app-shell') as unknown as { session: Known } | null;
        const { connection, image, physics, speed, stopped, tab, version, where } = shell?.session.state.get() ?? {};
        const { trunk, isHeld, hasFallen } = shell?.session.lastFrame ?? {};
        const text = (name: string): string => document.querySelector<HTMLElement>(name)?.innerText ?? '';
        const terminal = document.querySelector('terminal-pane') as unknown as { screenText?: string } | null;
        const messages = [text('.start-failed'), text('status-bar')].filter(Boolean).join('\n');
        const shown = ['tour-card', '[role="tabpanel"]:not([hidden])', 'dialog[open]'].map(name => text(name).slice(0, 2000)).join('\n');
        return `${messages}\n${shown}\n${JSON.stringify({ connection, image, physics, speed, stopped, tab, version, where, trunk, isHeld, hasFallen })}\n${terminal?.screenText ?? ''}`;
    });
    const silent = new Promise<string>(resolve => setTimeout(() => resolve('nothing: it has hung'), TELL_MS));
    return Promise.race([shows, silent]).catch((error: unknown) => `nothing: ${String(error)}`);
}

/** Browser and server of all files that run in this process: to start and end them costs more than a visit. They end with the process. */
let shared: Promise<[Browser, PageServer]> | undefined;

async function start(): Promise<[Browser, PageServer]> {
    await mkdir(SHOTS, { recursive: true });
    process.once('SIGTERM', () => process.exit()); // from vitest, which waits half a second; Playwright ends its browser at once, then
    const [browser, server] = await Promise.all([startBrowser(), PageServer.start()]);
    process.once('exit', () => void server.stop());
    return [browser, server];
}

export function pageSuite(): PageSuite {
    const suite: { browser?: Browser; server?: PageServer } = {};
    beforeAll(async () => {
        shared ??= start();
        [suite.browser, suite.server] = await shared;
    });
    // The page of a failed test would keep running during the next one.
    afterEach(async ({ task }) => {
        const pages = suite.browser?.contexts().flatMap(context => context.pages()) ?? [];
        if (task.result?.state === 'fail') {
            console.log(`"${task.name}" failed: ${task.result.errors?.[0]?.message ?? 'no error is known'}`);
            for (const page of pages) console.log(`${page.url()} showed:\n${await told(page)}`);
        }
        for (const context of suite.browser?.contexts() ?? []) await context.close();
    });
    const begun = <T>(part: T | undefined): T => {
        if (part === undefined) throw new Error('asked for before the first test');
        return part;
    };
    return {
        get browser() {
            return begun(suite.browser);
        },
        get address() {
            return begun(suite.server).address;
        },
        come: (visit, address = begun(suite.server).address) => Visitor.come(begun(suite.browser), address, visit),
    };
}
