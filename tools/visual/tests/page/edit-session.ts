// SPDX-License-Identifier: MIT
// A session with Edit's full screen, typed into the terminal of the page.
import { expect } from 'vitest';
import type { Visitor } from './page-bench.ts';

/** Names page 100 and saves it. The terminal must be open. Returns when Edit shows nothing unsaved. */
export async function nameAndSave(person: Visitor, name: string): Promise<void> {
    await person.untilScreenSays('PageNumber');
    await person.type('page 100\r');
    await person.untilScreenSays('PageNumber:0100');
    await person.type(`name ${name}\r`);
    await person.untilScreenSays(name);
    await person.untilScreenSays(/\* unsaved/);
    await person.type('save\r');
    await expect.poll(async () => (await person.screen()).includes('* unsaved')).toBe(false);
}
