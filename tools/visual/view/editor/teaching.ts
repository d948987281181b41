// SPDX-License-Identifier: MIT
// Which limbs are being taught by hand, and whether the simulated hand holds the body meanwhile. A robot that refuses has switched those
// servos that obey, so its next state says what is limp.

import type { RobotState } from '../../robot/robot-state.ts';
import type { Session, SessionState } from '../session/session.ts';
import type { Store } from '../store.ts';
import { TEXTS } from '../texts/texts.ts';
import { stillTaught } from './editing.ts';
import type { Editing } from './editing.ts';

export interface LimbGroup {
    readonly title: string;
    readonly isLeg: boolean;
    readonly servos: readonly number[];
}

export type TeachingSession = Pick<Session, 'onFrame' | 'setTorque' | 'say'> & { readonly sim: Pick<Session['sim'], 'hold'> };

export class Teaching {
    private readonly session: TeachingSession;
    private readonly editing: Store<Editing>;
    /** Servos without torque. */
    limp: readonly number[] = [];
    private source: SessionState['source'] = 'simulated';
    /** The simulated hand was made to hold the body. */
    private isCarrying = false;
    /** Legs were released meanwhile. */
    private mustCarry = false;

    constructor(session: TeachingSession, editing: Store<Editing>) {
        this.session = session;
        this.editing = editing;
    }

    isTaught({ servos }: LimbGroup): boolean {
        return servos.every(servo => this.editing.get().taught.has(servo));
    }

    /** Takes the servos without torque; true: others than before. On the simulated robot a taught limb may have torque and stays taught. */
    take(robot: RobotState): boolean {
        const limp = limpOf(robot);
        if (limp.join() === this.limp.join()) return false;
        const { taught } = this.editing.get();
        const still = this.source === 'simulated' ? taught : stillTaught(taught, this.limp, limp);
        this.limp = limp;
        if (still.size < taught.size) this.editing.set({ taught: still });
        return true;
    }

    /** Another robot is used: nothing of it was released. */
    use(source: SessionState['source']): void {
        if (source === this.source) return;
        this.source = source;
        this.isCarrying = this.mustCarry = false;
        this.limp = [];
        this.editing.set({ taught: new Set() });
    }

    /** Releases a limb, or holds it where it is. In the simulation a hand holds the body meanwhile: a pull at an arm would topple the
     *  robot, and limp legs do not carry it. */
    async toggle(group: LimbGroup): Promise<void> {
        const { mustCarry, source } = this;
        const isTaught = this.isTaught(group);
        this.editing.set({ mode: 'hand', follow: false });
        this.mark(group, !isTaught);
        if (!isTaught && source === 'simulated') this.carry(group);
        const isDone = await this.session.setTorque(isTaught, group.servos);
        if (source !== this.source) return; // another robot is used by now
        if (!isDone) this.mark(group, isTaught); // until its next state
        const isLimp = isDone ? !isTaught : await this.isLimp(group.servos, isTaught);
        if (source !== this.source) return;
        this.mark(group, isLimp);
        if (!isTaught && !isLimp) this.mustCarry = mustCarry;
        if (!isLimp) this.letStand();
    }

    async holdAll(): Promise<void> {
        const { taught } = this.editing.get();
        const { source } = this;
        this.editing.set({ taught: new Set() });
        const isDone = await this.session.setTorque(true, this.limp);
        if (source !== this.source) return;
        if (!isDone) {
            this.editing.set({ taught }); // until its next state
            if ((await this.isLimp([...taught], true)) || source !== this.source) return;
            this.editing.set({ taught: new Set([...this.editing.get().taught].filter(servo => !taught.has(servo))) });
        }
        this.letStand();
    }

    private mark(group: LimbGroup, isTaught: boolean): void {
        const { taught } = this.editing.get();
        const others = [...taught].filter(servo => !group.servos.includes(servo));
        this.editing.set({ taught: new Set(isTaught ? [...others, ...group.servos] : others) });
    }

    /** Whether any of these servos is limp in the robot's next state. wasTaught: of a robot that is off nothing changes. */
    private isLimp(servos: readonly number[], wasTaught: boolean): Promise<boolean> {
        return new Promise(resolve => {
            const stop = this.session.onFrame(robot => {
                stop();
                resolve(robot.isPowered ? limpOf(robot).some(servo => servos.includes(servo)) : wasTaught);
            });
        });
    }

    private carry(group: LimbGroup): void {
        this.isCarrying = true;
        this.session.sim.hold(true);
        if (group.isLeg) this.mustCarry = true;
    }

    /** Lets go of the body when nothing is taught any more. After teaching legs the robot may not stand, so the hand stays until Play or
     *  "Let go". */
    private letStand(): void {
        if (this.editing.get().taught.size > 0 || !this.isCarrying) return;
        this.isCarrying = false;
        if (this.mustCarry) {
            this.mustCarry = false;
            return this.session.say({ text: TEXTS.teach.handStays, tone: 'calm' });
        }
        this.session.sim.hold(false);
    }
}

function limpOf({ servos }: RobotState): number[] {
    return servos.filter(servo => !servo.torque).map(servo => servo.id);
}
