// SPDX-License-Identifier: MIT
// Each missing ability of a browser or network is reported in one sentence, and everything else works.
import { expect, test } from 'vitest';
import { PHYSICS, Visitor, startBrowser } from './page-bench.ts';
import { SHOTS, pageSuite } from './page-suite.ts';

const suite = pageSuite();

test('physics that comes late, as over a slow line: the robot plays without it, then a hand holds it until it stands', async () => {
    let arrive = (): void => undefined;
    const arrived = new Promise<void>(resolve => (arrive = resolve));
    const person = await suite.come({
        hasPhysics: true,
        before: page =>
            page.route(PHYSICS, async route => {
                await arrived;
                await route.continue();
            }),
    });
    await person.untilStanding();
    await person.button('Bow').click();
    await person.untilDoing('Playing motion 2 (bow)');
    arrive();
    await person.untilDoing('A hand holds the robot.');
    await person.untilStanding();
    await person.leave();
});

/** In the browser: provides an adapter to choose. */
function withAdapter(): void {
    const port = { getInfo: () => ({}) };
    const { serial } = navigator as unknown as { serial: object };
    Object.assign(serial, { requestPort: () => Promise.resolve(port), getPorts: () => Promise.resolve([port]) });
}

test('My servos whose files cannot be loaded, its program or its worker: that is said, and the robot in the page goes on', async () => {
    let lost = /^$/;
    const person = await suite.come({
        before: async page => {
            await page.addInitScript(withAdapter);
            await page.route(/servos-play|worker/, route => (lost.test(route.request().url()) ? route.abort() : route.continue()));
        },
    });
    await person.untilStanding();
    for (lost of [/servos-play/, /worker/]) {
        await person.press('My servos …');
        await person.untilSaid('The firmware could not be loaded, so the robot goes on as it was.');
        await person.button('Bow').click();
        await person.untilDoing('Playing motion 2 (bow)');
        await person.untilStanding();
    }
    // The console also has the refusals above, and nothing else.
    expect(person.faults.splice(0).filter(fault => !fault.includes('ERR_FAILED'))).toEqual([]);
    await person.leave();
});

interface TraceEvent {
    readonly name: string;
    readonly ts: number;
    /** Microseconds. */
    readonly dur: number;
    readonly tid: number;
    readonly pid: number;
}

/** Copies of a drawn picture: their number, and how many of them the requesting thread waited for. */
function copies(trace: readonly TraceEvent[]): { readonly all: number; readonly waited: number } {
    const reads = trace.filter(({ name }) => name === 'GLES2::ReadPixels');
    const waits = trace.filter(({ name }) => name === 'CommandBufferHelper::Finish');
    const isIn = (outer: TraceEvent, { pid, tid, ts }: TraceEvent): boolean =>
        pid === outer.pid && tid === outer.tid && ts >= outer.ts && ts <= outer.ts + outer.dur;
    return { all: reads.length, waited: reads.filter(read => waits.some(wait => isIn(read, wait))).length };
}

/** Number of colours along a row of the picture. */
function coloursOfRow(canvas: HTMLElement | SVGElement, share: number): number {
    const picture = canvas as HTMLCanvasElement;
    const row = picture.getContext('2d')?.getImageData(0, Math.round(share * (picture.height - 1)), picture.width, 1);
    return new Set(new Uint32Array(row?.data.buffer ?? new ArrayBuffer())).size;
}

test('no graphics chip: the page never waits for a picture of a robot that walks, and floor is below and sky above', async () => {
    const person = await suite.come({ hasPicture: 'drawn' });
    await person.untilStanding();
    await suite.browser.startTracing(person.page, { categories: ['gpu'] });
    await person.button('Walk').click();
    await person.untilScreenSays(/Page 22 step 4.*Page 22 step 4/s);
    const { traceEvents } = JSON.parse((await suite.browser.stopTracing()).toString()) as { readonly traceEvents: readonly TraceEvent[] };
    const { all, waited } = copies(traceEvents);
    expect(all).toBeGreaterThan(0);
    expect(waited).toBe(0);
    const picture = person.page.locator('robot-view canvas');
    await person.page.screenshot({ path: `${SHOTS}page.png` }); // used in the README
    expect(await picture.evaluate(coloursOfRow, 0)).toBeLessThan(await picture.evaluate(coloursOfRow, 1));
    await person.leave();
});

