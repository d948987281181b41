// SPDX-License-Identifier: MIT
// Camera and figure in the room. Draws on request and holds no state of the robot.

import {
    BufferGeometry,
    Line,
    LineBasicMaterial,
    Matrix4,
    PCFShadowMap,
    PerspectiveCamera,
    Quaternion,
    Raycaster,
    Scene,
    Spherical,
    Vector2,
    Vector3,
    WebGLRenderer,
    Plane,
} from 'three';
import type { Object3D } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import type { Body } from '../model/body.ts';
import type { Place, Vector } from '../model/space.ts';
import { chaseTurn, headingOf } from './chase.ts';
import { glide } from './glide.ts';
import { PictureAside } from './picture-aside.ts';
import { PictureChange } from './picture-change.ts';
import type { Quality } from './picture-quality.ts';
import { RobotFigure } from './robot-figure.ts';
import { Room } from './room.ts';
import type { RoomColours } from './room.ts';
import type { Hand } from './session/session.ts';

/** Share of the remaining distance per 1/60 s (glide.ts). */
const FOLLOW = 0.08;
const DAMPING = 0.12;
const MOST_PIXELS = 2;
/** The camera rests when it moves by less in a frame (metres, radians). What is left of its way is then an eighth of a millimetre. */
const REST = 1e-5;
/** In three's spherical coordinates y is up, in the room z. */
const TO_Y_UP = new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), new Vector3(0, 1, 0));
const LEAST_POLAR = 0.05;
const EDGE_ON = 0.2; // sine of the angle between line of sight and plane

export interface Picked {
    readonly link: string;
    /** Name of the shape that was hit, if it has one. */
    readonly shape: string | null;
    /** In the frame of the link. */
    readonly point: Vector;
    readonly world: Vector;
}

export class RobotScene {
    readonly figure: RobotFigure;
    readonly controls: OrbitControls;
    /** WebGL runs in software: there is no GPU, or the browser may not use it. */
    readonly isSoftware: boolean;
    private readonly renderer: WebGLRenderer;
    private readonly aside: PictureAside | null;
    private readonly scene = new Scene();
    private readonly camera = new PerspectiveCamera(32, 1, 0.02, 60);
    private readonly place = new Room(this.scene);
    private readonly room = this.place.leaning;
    private readonly string: Line;
    private readonly followed = new Vector3(0, 0, 0.14);
    private readonly raycaster = new Raycaster();
    private readonly change = new PictureChange();
    private readonly cameraBefore = new Matrix4();
    private readonly changed: () => void;

    /** changed: called when draw() has something to draw. Throws when the browser has no WebGL. */
    constructor(canvas: HTMLCanvasElement, body: Body, changed: () => void) {
        this.changed = changed;
        this.isSoftware = drawsBySoftware();
        this.aside = this.isSoftware ? new PictureAside(canvas) : null;
        this.renderer = new WebGLRenderer({ canvas: this.aside?.canvas ?? canvas, antialias: !this.isSoftware });
        this.renderer.domElement.addEventListener('webglcontextrestored', () => this.touch());
        this.renderer.shadowMap.enabled = true;
        this.renderer.shadowMap.type = PCFShadowMap;
        this.figure = new RobotFigure(body);
        this.camera.up.set(0, 0, 1);
        this.camera.position.set(0.88, -0.56, 0.42);
        this.controls = new OrbitControls(this.camera, canvas);
        this.controls.target.copy(this.followed);
        this.controls.addEventListener('change', changed);
        Object.assign(this.controls, { minDistance: 0.3, maxDistance: 4, maxPolarAngle: Math.PI * 0.52, enableDamping: true });
        this.string = new Line(
            new BufferGeometry().setFromPoints([new Vector3(), new Vector3()]),
            new LineBasicMaterial({ color: 0x2f9bff }),
        );
        this.string.visible = false;
        this.string.frustumCulled = false;
        this.figure.root.visible = false;
        this.room.add(this.figure.root, this.string);
        this.place.goWith(this.followed);
    }

    /** Colours of the room, from the page's theme. */
    paint(colours: RoomColours): void {
        this.place.paint(colours);
        this.touch();
    }

