// SPDX-License-Identifier: MIT
// Shows a motion in the picture at once, while the robot is still being asked or written, and says what the figure in the picture is.
//
//          an edit, another step or page;
//          its end, or Stop, outside the editing areas  a play is asked for; the scrubber
//   STEP <--------------------------------- SHOWN <-------------------------------------- STEP, ROBOT
//    ^                                        |
//    |  an edit, another step or page         | the robot begins to play
//    +---------------- ROBOT <----------------+

import { jointAngle } from '../model/body.ts';
import type { Body } from '../model/body.ts';
import { JOINTS, MARK_BYTES, TICKS_PER_SECOND } from '../model/motion.ts';
import type { Curve } from '../model/motion.ts';
import { heading, multiply, rotate, turn } from '../model/space.ts';
import type { Place } from '../model/space.ts';
import { wholeCurve } from '../model/whole-curve.ts';
import { Standing } from '../sim/standing.ts';
import { isEditing } from '../view/editor/editing.ts';
import type { SessionState } from '../view/session/session.ts';
import type { Editor } from '../view/session/editor.ts';
import type { Figure, Preview, PreviewState, ShownPose } from '../view/session/preview.ts';
import { Store } from '../view/store.ts';

/** Ticks between two updates of the feet: 64 updates a second. */
const STRIDE = 2;
/** A looping motion is cut after 32 s, but not before it begins anew. */
const LOOP_TICKS = 32 * TICKS_PER_SECOND;
const ORIGIN: Place = { pos: [0, 0, 0], quat: [1, 0, 0, 0] };

export interface PreviewParts {
    readonly body: Body;
    readonly editor: Editor;
    readonly state: Store<SessionState>;
    /** The place of the robot, where the motion begins. */
    trunk(): Place | null;
    /** The robot follows the edited step. It moves, but the picture keeps showing the step. */
    isFollowing(): boolean;
    /** A hand is standing the robot up. It moves, but a motion that is shown keeps the picture. */
    isStoodUp(): boolean;
    /** `shownPage` in the state has changed. */
    pageChanged(): void;
    /** Calls back once at the next frame, with the time in milliseconds. */
    nextFrame(call: (nowMs: number) => void): void;
}

/** A motion and the path of its trunk, computed only as far as it is viewed. */
class ShownMotion {
    readonly curve: Curve;
    private readonly standing: Standing;
    private readonly trunks: Place[] = [];
    private readonly from: Place;

    constructor(body: Body, curve: Curve, from: Place) {
        this.curve = curve;
        this.from = from;
        this.standing = new Standing(body);
    }

    mark(tick: number): { readonly page: number; readonly step: number } {
        const [page = 0, step = 0] = this.curve.marks.subarray(MARK_BYTES * tick);
        return { page, step };
    }

    pose(tick: number): ShownPose {
        while (this.trunks.length * STRIDE <= tick)
            this.trunks.push(
                this.standing.move(joint => jointAngle(joint, this.positions(this.trunks.length * STRIDE)[joint.servo] ?? joint.zero)),
            );
        const [first = ORIGIN] = this.trunks;
        return { positions: this.positions(tick), trunk: moved(this.trunks[Math.floor(tick / STRIDE)] ?? first, first, this.from) };
    }

    private positions(tick: number): Uint16Array {
        return this.curve.goals.subarray(tick * JOINTS, (tick + 1) * JOINTS);
    }
}

/** Moves a place of a path that begins at `first` to the same path from `from`: shifted on the floor, turned about the vertical. */
function moved(place: Place, first: Place, from: Place): Place {
    const about = turn([0, 0, 1], heading(from.quat) - heading(first.quat));
    const [x, y] = rotate(about, [place.pos[0] - first.pos[0], place.pos[1] - first.pos[1], 0]);
    return { pos: [from.pos[0] + x, from.pos[1] + y, place.pos[2]], quat: multiply(about, place.quat) };
}

export class MotionPreview implements Preview {
    readonly state = new Store<PreviewState>({
        figure: 'step',
        page: 0,
        isRunning: false,
        isLooping: false,
        tick: 0,
        ticks: 0,
        at: { page: 0, step: 0 },
    });
    private readonly parts: PreviewParts;
    private motion: ShownMotion | null = null;
    private beganMs: number | null = null;
    private beganTick = 0;
    private isFrameAsked = false;
    private isRobotMoving = false;

