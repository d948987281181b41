// SPDX-License-Identifier: MIT
// Detects whether the picture has changed since it was last drawn: poses, colours and visibility of all objects, and the camera. An
// unchanged picture is not drawn again, which saves battery and leaves the processor to the robot.

import type { Camera, Material, Matrix4, Object3D } from 'three';

/** Smaller changes are invisible: less than 0.06 degrees or 0.25 mm (a holding servo trembles by half of that). For the camera, which moves
 *  everything, the limit is a tenth. */
const SEEN = 1e-3;
const METRES = 4;
const OF_CAMERA = 10;

interface Look {
    readonly color?: { readonly r: number; readonly g: number; readonly b: number };
    readonly emissive?: { readonly r: number };
    readonly emissiveIntensity?: number;
}

export class PictureChange {
    private drawn: readonly number[] = [];
    private isTouched = true;

    /** Reports a change that take() cannot detect: size, theme, shape of a line. */
    touch(): void {
        this.isTouched = true;
    }

    /** Compares with the last drawn state. true: it differs and is stored as drawn, so the caller must draw. */
    take(room: Object3D, camera: Camera): boolean {
        room.updateMatrixWorld();
        camera.updateMatrixWorld();
        const now: number[] = [];
        addPlace(now, camera.matrixWorld, OF_CAMERA);
        room.traverseVisible(object => {
            const { material } = object as Object3D & { readonly material?: Material };
            if (!material) return;
            const { color, emissive, emissiveIntensity } = material as Material & Look;
            addPlace(now, object.matrixWorld, 1);
            now.push(object.id, color?.r ?? 0, color?.g ?? 0, color?.b ?? 0, emissive?.r ?? 0, emissiveIntensity ?? 0);
        });
        const isSame =
            !this.isTouched && now.length === this.drawn.length && now.every((value, i) => Math.abs(value - (this.drawn[i] ?? 0)) < SEEN);
        if (isSame) return false;
        this.drawn = now;
        this.isTouched = false;
        return true;
    }
}

function addPlace(to: number[], { elements }: Matrix4, fineness: number): void {
    for (const [i, element] of elements.entries()) to.push(element * fineness * (i >= 12 ? METRES : 1));
}
