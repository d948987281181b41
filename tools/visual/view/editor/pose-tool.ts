// SPDX-License-Identifier: MIT
// The picture as an editor of the chosen step: shows it, and turns drags and keys into edits. One drag or one held key is one undo step;
// Escape reverts it.

import { anglesOf } from '../../model/body.ts';
import type { Angles, Body } from '../../model/body.ts';
import { dragged, grab, jointAxis } from '../../model/pose-drag.ts';
import type { Grab } from '../../model/pose-drag.ts';
import type { Place } from '../../model/space.ts';
import type { Touch } from '../../model/trial.ts';
import type { RobotState } from '../../robot/robot-state.ts';
import type { Session } from '../session/session.ts';
import type { Gesture } from '../session/editor.ts';
import type { Picked, RobotScene } from '../robot-scene.ts';
import type { Store } from '../store.ts';
import { EditedPose, robotPose } from './edited-pose.ts';
import { changedPositions, isEditing, robotAngles } from './editing.ts';
import type { Editing } from './editing.ts';
import { changeStep, jointsOfPart } from './joint-edits.ts';
import { JointTurn } from './joint-turn.ts';
import { PoseLayer, balanceOf } from './pose-layer.ts';
import type { Balance, Posed } from './pose-layer.ts';
import { TouchWatch } from './touch-watch.ts';

/** Poses whose joints differ by less than this need no ghost (radians). */
const SAME_RAD = 0.02;
const KEY_UNITS = { fine: 1, coarse: 10 };

interface Drag {
    readonly held: Grab;
    readonly picked: Picked;
    gesture: Gesture | null;
}

export class PoseTool {
    readonly layer: PoseLayer;
    private readonly scene: RobotScene;
    private readonly session: Session;
    private readonly editing: Store<Editing>;
    private readonly body: Body;
    private readonly edited: EditedPose;
    private readonly arrows: JointTurn;
    private drag: Drag | null = null;
    /** Trunk of the figure, which the camera follows; null: there is nothing to show. */
    figureTrunk: Place | null = null;
    /** Balance of the edited step; null: it is not shown, or balance is switched off. */
    private balance: Balance | null = null;
    private readonly touchWatch: TouchWatch;

    /** changed: called when show() would show something else, and none of robot, document and settings has changed. */
    constructor(scene: RobotScene, session: Session, editing: Store<Editing>, changed: () => void) {
        this.scene = scene;
        this.session = session;
        this.editing = editing;
        this.body = session.body;
        this.layer = new PoseLayer(session.body);
        this.edited = new EditedPose(session.editor, session.body, editing);
        this.arrows = new JointTurn(session.editor, session.body, (start, positions) =>
            changeStep(session.editor, start, positions, this.edited.robot),
        );
        this.touchWatch = new TouchWatch(session.trials, changed);
        scene.add(this.layer.root);
    }

    /** Drags in the picture change the step. */
    get isPosing(): boolean {
        return isEditing(this.session.state.get().tab) && this.editing.get().mode === 'pose';
    }

    get isDragging(): boolean {
        return this.drag !== null;
    }

    /** Distance of the centre of mass inside the support polygon (metres); null: not computed. */
    get margin(): number | null {
        return this.balance?.margin ?? null;
    }

    /** Limbs of the figure that intersect. */
    get touches(): readonly Touch[] {
        return this.touchWatch.touches;
    }

    /** The edited pose (servo units by ID). */
    get shownPose(): readonly number[] {
        return this.edited.positions;
    }

    /** Updates figure and ghosts. robot: null if nothing is known of it. isInHand: the user drags the figure, so no ghost may cover it.
     *  true: drags edit the shown step. */
    show(robot: RobotState | null, isInHand: boolean): boolean {
        this.edited.robot = robot;
        const real: Posed | null = robot && { trunk: robot.trunk, angles: robotAngles(this.body, robot) };
        const { preview } = this.session;
        const shown = preview.pose();
        const edited = isEditing(this.session.state.get().tab) && preview.state.get().figure === 'step' ? this.shown() : null;
        const isPosing = edited !== null && this.isPosing;
        const alarms = new Set(robot?.servos.filter(servo => servo.alarms !== 0).map(servo => servo.id));
        const figure = shown
            ? { trunk: shown.trunk, angles: anglesOf(this.body, shown.positions, new Map()) }
            : isPosing && edited
              ? edited
              : real;
        this.figureTrunk = figure?.trunk ?? null;
        this.touchWatch.look(edited ? (isPosing ? this.shownPose : robot && robotPose(robot)) : null);
        this.scene.figure.touching = new Set(this.touches.flatMap(({ links }) => links));
        this.scene.figure.chosen = isPosing ? this.chosenLinks() : new Set();
        if (figure) this.scene.figure.show(figure.trunk, figure.angles, isPosing || shown ? new Set() : alarms);
        this.scene.figure.light(robot?.leds ?? 0);
        const other = isInHand ? null : isPosing ? real : edited;
        this.layer.show('ghost', other && !(real && edited && isSame(real.angles, edited.angles)) ? other : null, figure);
        this.showOnion(isInHand ? null : edited, figure);
        this.balance = edited && this.editing.get().balance ? balanceOf(this.body, edited) : null;
        this.layer.showBalance(this.balance);
        return isPosing;
    }

