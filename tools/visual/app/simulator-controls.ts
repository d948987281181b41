// SPDX-License-Identifier: MIT
// What a person can do to the robot in the page besides talking to it: time, power, buttons, battery, servo faults, hands, floor.

import type { SessionState, Floor, Hand, SimControls, PanelButton } from '../view/session/session.ts';
import type { Store } from '../view/store.ts';
import type { SimulatedSource } from './simulated-source.ts';

/** After this time the image has started and answers. */
const STARTED_MS = 1500;

export interface SimulatorEvents {
    /** The robot is switched off or reset, and does not go on with anything. */
    restarts(): void;
    /** Another button of its panel is pressed: Start stops a play, the others begin or steer one. */
    pressed(button: PanelButton): void;
}

export class SimulatorControls implements SimControls {
    private readonly state: Store<SessionState>;
    private readonly robot: Pick<SimulatedSource, 'post' | 'connection'>;
    private readonly events: SimulatorEvents;

    constructor(state: Store<SessionState>, robot: Pick<SimulatedSource, 'post' | 'connection'>, events: SimulatorEvents) {
        this.state = state;
        this.robot = robot;
        this.events = events;
    }

    setSpeed(speed: number): void {
        this.state.set({ speed });
        this.robot.post({ kind: 'speed', speed });
    }

    oneTick(): void {
        this.setSpeed(0);
        this.robot.post({ kind: 'tick' });
    }

    setPower(on: boolean): void {
        if (!on) this.events.restarts();
        this.robot.post({ kind: 'power', on });
        if (on) setTimeout(() => this.robot.connection?.askAgain(), STARTED_MS);
    }

    press(button: PanelButton, down: boolean): void {
        if (down && button === 'mode') this.events.restarts();
        else if (down) this.events.pressed(button);
        this.robot.post({ kind: 'button', button, down });
    }

    setBattery(volts: number): void {
        this.robot.post({ kind: 'battery', volts });
    }

    setFault(servo: number, fault: number, on: boolean): void {
        this.robot.post({ kind: 'fault', servo, fault, answers: on ? -1 : 0 });
    }

    pull(hand: Hand | null, ticks = Infinity): void {
        this.robot.post({ kind: 'grip', grip: hand, ticks });
    }

    hold(held: boolean): void {
        this.robot.post({ kind: 'hold', held });
    }

    setFloor(floor: Floor): void {
        this.robot.post({ kind: 'floor', floor });
    }
}
