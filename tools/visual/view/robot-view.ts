// SPDX-License-Identifier: MIT
// The picture of the robot. Mouse or finger turn the camera. On the robot they grab and pull a limb or, while a step is edited, change the
// step (editor/pose-tool.ts). Two fingers always control the camera. Keys: Shift and arrows turn the camera, Page Up and Page Down raise
// and lower it, + and - zoom, P pushes.

import type { Joint } from '../model/body.ts';
import { limbTo } from '../model/ik.ts';
import type { Touch } from '../model/trial.ts';
import type { RobotState } from '../robot/robot-state.ts';
import { EDITING_START } from './editor/editing.ts';
import type { Editing } from './editor/editing.ts';
import { PoseTool } from './editor/pose-tool.ts';
import { define, make, setText, withoutMenu } from './element.ts';
import { Fingers } from './fingers.ts';
import { keyOf } from './key-of.ts';
import { PictureFrames } from './picture-frames.ts';
import { PictureQuality } from './picture-quality.ts';
import { looksDifferent } from './robot-change.ts';
import { RobotScene } from './robot-scene.ts';
import type { Picked } from './robot-scene.ts';
import { Store } from './store.ts';
import { pushRobot } from './push.ts';
import { jointTitle } from './texts/robot.ts';
import { TEXTS } from './texts/texts.ts';
import { watchRobot } from './watch-robot.ts';
import type { Hand } from './session/session.ts';
import { SessionElement } from './session-element.ts';
import './robot-view.css';

/** Mark in the browser's performance timeline: the robot is visible for the first time. */
const ROBOT_DRAWN = 'robot-drawn';
const TURN_RAD = 0.12;
const NEARER = 0.9;
/** A finger, which is wider than an arm of the robot, grabs it from up to this distance. CSS pixels. */
const FINGER_PX = 14;
/** Events after which the picture may look different. */
const TOUCHES = ['pointerdown', 'pointermove', 'pointerup', 'pointercancel', 'pointerleave', 'wheel', 'keydown', 'keyup', 'blur'];
const AROUND = Array.from({ length: 8 }, (_, i) => (i * Math.PI) / 4);

export class RobotView extends SessionElement {
    editing = new Store<Editing>(EDITING_START);
    /** Element that covers part of the lower edge; the robot is shifted up for it. */
    cover: HTMLElement | null = null;
    private pose: PoseTool | null = null;
    private scene: RobotScene | null = null;
    private quality = new PictureQuality(false);
    /** Last state of the robot in use; null: unknown. */
    private state: RobotState | null = null;
    /** The state that the picture shows. */
    private placed: RobotState | null = null;
    private frames: PictureFrames | null = null;
    private grabbed: (Picked & Hand) | null = null;
    private taught: readonly number[] = [];
    /** Pointer that holds the robot. */
    private holder: number | null = null;
    /** The user has turned the camera while the robot was driven. */
    private isLookedRound = false;
    private readonly label = make('div', { class: 'joint-label', 'aria-hidden': 'true' });
    /** The link whose joint the label names. */
    private labelled: string | null = null;
    private readonly spoken = make('p', { class: 'visually-hidden', role: 'status', 'aria-label': TEXTS.picture.chosenJoint });
    private readonly canvas = make('canvas', { tabindex: 0, role: 'img', 'aria-label': TEXTS.picture.robot });
    private readonly fingers = new Fingers(this.canvas, () => this.endDrag());

    connectedCallback(): void {
        this.append(this.canvas, this.label, this.spoken);
        try {
            this.scene = new RobotScene(this.canvas, this.session.body, () => this.ask());
        } catch {
            this.replaceChildren(make('p', { class: 'no-picture' }, TEXTS.page.noWebGl));
            this.dataset.picture = 'none';
            return;
        }
        this.quality = new PictureQuality(this.scene.isSoftware);
        this.pose = new PoseTool(this.scene, this.session, this.editing, () => this.ask());
        this.drawFrames(this.scene);
        this.watchSize(this.scene);
        this.watchTheme(this.scene);
        this.listen();
        this.watchShown(this.scene);
        this.disposals.push(() => {
            this.pose?.dispose();
            this.scene?.dispose();
            this.scene = null;
        });
    }

