// SPDX-License-Identifier: MIT
// The fingers on a picture whose camera is turned by others (three's OrbitControls). One finger may be kept from the camera for a
// drag of its own; as soon as a second one comes down, both are the camera's.

export class Fingers {
    private readonly canvas: HTMLElement;
    private readonly onSecond: () => void;
    /** Where each was last. */
    private readonly down = new Map<number, PointerEvent>();
    /** An event that this makes itself, for the camera alone. */
    isHandingOver = false;

    /** onSecond: a second finger is about to come down; says whether the first was kept from the camera, and ends its drag. */
    constructor(canvas: HTMLElement, onSecond: () => boolean) {
        this.canvas = canvas;
        this.onSecond = () => onSecond() && this.handOver();
    }

    /** true: it is the only one. Mouse and pen always are. */
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

    /** The camera's controls have not heard of the first one yet. */
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
