// SPDX-License-Identifier: MIT
// What is drawn of the balance is what was computed, however many corners the soles make.
import type { LineLoop } from 'three';
import { expect, test } from 'vitest';
import type { Point } from '../model/balance.ts';
import { PoseLayer } from '../view/editor/pose-layer.ts';
import { BODY as body } from './motion-bench.ts';

test('the support polygon has as many corners as the soles, on one foot and on two', () => {
    const layer = new PoseLayer(body);
    const ground = layer.root.children[0] as LineLoop;
    for (const corners of [4, 6, 8, 5, 4]) {
        const polygon = Array.from({ length: corners }, (_, i): Point => [corners, i]);
        layer.showBalance({ polygon, centre: [0, 0, 0.2], margin: 0.01 });
        const { array } = ground.geometry.getAttribute('position');
        expect(Array.from(array).filter((_, i) => i % 3 !== 2)).toEqual(polygon.flat());
    }
    layer.dispose();
});
