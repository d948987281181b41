// SPDX-License-Identifier: MIT
// The LEDs on the robot's back are left out of the picture only where the robot itself hides them completely.
import { Raycaster, Vector3 } from 'three';
import type { Mesh } from 'three';
import { expect, test } from 'vitest';
import { RobotFigure } from '../view/robot-figure.ts';
import { BODY } from './motion-bench.ts';

/** Of a lamp's 425 points every seventh is looked at. */
const EVERY = 7;
/** Nearest and usual distance of the camera. */
const EYES_M = [0.3, 1.1];

function bench(): { figure: RobotFigure; lamps: Mesh[]; boxes: Mesh[] } {
    const figure = new RobotFigure(BODY);
    figure.show({ pos: [0.1, 0.2, 0.3], quat: [Math.SQRT1_2, 0, 0, Math.SQRT1_2] }, new Map()); // its front, x, looks along y
    figure.root.updateMatrixWorld(true);
    const of = (shape: RegExp): Mesh[] => figure.meshes.filter(({ userData }) => shape.test(String(userData.shape)));
    return { figure, lamps: of(/^lamp_/), boxes: of(/^(controller|back)$/) };
}

/** The boxes before a lamp hide every point of its surface. */
function isHidden(lamp: Mesh, eye: Vector3, boxes: Mesh[]): boolean {
    const points = lamp.geometry.getAttribute('position');
    const ray = new Raycaster();
    for (let i = 0; i < points.count; i += EVERY) {
        const point = lamp.localToWorld(new Vector3().fromBufferAttribute(points, i));
        const way = point.clone().sub(eye);
        ray.set(eye, way.clone().normalize());
        ray.far = way.length() - 1e-5;
        if (ray.intersectObjects(boxes, false).length === 0) return false;
    }
    return true;
}

test('an LED that is left out is hidden by the boxes before it, from everywhere', () => {
    const { figure, lamps, boxes } = bench();
    expect(lamps).toHaveLength(7);
    let left = 0;
    for (const distance of EYES_M)
        for (let around = 0; around < 360; around += 30)
            for (const up of [-70, -20, -5, 0, 10, 30, 50, 65, 70, 80]) {
                const [a, u] = [(around * Math.PI) / 180, (up * Math.PI) / 180];
                const eye = figure.root.localToWorld(
                    new Vector3(Math.cos(a) * Math.cos(u), Math.sin(a) * Math.cos(u), Math.sin(u)).multiplyScalar(distance),
                );
                figure.hideLamps(eye);
                const outerAndMiddle = lamps.filter((_, i) => i % 3 === 0);
                for (const lamp of outerAndMiddle.filter(({ visible }) => !visible)) {
                    left++;
                    expect(isHidden(lamp, eye, boxes), `${lamp.userData.shape} from ${around}, ${up} degrees at ${distance} m`).toBe(true);
                }
            }
    expect(left).toBeGreaterThan(100);
});

test('from behind they are in the picture, from the front they are not', () => {
    const { figure } = bench();
    figure.hideLamps(figure.root.localToWorld(new Vector3(-0.8, 0.5, 0.4)));
    expect(figure.hasLamps).toBe(true);
    figure.hideLamps(figure.root.localToWorld(new Vector3(0.88, -0.56, 0.12))); // where the camera starts
    expect(figure.hasLamps).toBe(false);
});
