// SPDX-License-Identifier: MIT
// The room: an endless floor, a light with shadows, a sky down to the horizon. Floor, light and sky move with what the camera follows. The
// floor moves by whole tile patterns, so that it seems to lie still.

import {
    AmbientLight,
    BackSide,
    CanvasTexture,
    CircleGeometry,
    Color,
    DirectionalLight,
    Float32BufferAttribute,
    Fog,
    Group,
    HemisphereLight,
    Mesh,
    MeshBasicMaterial,
    MeshStandardMaterial,
    RepeatWrapping,
    SRGBColorSpace,
    SphereGeometry,
} from 'three';
import type { Scene, Vector3 } from 'three';

/** Colours of the page's theme. */
export interface RoomColours {
    readonly horizon: string;
    readonly sky: string;
    readonly floor: string;
    readonly lines: string;
}

const FLOOR_M = 12;
const TILE_M = 0.1;
/** Period of the pattern of light and dark tiles. */
const PATTERN_M = 2 * TILE_M;
/** Beyond `far` everything has the colour of the horizon, so that the floor shows no edge. */
const FOG_M = { near: 2.5, far: 8 };
const SKY_M = 40;
/** The camera looks down, so only the lowest tenth of the sky is visible. */
const SKY_STEEPNESS = 8;

export class Room {
    /** Everything that tilts with the floor. */
    readonly leaning = new Group();
    readonly light = new DirectionalLight(0xffffff, 2.4);
    private readonly scene: Scene;
    private readonly material = new MeshStandardMaterial({ roughness: 1 });
    private readonly floor = new Mesh(new CircleGeometry(FLOOR_M, 64), this.material);
    private readonly sky = new Mesh(
        new SphereGeometry(SKY_M, 24, 24),
        new MeshBasicMaterial({ side: BackSide, vertexColors: true, fog: false, depthWrite: false }),
    );

    constructor(scene: Scene) {
        this.scene = scene;
        this.floor.receiveShadow = true;
        this.light.castShadow = true;
        this.light.shadow.mapSize.set(1024, 1024);
        this.light.shadow.radius = 4;
        this.light.shadow.bias = -0.0004;
        Object.assign(this.light.shadow.camera, { left: -0.6, right: 0.6, top: 0.6, bottom: -0.6, near: 0.5, far: 4 });
        this.leaning.add(this.floor, this.light, this.light.target);
        scene.add(this.leaning, this.sky, new HemisphereLight(0xffffff, 0x8a8f98, 1.25), new AmbientLight(0xffffff, 0.35));
    }

    paint({ horizon, sky, floor, lines }: RoomColours): void {
        this.scene.background = new Color(horizon);
        this.scene.fog = new Fog(horizon, FOG_M.near, FOG_M.far);
        this.material.map?.dispose();
        this.material.map = tiles(floor, lines);
        this.material.needsUpdate = true;
        this.paintSky(new Color(horizon), new Color(sky));
    }

    /** Moves floor, light and sky to the point that the camera follows (metres). */
    goWith(at: Vector3): void {
        this.light.position.set(at.x + 0.5, at.y - 0.7, 1.9);
        this.light.target.position.copy(at);
        this.floor.position.set(wholePatterns(at.x), wholePatterns(at.y), 0);
        this.sky.position.set(at.x, at.y, 0);
    }

    dispose(): void {
        this.material.map?.dispose();
        for (const { geometry, material } of [this.floor, this.sky]) {
            geometry.dispose();
            material.dispose();
        }
    }

    /** The horizon's colour up to the horizon, then a gradient to the sky's. */
    private paintSky(horizon: Color, sky: Color): void {
        const { position } = this.sky.geometry.attributes;
        if (!position) return;
        const colours = Array.from({ length: position.count }, (_, i) =>
            horizon
                .clone()
                .lerp(sky, Math.min(1, Math.max(0, (SKY_STEEPNESS * position.getZ(i)) / SKY_M)))
                .toArray(),
        );
        this.sky.geometry.setAttribute('color', new Float32BufferAttribute(colours.flat(), 3));
    }
}

/** Rounds a distance in metres to whole tile patterns. */
export function wholePatterns(metres: number): number {
    return Math.round(metres / PATTERN_M) * PATTERN_M;
}

/** Tiles of 10 cm, so that distances can be judged. */
function tiles(floor: string, dark: string): CanvasTexture {
    const canvas = document.createElement('canvas');
    canvas.width = canvas.height = 64;
    const context = canvas.getContext('2d');
    if (context) {
        context.fillStyle = floor;
        context.fillRect(0, 0, 64, 64);
        context.globalAlpha = 0.22;
        context.fillStyle = dark;
        context.fillRect(0, 0, 32, 32);
        context.fillRect(32, 32, 32, 32);
    }
    const texture = new CanvasTexture(canvas);
    texture.wrapS = texture.wrapT = RepeatWrapping;
    texture.repeat.set((2 * FLOOR_M) / PATTERN_M, (2 * FLOOR_M) / PATTERN_M);
    texture.colorSpace = SRGBColorSpace;
    texture.anisotropy = 8;
    return texture;
}
