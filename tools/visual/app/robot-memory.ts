// SPDX-License-Identifier: MIT
// The memory of the robot in the page, in the browser. One tab stores that of its robot, because two would overwrite each other. The robot of
// another tab is not kept until the first tab is closed; then it is, and what the first tab has stored meanwhile becomes a backup.

import { PAGE_BYTES, PAGE_COUNT } from '../model/motion.ts';
import { MOTIONS_ADDRESS } from '../sim/board.ts';
import type { SessionState } from '../view/session/session.ts';
import { forgetRobot, loadRobot, saveRobot } from '../view/robot-store.ts';
import type { KeptRobot } from '../view/robot-store.ts';
import { TEXTS } from '../view/texts/texts.ts';
import { motionLibrary } from './assets.ts';
import { holdRobot, robotFreed } from './hold-document.ts';

const KEY = 'cm5';

export interface MemoryEvents {
    change(change: Partial<SessionState>): void;
    /** Stores these motion pages (65,536 bytes) as a backup of the robot in the page. Rejects if it cannot. */
    backUp(image: Uint8Array): Promise<void>;
}

export function motionsIn({ flash }: KeptRobot): Uint8Array {
    return flash.slice(MOTIONS_ADDRESS, MOTIONS_ADDRESS + PAGE_BYTES * PAGE_COUNT);
}

function isSame(a: Uint8Array, b: Uint8Array): boolean {
    return a.length === b.length && a.every((byte, i) => byte === b[i]);
}

/** The motion pages of the robot in the page at start: stored ones, or the motion library. */
export async function simulatedMotions(): Promise<Uint8Array> {
    const kept = await loadRobot(KEY).catch(() => null);
    return kept ? motionsIn(kept) : motionLibrary();
}

export class RobotMemory {
    private readonly events: MemoryEvents;
    private mayKeep: Promise<boolean>;
    /** false: what is stored could not be read, and must not be replaced by what the robot then has: the motions of a new one. */
    private mayStore = true;
    /** What the robot has written and the browser has not stored. */
    private unkept: KeptRobot | null = null;
    /** The robot has written, and its memory has not come yet. */
    private isWriting = false;
    /** What was stored when this tab read or stored it last. */
    private known: KeptRobot | null = null;
    /** Another tab had the memory until now: what is stored may be newer than what this robot began with. */
    private isBehind = false;
    /** The robot was made factory fresh, and the memory of another one is still stored. */
    private isFresh = false;

    constructor(events: MemoryEvents) {
        this.events = events;
        this.mayKeep = this.hold();
    }

    /** What is stored; null: nothing, or it cannot be read, which is reported. */
    async load(): Promise<KeptRobot | null> {
        try {
            this.known = await loadRobot(KEY);
            this.mayStore = true;
            this.isBehind = false;
            return this.known;
        } catch {
            this.mayStore = false;
            this.tellNotKept();
            return null;
        }
    }

    /** The robot has written, and its memory comes when it is at rest. */
    writes(): void {
        this.isWriting = true;
        this.setUnkept(this.unkept);
    }

    /** The robot has written its memory. It counts as unkept until it is stored. */
    written(memories: KeptRobot): Promise<void> {
        this.isWriting = false;
        this.setUnkept(memories);
        return this.keep(memories);
    }

    /** The memory for the robot that follows one with this memory; null: one that has crashed. */
    async passOn(memories: KeptRobot | null): Promise<KeptRobot | null> {
        this.isWriting = false; // what a robot wrote that has crashed since is lost
        this.setUnkept(this.unkept);
        if (!memories) return this.unkept ?? (this.isFresh ? null : this.load());
        if (this.isBehind && !this.unkept && !this.isFresh) return this.load();
        await this.keep(memories);
        return memories;
    }

    /** Never rejects. Errors are reported. */
    async forget(): Promise<void> {
        this.isWriting = false;
        this.setUnkept(null);
        this.isFresh = true;
        if (!(await this.mayKeep)) {
            this.known = null; // what is stored is not the memory that the person has just given up
            return;
        }
        try {
            await this.backUpOther();
            await forgetRobot(KEY);
            this.mayStore = true;
            this.isFresh = false;
        } catch {
            this.tellNotKept();
        }
    }

    /** false: another tab keeps its robot. This one does as soon as that tab is closed. */
    private async hold(): Promise<boolean> {
        const isHeld = await holdRobot();
        this.events.change({ isSecond: !isHeld });
        if (!isHeld) void this.takeOver();
        return isHeld;
    }

    private async takeOver(): Promise<void> {
        await robotFreed();
        this.mayKeep = Promise.resolve(true);
        this.isBehind = true;
        this.events.change({ isSecond: false, message: { text: TEXTS.robot.tookOver, tone: 'good' } });
        if (this.unkept) await this.keep(this.unkept);
        else if (this.isFresh) await this.forget();
    }

    private async keep(memories: KeptRobot): Promise<void> {
        const { unkept } = this;
        if (!(await this.mayKeep)) return;
        try {
            if (!this.mayStore) throw new Error('what is stored could not be read');
            await this.backUpOther();
            await saveRobot(KEY, memories);
            this.isFresh = false;
            if (unkept === this.unkept) this.setUnkept(null); // otherwise the robot has written again
        } catch {
            this.tellNotKept();
        }
    }

    /** Before something is stored: if another tab has stored other motions since this one read them, they become a backup. A backup has no
     *  settings, so the page says that they go. */
    private async backUpOther(): Promise<void> {
        if (!this.isBehind) return;
        const { known } = this;
        const stored = await loadRobot(KEY);
        const differs = (part: (robot: KeptRobot) => Uint8Array): boolean =>
            stored !== null && (!known || !isSame(part(stored), part(known)));
        const said: string[] = [];
        if (stored && differs(motionsIn)) {
            await this.events.backUp(motionsIn(stored));
            said.push(TEXTS.robot.otherBackedUp);
        }
        if (differs(({ eeprom }) => eeprom) || differs(({ servos }) => servos)) said.push(TEXTS.robot.otherSettings);
        if (said.length > 0) this.events.change({ message: { text: said.join(' '), tone: 'calm' } });
        this.isBehind = false;
    }

    private setUnkept(memories: KeptRobot | null): void {
        this.unkept = memories;
        this.events.change({ hasUnkept: memories !== null || this.isWriting });
    }

    private tellNotKept(): void {
        this.events.change({ message: { text: TEXTS.robot.notKept, tone: 'bad' } });
    }
}
