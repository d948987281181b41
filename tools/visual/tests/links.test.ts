// SPDX-License-Identifier: MIT
// Links as reported by C, checked against m512 (links that follow), against the player (where a page leads), and by hand.
import { execFileSync } from 'node:child_process';
import { expect, test } from 'vitest';
import { emptyDocument, imageOf, withChanges } from '../model/document.ts';
import type { MotionDocument } from '../model/document.ts';
import { LINK_FIELDS, PARTNER_FIELDS, readPage, writePage } from '../model/page.ts';
import { makeFormat, makeMotion, must } from './motion-bench.ts';
import { randomNumbers } from './robot-bench.ts';

const ROOT = new URL('../../../', import.meta.url).pathname;
const { format, edits } = await makeFormat();
const SEED = 512_016;

/** Thirty pages with random links. Some are damaged, some link to a page that does not exist. */
function tangle(random: () => number): MotionDocument {
    const any = (page: number): number => (random() < 0.4 ? 0 : random() < 0.15 ? page : 1 + Math.floor(random() * 30));
    const pages = emptyDocument(format, '').pages.map((empty, page) => {
        if (page === 0 || page > 30 || random() < 0.1) return empty;
        const step = { positions: Array.from({ length: 31 }, (_, id) => (id === 3 ? 400 + page : null)), time: 8, pause: 0 };
        const steps = [step, step]; // a link is decided when the last step begins, so only a code that arrives earlier counts
        const links = Object.fromEntries([...LINK_FIELDS, ...PARTNER_FIELDS].map(field => [field, any(page)]));
        const bytes = must(
            writePage(format, empty, { ...links, steps, linked1Code: Math.floor(random() * 4), linked2Code: Math.floor(random() * 4) }),
        );
        if (random() < 0.1) bytes[100] = (bytes[100] ?? 0) ^ 1;
        return bytes;
    });
    return { name: 'tangle', pages };
}

const PEER = `
import base64, json, sys
from m512.errors import M512Error
from m512.files import image as raw
from m512.pages import operations
def done(case):
    image = raw.from_bytes(base64.b64decode(case["image"]))
    a, b = case["from"], case["to"]
    try:
        if case["action"] == "copy": operations.copy(image, a, b, True)
        else: operations.renumber(image, a, b, case["action"] == "swap")
    except M512Error:
        return None
    return base64.b64encode(image.to_bytes()).decode()
print(json.dumps([done(case) for case in json.load(sys.stdin)]))
`;

test('copied, moved and exchanged pages, and the links that follow them: as m512 does it', () => {
    const random = randomNumbers(SEED);
    const cases = Array.from({ length: 60 }, (_, i) => {
        const document = tangle(random);
        const [from, to] = [1 + Math.floor(random() * 30), 1 + Math.floor(random() * 30)];
        const action = (['copy', 'move', 'swap'] as const)[i % 3] ?? 'copy';
        return { document, action, from, to: from === to ? 31 : to };
    });
    const input = JSON.stringify(
        cases.map(({ document, ...rest }) => ({ ...rest, image: Buffer.from(imageOf(document)).toString('base64') })),
    );
    const answers = JSON.parse(
        execFileSync(`${ROOT}build/venv/bin/python`, ['-c', PEER], { input, encoding: 'utf8', maxBuffer: 1 << 26 }),
    ) as (string | null)[];
    let compared = 0;
    for (const [i, { document, action, from, to }] of cases.entries()) {
        const edit = { copy: edits.copyPage, move: edits.movePage, swap: edits.swapPages }[action](document, from, to, {
            linksFollow: true,
            replace: action === 'copy',
        });
        const answer = answers[i] ?? null;
        if (!edit.ok || answer === null) continue; // each has its own rules on what it accepts
        const after = imageOf(withChanges(document, edit.value.changes));
        expect(Buffer.from(after).equals(Buffer.from(answer, 'base64')), `seed ${SEED}, case ${i}: ${action} ${from} to ${to}`).toBe(true);
        compared++;
    }
    expect(compared).toBeGreaterThan(30);
});

