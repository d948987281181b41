// SPDX-License-Identifier: MIT
// What every file of browser tests begins and ends with.

import { mkdir } from 'node:fs/promises';
import type { Browser } from 'playwright-core';
import { afterAll, afterEach, beforeAll } from 'vitest';
import { PageServer, startBrowser } from './page-bench.ts';

/** Screenshots: build products. */
export const SHOTS = new URL('../../../../build/visual-shots/', import.meta.url).pathname;

export interface PageSuite {
  readonly browser: Browser;
  /** Of the served page. */
  readonly address: string;
}

/** One browser and one server for all tests of a file; there from its first test to its last. */
export function pageSuite(): PageSuite {
  const suite: { browser?: Browser; server?: PageServer } = {};
  beforeAll(async () => {
    await mkdir(SHOTS, { recursive: true });
    [suite.browser, suite.server] = await Promise.all([startBrowser(), PageServer.start()]);
  });
  // The page of a test that failed would go on working beside the next one.
  afterEach(async () => {
    for (const context of suite.browser?.contexts() ?? []) await context.close();
  });
  afterAll(async () => {
    await suite.browser?.close();
    await suite.server?.stop();
  });
  const begun = <T>(part: T | undefined): T => {
    if (part === undefined) throw new Error('asked for before the first test');
    return part;
  };
  return { get browser() { return begun(suite.browser); }, get address() { return begun(suite.server).address; } };
}
