// SPDX-License-Identifier: MIT
// Checks and links: figures from the manufacturers' data sheets and small documents calculated by hand.
import { expect, test } from 'vitest';
import { PageChecks, checkLinks, checkPage } from '../model/checks.ts';
import { emptyDocument, pageOf, withChanges } from '../model/document.ts';
import type { MotionDocument } from '../model/document.ts';
import { linkGraph } from '../model/links.ts';
import type { HeaderChange } from '../model/page-edits.ts';
import type { Step } from '../model/page.ts';
import { BODY as body, libraryDocument, makeFormat, makeMotion, must } from './motion-bench.ts';

const { format, edits } = await makeFormat();
const player = await makeMotion();

function options(document: MotionDocument, volts = 9.6) {
    for (const [page, bytes] of document.pages.entries()) player.setPage(page, bytes);
    const curve = (page: number) => (player.start(page, player.firstPose(page, new Uint16Array(31).fill(512))) ? player.curve(2000) : null);
    return { format, body, topSpeed: player.topSpeed(volts), curve };
}

function step(positions: Readonly<Record<number, number>>, time = 50): Step {
    return { positions: Array.from({ length: 31 }, (_, id) => positions[id] ?? null), time, pause: 0 };
}

function withPage(document: MotionDocument, page: number, steps: readonly Step[], header: HeaderChange = {}): MotionDocument {
    const filled = withChanges(document, must(edits.insertSteps(document, page, 0, steps)).changes);
    return withChanges(filled, must(edits.setHeader(filled, page, header)).changes);
}

test('a step of 300 units in 20 ticks without a ramp is told, with how much too fast it is; the same in 60 ticks is not', () => {
    const fast = withPage(emptyDocument(format, ''), 5, [step({ 3: 512 }), step({ 3: 812 }, 20)], { accelTime: 0 });
    const [found, ...others] = checkPage(fast, 5, options(fast)).filter(one => one.kind === 'too-fast');
    expect(others).toEqual([]);
    expect(found).toMatchObject({ page: 5, step: 1, joint: 3 });
    expect(found?.amount).toBeCloseTo(15 / 6.8, 1); // 90 % of 7.5 units per tick (body/README.md)
    const slow = withPage(emptyDocument(format, ''), 5, [step({ 3: 512 }), step({ 3: 812 }, 60)], { accelTime: 0 });
    expect(checkPage(slow, 5, options(slow)).filter(one => one.kind === 'too-fast')).toEqual([]);
});

test('of a fast step, the slow ones around it are not told; of a leap into the next motion, the worst; a finding goes when its cause goes', () => {
    const slow = [step({ 3: 200 }), step({ 3: 500 }, 20), step({ 3: 520 }, 100)];
    let document = withPage(emptyDocument(format, ''), 5, slow, { accelTime: 0 });
    const found = checkPage(document, 5, options(document)).filter(one => one.kind === 'too-fast');
    expect(found.map(one => one.step)).toEqual([1]);

    document = withPage(emptyDocument(format, ''), 60, [step({ 3: 200 })], { accelTime: 0, next: 62 });
    document = withPage(document, 61, [step({ 3: 500 })], { accelTime: 0, next: 62 });
    document = withPage(document, 62, [step({ 3: 800 }, 20)], { accelTime: 0, next: 63 });
    document = withPage(document, 63, [step({ 3: 800 }, 20)]);
    const checks = new PageChecks();
    const told = (now: MotionDocument) =>
        checks
            .look(now, options(now))
            .filter(one => one.kind === 'too-fast')
            .map(one => `${one.page}.${one.step} after ${one.after}`);
    expect(told(document)).toEqual(['62.0 after 60']);
    const changed = (pages: ReadonlyMap<number, Uint8Array>): MotionDocument =>
        withChanges(document, must(edits.replacePages(document, pages)).changes);
    const of = (position: number): Uint8Array =>
        pageOf(withPage(emptyDocument(format, ''), 62, [step({ 3: position }, 20)], { next: 63 }), 62);
    expect(told(changed(new Map([[62, of(230)]])))).toEqual(['62.0 after 61', '63.0 after 62']);
    expect(told(document)).toEqual(['62.0 after 60']);
});

