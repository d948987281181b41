// SPDX-License-Identifier: MIT
// Everything that the page and the worker with the program for servos say to each other.

import type { Memories } from './machine.ts';

/** Which of the ports that the page may use: the browser's names for them are no use in a worker. */
export interface PortHint {
    readonly usbVendorId: number | undefined;
    readonly usbProductId: number | undefined;
    readonly index: number;
}

export type ToServos =
    | { readonly kind: 'start'; readonly module: WebAssembly.Module; readonly kept: Memories; readonly port: PortHint }
    | { readonly kind: 'bytes'; readonly bytes: Uint8Array }
    /** Brings the robot to a stand, ends the program, gives the port back. Answered by `ended`. */
    | { readonly kind: 'end' }
    | { readonly kind: 'kept'; readonly id: number; readonly isKept: boolean };

export type FromServos =
    /** The adapter's port is open, and the program runs. */
    | { readonly kind: 'started' }
    /** The port cannot be opened: nothing runs. */
    | { readonly kind: 'refused'; readonly text: string }
    | { readonly kind: 'bytes'; readonly bytes: Uint8Array }
    | { readonly kind: 'sentence'; readonly text: string }
    | { readonly kind: 'adapter'; readonly isThere: boolean }
    /** Keep this, then say `kept`: the program waits for it. */
    | { readonly kind: 'keep'; readonly id: number; readonly memories: readonly Uint8Array[] }
    | { readonly kind: 'ended' }
    | { readonly kind: 'crashed'; readonly text: string };
