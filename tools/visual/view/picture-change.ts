// SPDX-License-Identifier: MIT
// Whether the picture would look otherwise than it was drawn last: places, colours and what is seen, of all things in the room and
// of the camera. A picture that stands still is not drawn again: that spares the battery, and the processor for the robot.

import type { Camera, Material, Matrix4, Object3D } from 'three';

/** Smaller changes are not seen: what turns by less than 0.06 degrees, or moves by less than 0.25 mm (a servo that holds trembles by
 *  half of that). The camera moves everything: a tenth of it. */
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

    /** Something changed that cannot be told from the room: size, theme, a line's shape. */
    touch(): void {
        this.isTouched = true;
    }

    /** Asks and keeps: the caller draws when this is true. */
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
