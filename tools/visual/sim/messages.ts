// SPDX-License-Identifier: MIT
// All messages between the page and the worker with the simulated robot.

import type { Body } from '../model/body.ts';
import type { Vector } from '../model/space.ts';
import type { RobotState } from '../robot/robot-state.ts';
import type { Button, Sender } from './board.ts';
import type { Images, Memories } from './machine.ts';

/** A hand that pulls a point of a link (in the link's frame) towards a place in the room. */
export interface Grip {
    readonly link: string;
    readonly point: Vector;
    readonly target: Vector;
}

/** The floor: tilt to the front and to the left (radians) and friction (0..2). */
export interface Floor {
    readonly tiltFront: number;
    readonly tiltLeft: number;
    readonly friction: number;
}

export type ToSim =
    | {
          readonly kind: 'start';
          readonly module: WebAssembly.Module;
          readonly body: Body;
          readonly images: Images;
          readonly kept: Memories | null;
      }
    /** The page has taken the last state and may get the next. A slow page gets fewer states instead of a queue. */
    | { readonly kind: 'seen' }
    | { readonly kind: 'physics'; readonly bodyXml: string; readonly wasm: ArrayBuffer }
    | { readonly kind: 'bytes'; readonly sender: Sender; readonly bytes: Uint8Array }
    | { readonly kind: 'speed'; readonly speed: number }
    | { readonly kind: 'tick' }
    | { readonly kind: 'power'; readonly on: boolean }
    | { readonly kind: 'reset' }
    | { readonly kind: 'button'; readonly button: Button; readonly down: boolean }
    | { readonly kind: 'battery'; readonly volts: number }
    | { readonly kind: 'fault'; readonly servo: number; readonly fault: number; readonly answers: number }
    /** ticks: releases the grip after this many ticks; without it, at the next grip. */
    | { readonly kind: 'grip'; readonly grip: Grip | null; readonly ticks?: number }
    | { readonly kind: 'hold'; readonly held: boolean }
    | { readonly kind: 'floor'; readonly floor: Floor }
    | { readonly kind: 'memories'; readonly id: number };

export type FromSim =
    | { readonly kind: 'started'; readonly faults: readonly string[] }
    | { readonly kind: 'physics'; readonly error: string | null }
    | { readonly kind: 'bytes'; readonly bytes: Uint8Array }
    | { readonly kind: 'state'; readonly state: RobotState }
    /** The robot has written flash or EEPROM. Comes before what the robot says of it; the memories follow when it is at rest. */
    | { readonly kind: 'writes' }
    /** Memories to keep: the robot has written flash or EEPROM and is now at rest, or is asked for its memories. `id`: answers the request
     *  with that id. */
    | { readonly kind: 'memories'; readonly memories: Memories; readonly id: number | null }
    | { readonly kind: 'violation'; readonly violation: string; readonly text: string }
    | { readonly kind: 'crashed'; readonly text: string };