    /** Nothing in the picture changes, and the camera is at rest. */
    get isStill(): boolean {
        return this.frames?.isAtRest !== false;
    }

    /** Distance of the edited step's centre of mass inside the support polygon (metres); null: not computed. */
    get margin(): number | null {
        return this.pose?.margin ?? null;
    }

    /** A ghost of the robot or of the edited step is shown with the figure. */
    get hasGhost(): boolean {
        return this.pose?.layer.hasGhost === true;
    }

    /** Limbs of the figure that intersect; computed while a step is edited. */
    get touches(): readonly Touch[] {
        return this.pose?.touches ?? [];
    }

    /** Screen position of a shape of the robot (name in the body file), in CSS pixels; null: there is no such shape or no picture. */
    placeOf(shape: string): { readonly x: number; readonly y: number } | null {
        const at = this.scene?.placeOf(shape);
        if (!at) return null;
        const box = this.canvas.getBoundingClientRect();
        return { x: box.left + ((at[0] + 1) / 2) * box.width, y: box.top + ((1 - at[1]) / 2) * box.height };
    }

    tilt(front: number, left: number): void {
        this.scene?.tilt(front, left);
    }

    private drawFrames(scene: RobotScene): void {
        let isDrawn = false;
        const frames = new PictureFrames(this.quality, {
            isBusy: () => scene.isBusy,
            draw: elapsedMs => this.draw(scene, elapsedMs),
            shown: () => (isDrawn ||= this.placed !== null && performance.mark(ROBOT_DRAWN) !== null),
            resize: () => this.resize(scene),
        });
        this.frames = frames;
        this.disposals.push(() => {
            frames.dispose();
            this.frames = null; // a late answer asks for nothing
        });
    }

    /** Something shown has changed. The only place that asks for a frame. */
    private ask(): void {
        this.frames?.ask();
    }

    /** Asks for a frame when what the picture is made from changes. Size, theme, camera and string: the scene asks. */
    private watchShown(scene: RobotScene): void {
        const ask = (): void => this.ask();
        const { session } = this;
        let before = session.state.get();
        this.disposals.push(
            watchRobot(session, state => {
                this.state = state;
                if (!this.label.hidden) this.showJoint(this.labelled); // the joint moves under the mouse
                if (looksDifferent(this.placed, state, scene.figure.hasLamps)) ask();
            }),
            session.state.watch(now => {
                if (now.tab !== before.tab || now.where?.state !== before.where?.state) ask(); // not at every answer of the robot
                before = now;
            }),
            session.editor.state.watch(ask),
            session.preview.state.watch(ask),
            this.editing.watch(ask),
        );
        for (const touch of TOUCHES) this.canvas.addEventListener(touch, ask, { capture: true });
    }

    private draw(scene: RobotScene, elapsedMs: number): { readonly isNew: boolean; readonly isMoving: boolean } {
        this.place(scene, elapsedMs);
        if (this.grabbed) scene.pull(this.grabbed);
        return scene.draw(elapsedMs);
    }

    private place(scene: RobotScene, elapsedMs: number): void {
        this.placed = this.state;
        this.pose?.show(this.state, this.holder !== null);
        if (!this.label.hidden) this.showJoint(this.pose?.figureTrunk ? this.labelled : null); // the joint moves under the mouse
        scene.look(this.pose?.figureTrunk ?? null, this.grabbed === null && !this.pose?.isDragging ? elapsedMs : null, this.chases());
    }

    /** The camera chases a driven robot until the user turns the camera. */
    private chases(): boolean {
        const { tab, where } = this.session.state.get();
        const isDriven = tab === 'remote' && where?.state === 'playing';
        if (!isDriven) this.isLookedRound = false;
        return isDriven && !this.isLookedRound && !matchMedia('(prefers-reduced-motion: reduce)').matches;
    }

    private watchSize(scene: RobotScene): void {
        const observer = new ResizeObserver(() => this.resize(scene));
        observer.observe(this);
        if (this.cover) observer.observe(this.cover); // it grows when the robot's motions are known
        this.disposals.push(() => observer.disconnect());
    }

    private resize(scene: RobotScene): void {
        scene.resize(this.clientWidth, this.clientHeight, this.quality.quality, this.cover?.offsetHeight ?? 0);
    }