test('no page of the library is too fast for its servos at 12 V, or damaged; a changed byte is', async () => {
    const library = await libraryDocument();
    const found = library.pages.flatMap((_, page) => checkPage(library, page, options(library, 12)));
    expect(found.filter(one => one.kind === 'too-fast' || one.kind === 'damaged' || one.kind === 'out-of-reach')).toEqual([]);
    const bytes = library.pages[2]?.slice() ?? new Uint8Array(512);
    bytes[70] = (bytes[70] ?? 0) ^ 1;
    const damaged = withChanges(library, must(edits.replacePages(library, new Map([[2, bytes]]))).changes);
    expect(checkPage(damaged, 2, options(damaged))).toMatchObject([{ kind: 'damaged', page: 2, step: null, fault: 'checksum' }]);
});

test('a joint beyond its stop, and a robot that leans too far to stand', () => {
    const standing = Object.fromEntries(body.joints.map(joint => [joint.servo, Math.round(joint.zero)]));
    const leaning = { ...standing, 15: 512 + 160, 16: 512 - 160 }; // both ankles
    const elbow = body.joints.find(joint => joint.name === 'right_elbow');
    const document = withPage(emptyDocument(format, ''), 5, [
        step(standing),
        { ...step(leaning), pause: 60 },
        step({ ...standing, [elbow?.servo ?? 0]: 1023 }),
    ]);
    const found = checkPage(document, 5, options(document));
    expect(found.filter(one => one.kind === 'tips-over').map(one => one.step)).toEqual([1]);
    expect(found.filter(one => one.kind === 'out-of-reach').map(one => [one.step, one.joint])).toEqual([[2, elbow?.servo]]);
});

test('a pose that a motion goes through without a stop may lean; at its end it may not', () => {
    const standing = Object.fromEntries(body.joints.map(joint => [joint.servo, Math.round(joint.zero)]));
    const leaning = { ...standing, 15: 512 + 160, 16: 512 - 160 };
    const through = withPage(emptyDocument(format, ''), 5, [step(leaning), step(standing)]);
    const into = withPage(emptyDocument(format, ''), 5, [step(standing), step(leaning)]);
    const tips = (document: MotionDocument) =>
        checkPage(document, 5, options(document))
            .filter(one => one.kind === 'tips-over')
            .map(one => one.step);
    expect(tips(through)).toEqual([]);
    expect(tips(into)).toEqual([1]);
});

test('our own library has nothing to be told, at the nominal voltage too', async () => {
    const library = await libraryDocument();
    const found = [...library.pages.flatMap((_, page) => checkPage(library, page, options(library))), ...checkLinks(format, library)];
    expect(found).toEqual([]);
    expect(linkGraph(format, library).links.filter(link => link.isDead)).toEqual([]);
});

test('the graph: dead ends, pages that nothing reaches, exits that go round', () => {
    let document = emptyDocument(format, '');
    const links: Record<number, HeaderChange> = {
        1: { code: 1, next: 2, exit: 3, linked1: 4, linked1Code: 4, linked2: 9 }, // linked2, and linked1 of page 2, have no code: not followed
        2: { exit: 3, blendLeft: 5, linked1: 9 },
        3: { exit: 2 },
        4: { next: 50 },
        5: {},
        6: { next: 7 },
        7: { next: 6 },
    };
    for (const [page, header] of Object.entries(links)) document = withPage(document, Number(page), [step({ 1: 512 })], header);
    const graph = linkGraph(format, document);
    expect(graph.links.map(({ from, to, kind, code }) => `${from} ${kind} ${to}${code ? ` by ${code}` : ''}`)).toEqual([
        '1 next 2',
        '1 exit 3',
        '1 linked1 4 by 4',
        '2 exit 3',
        '2 blendLeft 5',
        '3 exit 2',
        '4 next 50',
        '6 next 7',
        '7 next 6',
    ]);
    expect(graph.links.filter(link => link.isDead)).toMatchObject([{ from: 4, to: 50 }]);
    expect(graph.nodes.filter(node => node.isUnreachable).map(node => node.page)).toEqual([6, 7]);
    expect(graph.nodes.filter(node => node.exitsRound).map(node => node.page)).toEqual([1, 2, 3]);
    expect(checkLinks(format, document).map(({ kind, page }) => `${kind} ${page}`)).toEqual([
        'exit-circle 1',
        'exit-circle 2',
        'exit-circle 3',
    ]);
});