test('where a page leads is where the player goes, by every code and by a stop', async () => {
    const random = randomNumbers(SEED + 1);
    const player = await makeMotion();
    const pose = new Uint16Array(31).fill(512);
    let led = 0;
    for (let round = 0; round < 6; round++) {
        const document = tangle(random);
        for (const [page, bytes] of document.pages.entries()) player.setPage(page, bytes);
        for (let page = 1; page <= 30; page++) {
            const bytes = document.pages[page] ?? format.empty;
            if (!format.isPlayable(bytes)) {
                expect(format.leads(bytes)).toEqual([]);
                continue;
            }
            const leads = format.leads(bytes);
            for (const code of [0, 1, 2, 3, 255]) {
                expect(player.start(page, pose, { code: code === 255 ? 0 : code })).toBe(true);
                if (code === 255) player.code(255);
                const { marks, ticks } = player.curve(400);
                const next = Array.from({ length: ticks }, (_, tick) => marks[3 * tick] ?? 0).find(at => at !== page) ?? page;
                const kinds = code === 255 ? ['exit'] : ['linked1', 'linked2'];
                const lead =
                    leads.find(one => kinds.includes(one.kind) && (code === 255 || one.code === code)) ??
                    leads.find(one => one.kind === (code === 255 ? 'exit' : 'next'));
                // A damaged or empty page ends the play, as does a linked page 0 with a code. A page that leads to itself continues or ends
                // there.
                const { linked1, linked1Code, linked2, linked2Code } = readPage(format, bytes);
                const ends = code !== 0 && (code === linked1Code ? linked1 : code === linked2Code ? linked2 : 1) === 0;
                const to = lead && !ends && format.isPlayable(document.pages[lead.to] ?? format.empty) ? lead.to : page;
                expect(next, `seed ${SEED + 1}, round ${round}, page ${page}, code ${code}`).toBe(to);
                led += Number(to !== page);
            }
        }
    }
    expect(led).toBeGreaterThan(100);
});

test('what is never followed is no lead: a linked page without a code, a second one with the code of the first, a code of stop, a page above 127', () => {
    const steps = [{ positions: new Array<number | null>(31).fill(null), time: 8, pause: 0 }];
    const leads = (change: Parameters<typeof writePage>[2]): string[] =>
        format.leads(must(writePage(format, format.empty, { steps, ...change }))).map(({ kind, to, code }) => `${kind} ${to} ${code}`);
    expect(leads({ next: 2, exit: 3, linked1: 4, linked2: 5, blendRight: 6, blendLeft: 7 })).toEqual([
        'next 2 0',
        'exit 3 0',
        'blendRight 6 0',
        'blendLeft 7 0',
    ]);
    expect(leads({ linked1: 4, linked1Code: 17, linked2: 5, linked2Code: 17 })).toEqual(['linked1 4 17']);
    expect(leads({ linked1: 4, linked1Code: 254, linked2: 5, linked2Code: 255 })).toEqual(['linked1 4 254']);
    const beyond = must(writePage(format, format.empty, { steps, exit: 9 }));
    beyond[25] = 200; // NEXT_PAGE
    expect(format.leads(format.sealed(beyond))).toEqual([{ kind: 'exit', to: 9, code: 0 }]);
    expect(format.leads(beyond)).toEqual([]); // its checksum is wrong
});

test('a play of a page comes to itself and to all that it leads to; the trim is no play; codes call', () => {
    let document = emptyDocument(format, '');
    const steps = [{ positions: new Array<number | null>(31).fill(null), time: 8, pause: 0 }];
    const put = (page: number, change: Parameters<typeof writePage>[2]): void => {
        document = { ...document, pages: document.pages.with(page, must(writePage(format, format.empty, { steps, ...change }))) };
    };
    put(5, { next: 6, linked1: 7, linked1Code: 3, linked2: 8 });
    put(6, { exit: 5 });
    put(7, { blendLeft: 9 });
    put(8, {});
    put(9, { next: 40 }); // page 40 is empty
    put(20, { code: 12, next: 21 });
    put(21, { next: 20 });
    expect(format.reach(document, 5)).toEqual([5, 6, 7, 9, 40]);
    expect(format.reach(document, 40)).toEqual([40]);
    expect(format.reach(document, 0)).toEqual([]);
    expect([...format.reachByCode(document)]).toEqual([20, 21]);
    expect(readPage(format, document.pages[8] ?? format.empty).steps).toHaveLength(1);
});

test('the code of buttons is what the firmware takes it for: button 5 in a chord counts as not pressed, 6 stops', () => {
    expect([0, 1, 5, 0x80, 0x101, 0x100, 0x201, 0xff].map(buttons => format.remoteCode(buttons))).toEqual([0, 1, 5, 0x80, 1, 0, 0, 0]); // REMOTE.md
});
