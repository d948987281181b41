// SPDX-License-Identifier: MIT
// What Curves says of the servos in physics.
import { expect, test } from 'vitest';
import { lagText } from '../view/texts/editor.ts';
import { BODY as body } from './motion-bench.ts';

const NOTHING = { chosen: [], lags: new Map<number, number>(), isUnknown: false };

test('physics is said to be asked only while there is a line to ask for', () => {
    expect(lagText({ ...NOTHING, chosen: [13] }, body)).toBe('Asking physics …');
    expect(lagText(NOTHING, body)).toBe('Choose a joint to see its servo.'); // a motion without steps, or one that does not use the joint
});

test('the answer, in degrees, or that there is none', () => {
    const units = Math.PI / 18 / (body.joints.find(({ servo }) => servo === 13)?.radiansPerUnit ?? NaN);
    expect(lagText({ ...NOTHING, chosen: [13], lags: new Map([[13, units]]) }, body)).toBe(
        'Thin: the servos; behind by up to 10° (joint 13).',
    );
    expect(lagText({ ...NOTHING, isUnknown: true }, body)).toMatch(/^Physics cannot tell/);
});
