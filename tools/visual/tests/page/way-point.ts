// SPDX-License-Identifier: MIT
// Where the curves have their way-points.
import type { Page } from 'playwright-core';

/** Where a person sees a way-point, once it is drawn: the canvas is one picture to the browser. */
export async function wayPoint(page: Page, joint: number, step: number): Promise<{ x: number; y: number }> {
    const at = await page.waitForFunction(
        ([wantedJoint, wantedStep]) => {
            type Drawn = {
                drawing: {
                    scene: { wayPoints: { joint: number; step: number; tick: number; position: number }[] };
                    frame: { x(tick: number): number; y(position: number): number };
                } | null;
            };
            const element = document.querySelector('curve-canvas') as unknown as Element & Drawn;
            const point = element.drawing?.scene.wayPoints.find(one => one.joint === wantedJoint && one.step === wantedStep);
            if (!element.drawing || !point) return null;
            const { frame } = element.drawing;
            const box = element.getBoundingClientRect();
            return { x: box.left + frame.x(point.tick), y: box.top + frame.y(point.position) };
        },
        [joint, step],
    );
    const place = await at.jsonValue();
    if (!place) throw new Error('there is no such way-point');
    return place;
}

/** In Curves: these joints and no others. */
export async function chooseJoints(page: Page, servos: readonly number[]): Promise<void> {
    const chips = page.getByRole('group', { name: 'Joints to edit' }).getByRole('button');
    for (const chip of await chips.all()) {
        const servo = Number.parseInt((await chip.getAttribute('aria-label')) ?? '', 10);
        const isPressed = (await chip.getAttribute('aria-pressed')) === 'true';
        if (!Number.isNaN(servo) && isPressed !== servos.includes(servo)) await chip.click();
    }
}