    private watchTheme(scene: RobotScene): void {
        const paint = (): void => {
            const style = getComputedStyle(this);
            const colour = (name: string): string => style.getPropertyValue(name).trim();
            scene.paint({
                horizon: colour('--room'),
                sky: colour('--room-sky'),
                floor: colour('--room-floor'),
                lines: colour('--room-lines'),
            });
        };
        const dark = matchMedia('(prefers-color-scheme: dark)');
        const observer = new MutationObserver(paint);
        observer.observe(document.documentElement, { attributeFilter: ['data-theme'] });
        dark.addEventListener('change', paint);
        this.disposals.push(
            () => dark.removeEventListener('change', paint),
            () => observer.disconnect(),
        );
        paint();
    }

    private listen(): void {
        const canvas = this.canvas;
        withoutMenu(canvas);
        this.scene?.controls.addEventListener('start', () => (this.isLookedRound = true));
        canvas.addEventListener('pointerdown', event => this.grab(event), { capture: true });
        canvas.addEventListener('pointermove', event => this.move(event));
        canvas.addEventListener('pointerup', event => this.lift(event, true));
        canvas.addEventListener('pointercancel', event => this.lift(event, false));
        canvas.addEventListener('pointerleave', () => this.leave());
        canvas.addEventListener('keydown', event => this.key(event));
        canvas.addEventListener('keyup', () => {
            this.pose?.keyUp();
            this.speak();
        });
        canvas.addEventListener('blur', () => this.pose?.keyUp());
    }

    private at(event: PointerEvent, dx = 0, dy = 0): readonly [number, number] {
        const box = this.canvas.getBoundingClientRect();
        return [((event.clientX + dx - box.left) / box.width) * 2 - 1, 1 - ((event.clientY + dy - box.top) / box.height) * 2];
    }

    private pick(event: PointerEvent): Picked | null {
        const picked = this.scene?.pick(...this.at(event)) ?? null;
        if (picked || event.pointerType !== 'touch') return picked;
        for (const angle of AROUND) {
            const near = this.scene?.pick(...this.at(event, FINGER_PX * Math.cos(angle), FINGER_PX * Math.sin(angle)));
            if (near) return near;
        }
        return null;
    }

    /** Reverts the drag of the first finger when a second one comes down. true: there was a drag. */
    private endDrag(): boolean {
        const hadHold = this.holder !== null;
        this.release(false);
        this.label.hidden = true;
        return hadHold;
    }

    private lift(event: PointerEvent, keep: boolean): void {
        this.fingers.remove(event);
        if (event.pointerType === 'touch') this.label.hidden = true;
        if (event.pointerId === this.holder) this.release(keep);
    }

    private grab(event: PointerEvent): void {
        if (this.fingers.isHandingOver || !this.fingers.add(event)) return;
        if (event.button === 0 && this.pick(event)) this.pose?.showStep(this.state);
        const picked = event.button === 0 ? this.pick(event) : null;
        const isPosing = this.pose?.isPosing === true;
        if (!picked || !this.scene || (!isPosing && this.session.state.get().source !== 'simulated')) return;
        event.stopImmediatePropagation(); // the camera stays where it is
        event.preventDefault();
        this.canvas.focus({ preventScroll: true });
        this.scene.controls.enabled = false;
        this.canvas.setPointerCapture(event.pointerId);
        this.holder = event.pointerId;
        this.makeRoom(event);
        if (event.pointerType === 'touch') this.showJoint(picked.link);
        if (isPosing) this.pose?.down(picked, event.shiftKey || event.ctrlKey);
        else this.take(picked);
    }

    /** Keeps overlays away from the dragging hand: values of the drag move to the other half, the rest is hidden (robot-view.css). */
    private makeRoom(event: PointerEvent): void {
        this.dataset.hand = this.at(event)[1] > 0 ? 'high' : 'low';
    }

    /** Grabs a limb by hand. Servos that are being taught lose their torque. */
    private take(picked: Picked): void {
        this.grabbed = { ...picked, target: picked.world };
        const limb = limbTo(this.session.body, picked.link, picked.point).links.flatMap(({ joint }) => (joint ? [joint.servo] : []));
        this.taught = limb.filter(servo => this.editing.get().taught.has(servo));
        if (this.taught.length > 0) void this.session.setTorque(false, this.taught);
    }

