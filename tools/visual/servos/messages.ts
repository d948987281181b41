// SPDX-License-Identifier: MIT
// All messages between the page and the worker that runs the program for servos.

import type { Memories } from './machine.ts';

export type ToServos =
    /** port: the adapter's place in getPorts(), -1 if it is out. The browser's port objects cannot be sent to a worker. */
    | { readonly kind: 'start'; readonly module: WebAssembly.Module; readonly kept: Memories; readonly port: number }
    | { readonly kind: 'bytes'; readonly bytes: Uint8Array }
    /** Stops the robot, ends the program, closes the port. Answered by `ended`. */
    | { readonly kind: 'end' }
    | { readonly kind: 'kept'; readonly id: number; readonly isKept: boolean };

export type FromServos =
    /** The adapter's port is open, and the program runs. */
    | { readonly kind: 'started' }
    /** The port cannot be opened. Nothing runs. */
    | { readonly kind: 'refused'; readonly text: string }
    | { readonly kind: 'bytes'; readonly bytes: Uint8Array }
    | { readonly kind: 'sentence'; readonly text: string }
    | { readonly kind: 'adapter'; readonly isThere: boolean }
    /** Store these memories, then send `kept`. The program waits for it. */
    | { readonly kind: 'keep'; readonly id: number; readonly memories: readonly Uint8Array[] }
    | { readonly kind: 'ended' }
    | { readonly kind: 'crashed'; readonly text: string };