    constructor(parts: PreviewParts) {
        this.parts = parts;
        const { editor, state } = parts;
        let before = editor.state.get();
        editor.state.watch(now => {
            const isSame =
                now.document.pages === before.document.pages &&
                now.page === before.page &&
                now.step === before.step &&
                now.law === before.law;
            before = now;
            if (!isSame) this.showStep();
        });
        let tabBefore = state.get().tab;
        state.watch(({ where, tab }) => {
            const isMoving = where !== null && where.state !== 'idle' && where.state !== 'ready';
            const isAside = parts.isFollowing() || editor.state.get().gesture !== null || (this.state.get().isRunning && parts.isStoodUp());
            if (isMoving && !this.isRobotMoving && !isAside) this.showRobot();
            this.isRobotMoving = isMoving;
            const { figure, isRunning } = this.state.get();
            const isOver = figure === 'robot' || (figure === 'shown' && !isRunning && !isEditing(tab));
            if (tab !== tabBefore && !isMoving && isOver) this.showStep(); // a changed tab shows the step
            tabBefore = tab;
        });
    }

    start(page: number, step = 0): boolean {
        if (!this.take(page)) return false;
        this.run(step === 0 ? 0 : this.tickOf(page, step));
        return true;
    }

    /** A play was requested. If the robot already moves, it will refuse, and the picture keeps showing it. */
    playAsked(page: number): void {
        if (!this.isRobotMoving || this.parts.isStoodUp()) this.start(page);
    }

    resume(): void {
        const { tick, ticks, page } = this.state.get();
        if (!this.motion && !this.take(page)) return;
        this.run(tick >= ticks - 1 ? 0 : tick);
    }

    pause(): void {
        if (this.state.get().figure === 'shown') this.rest();
    }

    seek(page: number, tick: number): void {
        if ((!this.motion || this.state.get().page !== page) && !this.take(page)) return;
        this.goTo(tick);
        this.become('shown', { isRunning: false });
    }

    tickOf(page: number, step: number): number {
        if (!this.motion || this.state.get().page !== page) this.take(page);
        const { motion } = this;
        if (!motion) return 0;
        for (let tick = 0; tick < motion.curve.ticks; tick++) {
            const mark = motion.mark(tick);
            if (mark.page === page && mark.step === step + 1) return tick;
        }
        return 0;
    }

    sinceStep(): number {
        const { motion } = this;
        const { tick, at } = this.state.get();
        let first = tick;
        while (motion && first > 0 && motion.mark(first - 1).step === at.step && motion.mark(first - 1).page === at.page) first--;
        return tick - first;
    }

    setLooping(isLooping: boolean): void {
        this.state.set({ isLooping });
    }

    showStep(): void {
        this.motion = null;
        if (this.state.get().figure !== 'step' || this.state.get().ticks > 0) this.become('step', { isRunning: false, tick: 0, ticks: 0 });
    }

    /** A play has begun. Only the robot is shown. */
    showRobot(): void {
        this.become('robot', { isRunning: false });
    }

    pose(): ShownPose | null {
        const { figure, tick } = this.state.get();
        return figure === 'shown' && this.motion ? this.motion.pose(tick) : null;
    }

    private take(page: number): boolean {
        const { editor, body, trunk } = this.parts;
        const curve = wholeCurve(ticks => editor.curve(page, { ticks }), LOOP_TICKS);
        if (!curve || curve.ticks === 0) return false;
        this.motion = new ShownMotion(body, curve, trunk() ?? ORIGIN);
        this.state.set({ page, tick: 0, ticks: curve.ticks });
        return true;
    }

    private run(tick: number): void {
        this.goTo(tick);
        this.beganTick = this.state.get().tick;
        this.beganMs = null;
        this.become('shown', { isRunning: true });
        this.ask();
    }

    private ask(): void {
        if (this.isFrameAsked) return;
        this.isFrameAsked = true;
        this.parts.nextFrame(nowMs => {
            this.isFrameAsked = false;
            this.advance(nowMs);
        });
    }

    private advance(nowMs: number): void {
        const { isRunning, isLooping, ticks } = this.state.get();
        if (!isRunning) return;
        this.beganMs ??= nowMs;
        const tick = this.beganTick + Math.floor(((nowMs - this.beganMs) * TICKS_PER_SECOND) / 1000);
        if (tick < ticks) this.goTo(tick);
        else if (isLooping) return this.run(0);
        else {
            this.goTo(ticks - 1);
            return this.rest();
        }
        this.ask();
    }

    /** The motion ends or is paused. Its pose stays in the picture only where steps are edited: elsewhere people look at the robot. */
    private rest(): void {
        if (isEditing(this.parts.state.get().tab)) this.become('shown', { isRunning: false });
        else this.showStep();
    }

    private goTo(tick: number): void {
        const { motion } = this;
        if (!motion) return;
        const at = Math.max(0, Math.min(Math.round(tick), motion.curve.ticks - 1));
        this.state.set({ tick: at, at: motion.mark(at) });
    }

    private become(figure: Figure, change: Partial<PreviewState>): void {
        this.state.set({ figure, ...change });
        const { page } = this.state.get();
        const shownPage = figure === 'shown' ? page : null;
        if (this.parts.state.get().shownPage === shownPage) return;
        this.parts.state.set({ shownPage, shownName: this.parts.editor.page(page).name });
        this.parts.pageChanged();
    }
}