    /** Before a drag: makes the figure the edited step, so that the drag changes a step and not a previewed motion or the robot. */
    showStep(robot: RobotState | null): void {
        if (!this.isPosing || this.session.preview.state.get().figure === 'step') return;
        this.session.preview.showStep();
        this.show(robot, false);
    }

    /** Starts a drag of the picked part and chooses its joints. add: keeps the joints already chosen. */
    down(picked: Picked, add: boolean): void {
        const { angles } = this.edited;
        const held = grab(this.body, picked.shape, picked.link, picked.point, angles, this.edited.stance(angles));
        const joints = jointsOfPart(this.body, held.part);
        const { joints: chosen } = this.session.editor.state.get();
        this.session.editor.select({ joints: new Set(add ? [...chosen, ...joints] : joints) });
        this.drag = { held, picked, gesture: null };
    }

    move(x: number, y: number): void {
        const { drag } = this;
        if (!drag) return;
        const { held } = drag;
        const target =
            held.part.kind === 'joint'
                ? this.scene.dragInPlane(x, y, held.world, jointAxis(held, held.part.joint).axis)
                : this.scene.drag(x, y, held.world);
        const positions = changedPositions(this.body, held.angles, dragged(this.body, held, target, this.editing.get().soleFlat));
        drag.gesture ??= this.session.editor.gesture('set-joints');
        drag.gesture.change(changeStep(this.session.editor, drag.gesture.start, positions, this.edited.robot));
    }

    /** Ends a drag. keep: false reverts it. */
    up(keep: boolean): void {
        const gesture = this.drag?.gesture;
        this.drag = null;
        if (keep) gesture?.finish();
        else gesture?.cancel();
    }

    /** Left and right choose a joint, up and down turn the chosen ones. true: the key was handled. */
    key(event: KeyboardEvent): boolean {
        if (event.key === 'Escape') return this.escape();
        const turn = { ArrowUp: 1, ArrowDown: -1 }[event.key];
        const next = event.shiftKey ? undefined : { ArrowLeft: -1, ArrowRight: 1 }[event.key];
        if (next !== undefined) this.chooseNext(next);
        else if (turn !== undefined) this.turn(turn * (event.shiftKey ? KEY_UNITS.coarse : KEY_UNITS.fine));
        else return false;
        return true;
    }

    /** Ends the edit of a held arrow key. */
    keyUp(): void {
        this.arrows.end(true);
    }

    dispose(): void {
        this.up(true);
        this.keyUp();
        this.layer.dispose();
    }

    private escape(): boolean {
        const isOpen = this.drag !== null || this.arrows.isHeld;
        this.up(false);
        this.arrows.end(false);
        if (!isOpen) this.session.editor.select({ joints: new Set() });
        return true;
    }

    private turn(units: number): void {
        if (this.session.editor.state.get().joints.size === 0) this.chooseNext(1);
        this.arrows.turn(units, () => this.shownPose);
    }

    private chooseNext(by: number): void {
        const ids = this.body.joints.map(joint => joint.servo).sort((a, b) => a - b);
        const [first] = [...this.session.editor.state.get().joints].sort((a, b) => a - b);
        const at = first === undefined ? (by > 0 ? -1 : 0) : ids.indexOf(first);
        const id = ids[(at + by + ids.length) % ids.length];
        if (id !== undefined) this.session.editor.select({ joints: new Set([id]) });
    }

    /** The edited step. During a drag it stands on the same foot as before. */
    private shown(): Posed {
        const { angles } = this.edited;
        return this.edited.posed(angles, this.drag?.held.stance ?? this.edited.stance(angles));
    }

    private showOnion(edited: Posed | null, figure: Posed | null): void {
        const { step } = this.session.editor.state.get();
        const skin = (at: number): Posed | null => (edited && this.editing.get().onionSkin ? this.edited.atStep(at) : null);
        this.layer.show('before', skin(step - 1), figure);
        this.layer.show('after', skin(step + 1), figure);
    }

    private chosenLinks(): Set<string> {
        const { joints } = this.session.editor.state.get();
        return new Set(this.body.joints.filter(joint => joints.has(joint.servo)).map(joint => joint.body));
    }
}

function isSame(a: Angles, b: Angles): boolean {
    return [...a].every(([servo, angle]) => Math.abs(angle - (b.get(servo) ?? 0)) < SAME_RAD);
}