    /** covered: pixels at the lower edge that another element covers. A shift by a quarter is enough: the robot is above the middle. */
    resize(width: number, height: number, quality: Quality, covered: number): void {
        this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, MOST_PIXELS) * quality.pixels);
        this.place.light.castShadow = quality.shadows;
        this.renderer.setSize(width, height, false);
        this.camera.aspect = width / Math.max(height, 1);
        this.camera.setViewOffset(width, height, 0, covered / 4, width, height);
        this.touch();
    }

    tilt(front: number, left: number): void {
        this.room.rotation.set(-left, front, 0);
        this.changed();
    }

    /** Adds objects to the room, such as ghosts and marks on the floor. */
    add(...objects: Object3D[]): void {
        this.room.add(...objects);
    }

    /** Orbits the camera around its target (radians). distance: factor for the distance to the target. */
    turn(around: number, down: number, distance: number): void {
        const { object, target, minDistance, maxDistance, maxPolarAngle } = this.controls;
        const from = new Spherical().setFromVector3(object.position.clone().sub(target).applyQuaternion(TO_Y_UP));
        from.set(
            clamp(from.radius * distance, minDistance, maxDistance),
            clamp(from.phi + down, LEAST_POLAR, maxPolarAngle),
            from.theta + around,
        );
        object.position.setFromSpherical(from).applyQuaternion(TO_Y_UP.clone().invert()).add(target);
        this.changed();
    }

    /** Shows the robot; null: there is nothing to show. The camera follows the trunk, and if it chases, turns behind it. elapsedMs: since the
     *  last call; null: it stays. */
    look(trunk: Place | null, elapsedMs: number | null, chases: boolean): void {
        this.figure.root.visible = trunk !== null;
        if (trunk && elapsedMs !== null) this.follow(trunk, glide(FOLLOW, elapsedMs), chases);
        this.place.goWith(this.followed);
    }

    /** Draws if the picture has changed (isNew); elapsedMs: since the last call. isMoving: the camera glides on. */
    draw(elapsedMs: number): { readonly isNew: boolean; readonly isMoving: boolean } {
        this.controls.dampingFactor = glide(DAMPING, elapsedMs); // the camera glides on after a gesture
        this.controls.update();
        this.figure.hideLamps(this.camera.position);
        const isNew = this.change.take(this.scene, this.camera);
        if (isNew) {
            this.renderer.render(this.scene, this.camera);
            this.aside?.show(this.renderer.getContext() as WebGL2RenderingContext); // three uses WebGL 2 only
        }
        const { elements } = this.cameraBefore;
        const isMoving = this.camera.matrixWorld.elements.some((value, i) => Math.abs(value - (elements[i] ?? 0)) > REST);
        this.cameraBefore.copy(this.camera.matrixWorld);
        return { isNew, isMoving };
    }

    /** Makes the next draw() draw in any case. */
    private touch(): void {
        this.change.touch();
        this.changed();
    }

    /** The last picture drawn is not visible yet. */
    get isBusy(): boolean {
        return this.aside?.isBusy === true;
    }

    /** What is at a point of the picture (-1..1, y up). */
    pick(x: number, y: number): Picked | null {
        if (!this.figure.root.visible) return null;
        this.raycaster.setFromCamera(new Vector2(x, y), this.camera);
        const hit = this.raycaster.intersectObjects(this.figure.meshes, false)[0];
        const link: unknown = hit?.object.userData.link;
        if (!hit || typeof link !== 'string') return null;
        const frame = this.figure.link(link);
        const local = frame ? frame.worldToLocal(hit.point.clone()) : hit.point;
        const shape: unknown = hit.object.userData.shape;
        return {
            link,
            shape: typeof shape === 'string' ? shape : null,
            point: local.toArray(),
            world: this.room.worldToLocal(hit.point.clone()).toArray(),
        };
    }

    /** Intersects the line of sight at (x, y) with the plane through `world` with this normal. A plane seen edge-on: as drag(). */
    dragInPlane(x: number, y: number, world: Vector, normal: Vector): Vector {
        this.raycaster.setFromCamera(new Vector2(x, y), this.camera);
        const towards = new Vector3(...normal).transformDirection(this.room.matrixWorld);
        const isEdgeOn = Math.abs(towards.dot(this.raycaster.ray.direction)) < EDGE_ON;
        return (isEdgeOn ? null : this.hitOf(world, towards)) ?? this.drag(x, y, world);
    }

    /** Position of a shape of the figure in the picture (-1..1, y up); null: no shape has that name. */
    placeOf(shape: string): readonly [number, number] | null {
        const mesh = this.figure.meshes.find(one => one.userData.shape === shape);
        if (!mesh) return null;
        const { x, y } = mesh.getWorldPosition(new Vector3()).project(this.camera);
        return [x, y];
    }

    /** Intersects the line of sight at (x, y) with the plane through `world` that faces the camera. */
    drag(x: number, y: number, world: Vector): Vector {
        this.raycaster.setFromCamera(new Vector2(x, y), this.camera);
        return this.hitOf(world, this.camera.getWorldDirection(new Vector3())) ?? world;
    }

    /** Where the ray meets the plane through `world`; null: nowhere. */
    private hitOf(world: Vector, normal: Vector3): Vector | null {
        const plane = new Plane().setFromNormalAndCoplanarPoint(normal, this.room.localToWorld(new Vector3(...world)));
        const hit = this.raycaster.ray.intersectPlane(plane, new Vector3());
        return hit && this.room.worldToLocal(hit).toArray();
    }

    /** Shows the string between hand and limb; null: hides it. */
    pull(hand: Hand | null): void {
        const frame = hand && this.figure.link(hand.link);
        this.string.visible = !!frame;
        this.changed();
        if (!frame) return;
        const from = this.room.worldToLocal(frame.localToWorld(new Vector3(...hand.point)));
        this.string.geometry.setFromPoints([from, new Vector3(...hand.target)]);
        this.touch();
    }

    dispose(): void {
        this.controls.dispose();
        this.figure.dispose();
        this.place.dispose();
        this.aside?.dispose();
        this.renderer.dispose();
    }

    private follow(trunk: Place, share: number, chases: boolean): void {
        const wanted = new Vector3(trunk.pos[0], trunk.pos[1], Math.max(0.07, trunk.pos[2] * 0.47));
        const step = wanted.sub(this.followed).multiplyScalar(share);
        this.followed.add(step);
        this.controls.target.add(step);
        this.camera.position.add(step);
        const heading = chases ? headingOf(trunk) : null;
        if (heading === null) return;
        const from = this.camera.position.clone().sub(this.controls.target);
        this.turn(chaseTurn(Math.atan2(from.y, from.x), heading, Math.hypot(step.x, step.y)), 0, 1);
    }
}

function clamp(value: number, least: number, most: number): number {
    return Math.min(Math.max(value, least), most);
}

function drawsBySoftware(): boolean {
    const context = document.createElement('canvas').getContext('webgl2');
    const facts = context?.getExtension('WEBGL_debug_renderer_info');
    const name: unknown = context && facts ? context.getParameter(facts.UNMASKED_RENDERER_WEBGL) : '';
    context?.getExtension('WEBGL_lose_context')?.loseContext();
    return typeof name === 'string' && /swiftshader|llvmpipe|software/i.test(name);
}
