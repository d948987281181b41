// SPDX-License-Identifier: MIT
// Whether a restart of Edit would lose edits: asked of the real firmware, in simulated time.
import { expect, test } from 'vitest';
import { hasUnsavedEdits } from '../robot/page-requests.ts';
import { connectedEdit } from './connected.ts';
import { makeFormat } from './motion-bench.ts';

const SEED = 20261123;

test('Edit has edits to lose while a page is changed; not as it starts, in an empty page, after a save or an undo', async () => {
    const { bench, connection } = await connectedEdit(SEED);
    const { format } = await makeFormat();
    const typed = async (line: string): Promise<boolean> => {
        await bench.until(connection.write(new TextEncoder().encode(`${line}\r`)));
        await bench.run(50); // time for the line to be sent
        return bench.until(hasUnsavedEdits(connection.requests, format));
    };
    expect(await bench.until(hasUnsavedEdits(connection.requests, format))).toBe(false);
    expect(await typed('page 100')).toBe(false); // page 100 is empty
    expect(await typed('name salute')).toBe(true);
    expect(await typed('save')).toBe(false);
    expect(await typed('name other')).toBe(true);
    expect(await typed('undo')).toBe(false);
}, 300_000);
