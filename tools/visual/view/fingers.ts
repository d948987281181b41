// SPDX-License-Identifier: MIT
// The fingers on a picture whose camera is turned by three's OrbitControls. A single finger may be kept from the camera for a drag of its
// own. When a second one comes down, both control the camera.

export class Fingers {
    private readonly canvas: HTMLElement;
    private readonly onSecond: () => void;
    /** Last event of each finger. */
    private readonly down = new Map<number, PointerEvent>();
    /** true while a synthetic event goes to the camera; others ignore it. */
    isHandingOver = false;

    /** onSecond: called before a second finger is added. Ends the drag of the first; returns whether that was kept from the camera. */
    constructor(canvas: HTMLElement, onSecond: () => boolean) {
        this.canvas = canvas;
        this.onSecond = () => onSecond() && this.handOver();
    }

    /** true: it is the only one. */
    add(event: PointerEvent): boolean {
        if (event.pointerType !== 'touch') return this.down.size === 0;
        if (this.down.size === 1) this.onSecond();
        this.down.set(event.pointerId, event);
        return this.down.size === 1;
    }

    move(event: PointerEvent): void {
        if (this.down.has(event.pointerId)) this.down.set(event.pointerId, event);
    }

    remove(event: PointerEvent): void {
        this.down.delete(event.pointerId);
    }

    /** Repeats the first finger's event for the camera's controls, which have not seen it. */
    private handOver(): void {
        const [first] = this.down.values();
        if (!first) return;
        const { pointerId, pointerType, isPrimary, clientX, clientY } = first;
        this.isHandingOver = true;
        this.canvas.dispatchEvent(
            new PointerEvent('pointerdown', {
                pointerId,
                pointerType,
                isPrimary,
                clientX,
                clientY,
                button: 0,
                buttons: 1,
                bubbles: true,
                cancelable: true,
            }),
        );
        this.isHandingOver = false;
    }
}