/** A press at the beginning, in the middle or at the end of a line of this text would hit something else, which covers it. */
function coveredPlaces(text: HTMLElement | SVGElement): string[] {
    const range = document.createRange();
    range.selectNodeContents(text);
    return [...range.getClientRects()].flatMap(line =>
        [line.left + 2, line.left + line.width / 2, line.right - 2].flatMap(x => {
            const y = line.top + line.height / 2;
            const hits = document.elementsFromPoint(x, y).find(element => element.matches('pose-bar *') || element === text);
            return hits === text ? [] : [`${Math.round(x)}, ${Math.round(y)}: ${hits?.outerHTML.slice(0, 60) ?? 'nothing'}`];
        }),
    );
}

test('no picture: the sentence that says so can be read, on a phone too, and nobody is told to drag in it', async () => {
    const person = await suite.come({ screen: { width: 1280, height: 800 } });
    const { page } = person;
    const sentence = page.getByText('This browser draws no 3D picture (WebGL is off).');
    const poses = page.locator('pose-bar');
    const tools = await page.context().newCDPSession(page);
    await person.untilStanding();
    for (const isPhone of [false, true]) {
        if (isPhone) await page.setViewportSize({ width: 390, height: 844 });
        await tools.send('Emulation.setTouchEmulationEnabled', { enabled: isPhone });
        await person.inPage(({ editor }) => editor.select({ joints: new Set() }));
        for (const area of ['Steps', 'Curves'] as const) {
            await person.open(area);
            await person.untilSeen();
            expect(await sentence.evaluate(coveredPlaces)).toEqual([]);
            expect(await poses.getByText(/^Drag a joint/).isVisible()).toBe(false);
            expect(await poses.getByRole('button', { name: 'Hand' }).isVisible()).toBe(false);
        }
        await person.open('Steps');
        await person.inPage(({ editor }) => editor.select({ joints: new Set([1, 2, 3, 4, 5, 6]) }));
        await poses.getByRole('spinbutton').first().click({ trial: true }); // the joints' numbers stay, and nothing covers them
        expect(await sentence.evaluate(coveredPlaces)).toEqual([]);
    }
    await tools.send('Emulation.setTouchEmulationEnabled', { enabled: false });
    for (const [width, height] of [
        [640, 360],
        [512, 288],
        [427, 240],
    ] as const) {
        await page.setViewportSize({ width, height }); // a desktop at 200, 250 and 300 %
        for (const field of await poses.getByRole('spinbutton').all()) await field.click({ trial: true });
    }
    await person.leave();
});

test('an old machine: no picture, no serial port, no physics', async () => {
    const browser = await startBrowser('--disable-3d-apis');
    try {
        const person = await Visitor.come(browser, suite.address, {
            before: async page => {
                await page.route(PHYSICS, route => route.abort());
                await page.addInitScript(() => Reflect.deleteProperty(Navigator.prototype, 'serial'));
            },
        });
        await person.page.getByText('This browser draws no 3D picture (WebGL is off). Everything else works; to see the robot').waitFor();
        await person.untilSaid('Physics could not be loaded, so the robot cannot fall.');
        await person.untilStanding();
        await person.press('Your robot …');
        await person.untilSaid(/^This browser cannot reach a serial port\. It needs Web Serial/);
        await person.button('Walk').click();
        await person.untilDoing(/Playing motion 2[12] \(walk_/);
        // The console also has the refusals above, and nothing else.
        expect(person.faults.splice(0).filter(fault => !/ERR_FAILED|WebGL/i.test(fault))).toEqual([]);
        await person.leave();
    } finally {
        await browser.close();
    }
});
