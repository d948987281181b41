// SPDX-License-Identifier: MIT
// A robot that stands and trembles asks for no new picture; one that moves, also when it creeps, or that shows something else does.
import { expect, test } from 'vitest';
import type { RobotState, ServoState } from '../robot/robot-state.ts';
import { looksDifferent } from '../view/robot-change.ts';

const SERVO: ServoState = { id: 1, goalPos: 512, position: 512, torque: true, alarms: 0, celsius: 30, faults: 0 };
const ROBOT = {
    ticks: 1,
    servos: [SERVO, { ...SERVO, id: 2 }],
    trunk: { pos: [0, 0, 0.3], quat: [1, 0, 0, 0] },
    leds: 1,
    lateMs: 0,
} as unknown as RobotState;
const withServo = (change: Partial<ServoState>): RobotState => ({ ...ROBOT, servos: [SERVO, { ...SERVO, id: 2, ...change }] });

test.each<[string, RobotState | null, boolean]>([
    ['nothing but time', { ...ROBOT, ticks: 2, lateMs: 3 }, false],
    ['a servo that trembles while it holds', withServo({ position: 512.01 }), false],
    ['a warmer servo', withServo({ celsius: 31 }), false],
    ['a trunk that trembles', { ...ROBOT, trunk: { pos: [1e-5, 0, 0.3], quat: [1, 1e-5, 0, 0] } }, false],
    ['a servo a tenth of a unit on', withServo({ position: 512.1 }), true],
    ['a trunk a tenth of a millimetre on', { ...ROBOT, trunk: { pos: [0, 1e-4, 0.3], quat: [1, 0, 0, 0] } }, true],
    ['a trunk that tips', { ...ROBOT, trunk: { pos: [0, 0, 0.3], quat: [1, 0, 2e-4, 0] } }, true],
    ['an alarm', withServo({ alarms: 32 }), true],
    ['another goal', withServo({ goalPos: 513 }), true],
    ['a limp servo', withServo({ torque: false }), true],
    ['a silent servo', withServo({ isSilent: true }), true],
    ['another servo', withServo({ id: 3 }), true],
    ['a servo less', { ...ROBOT, servos: [SERVO] }, true],
    ['nothing is known of it any more', null, true],
])('%s', (_, now, isDifferent) => {
    expect(looksDifferent(ROBOT, now, true)).toBe(isDifferent);
    expect(looksDifferent(now, ROBOT, true)).toBe(isDifferent);
});

test('LEDs count where they can be seen', () => {
    expect(looksDifferent(ROBOT, { ...ROBOT, leds: 7 }, true)).toBe(true);
    expect(looksDifferent(ROBOT, { ...ROBOT, leds: 7 }, false)).toBe(false);
    expect(looksDifferent(null, null, true)).toBe(false);
});
