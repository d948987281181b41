// SPDX-License-Identifier: MIT
// Finds the way-points of the curves.
import type { Page } from 'playwright-core';

/** The place of a way-point on the screen once it is drawn. To the browser the canvas is a single picture. */
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

/** In Curves: selects exactly these joints. */
export async function chooseJoints(page: Page, servos: readonly number[]): Promise<void> {
    const chips = page.getByRole('group', { name: 'Joints to edit' }).getByRole('button');
    for (const chip of await chips.all()) {
        const servo = Number.parseInt((await chip.getAttribute('aria-label')) ?? '', 10);
        const isPressed = (await chip.getAttribute('aria-pressed')) === 'true';
        if (!Number.isNaN(servo) && isPressed !== servos.includes(servo)) await chip.click();
    }
}