    private move(event: PointerEvent): void {
        if (!this.scene) return;
        this.fingers.move(event);
        if (this.holder !== null && event.pointerId !== this.holder) return;
        if (this.holder !== null) this.makeRoom(event);
        if (this.pose?.isDragging) return this.pose.move(...this.at(event));
        if (!this.grabbed) return event.pointerType === 'touch' ? undefined : this.hover(event);
        const target = this.scene.drag(...this.at(event), this.grabbed.world);
        this.grabbed = { ...this.grabbed, target };
        this.session.sim.pull({ link: this.grabbed.link, point: this.grabbed.point, target });
    }

    /** keep: false reverts the drag. */
    private release(keep: boolean): void {
        if (!this.scene) return;
        this.scene.controls.enabled = true;
        this.holder = null;
        delete this.dataset.hand;
        this.pose?.up(keep);
        if (!this.grabbed) return;
        this.grabbed = null;
        this.scene.pull(null);
        void this.letGo();
    }

    /** Taught servos get their torque back before the hand lets go, so that the limb does not drop. */
    private async letGo(): Promise<void> {
        const isTaught = this.taught.some(servo => this.editing.get().taught.has(servo));
        if (isTaught) await this.session.setTorque(true, this.taught);
        if (!this.grabbed) this.session.sim.pull(null);
    }

    private hover(event: PointerEvent): void {
        const link = this.pick(event)?.link ?? null;
        if (this.scene) this.scene.figure.marked = link;
        this.canvas.classList.toggle('over-robot', link !== null);
        this.showJoint(link);
    }

    private leave(): void {
        if (this.scene) this.scene.figure.marked = null;
        this.canvas.classList.remove('over-robot');
        this.label.hidden = true;
    }

    /** Announces the chosen joints as the keys have turned them. */
    private speak(): void {
        const { joints } = this.session.editor.state.get();
        if (!this.pose?.isPosing || joints.size === 0) return;
        const spoken = this.session.body.joints
            .filter(({ servo }) => joints.has(servo))
            .map(joint => TEXTS.picture.spokenJoint(jointTitle(joint), this.positionOf(joint).position));
        setText(this.spoken, spoken.join(', '));
    }

    private showJoint(link: string | null): void {
        this.labelled = link;
        const joint = this.session.body.joints.find(one => one.body === link);
        this.label.hidden = !joint;
        if (!joint) return;
        const { position, isLimp } = this.positionOf(joint);
        const text = isLimp ? TEXTS.picture.limpJoint : TEXTS.picture.joint;
        setText(this.label, text(joint.servo, jointTitle(joint), position));
    }

    private positionOf(joint: Joint): { readonly position: number; readonly isLimp: boolean } {
        if (this.pose?.isPosing) return { position: Math.round(this.pose.shownPose[joint.servo] ?? joint.zero), isLimp: false };
        const servo = this.state?.servos.find(one => one.id === joint.servo);
        return { position: Math.round(servo?.position ?? joint.zero), isLimp: servo?.torque !== true };
    }

    private key(event: KeyboardEvent): void {
        if (event.ctrlKey || event.altKey || event.metaKey) return;
        const push = ({ p: 1, P: -1 } as const)[keyOf(event)];
        if (this.pose?.isPosing && this.pose.key(event)) event.preventDefault();
        else if (event.key === 'Escape') this.release(false);
        else if (push && !this.pose?.isPosing) pushRobot(this.session, push);
        else this.lookByKey(event);
    }

    private lookByKey(event: KeyboardEvent): void {
        const around = event.shiftKey ? { ArrowLeft: -1, ArrowRight: 1 }[event.key] : undefined;
        const down = { PageUp: -1, PageDown: 1 }[event.key];
        const nearer = { '+': NEARER, '-': 1 / NEARER, '−': 1 / NEARER }[event.key];
        if (around === undefined && down === undefined && nearer === undefined) return;
        event.preventDefault();
        this.scene?.turn(TURN_RAD * (around ?? 0), TURN_RAD * (down ?? 0), nearer ?? 1);
    }
}

define('robot-view', RobotView);
