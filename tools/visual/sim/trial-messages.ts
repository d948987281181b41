// SPDX-License-Identifier: MIT
// Everything that the page and the worker for trials say to each other.

import type { Body } from '../model/body.ts';
import type { Touch, TrialRecord, TrialRequest } from '../model/trial.ts';

/** What a worker for trials begins with. module: trial.wasm; wasm: the bytes of mujoco.wasm. */
export interface TrialParts {
    readonly module: WebAssembly.Module;
    readonly wasm: ArrayBuffer;
    readonly bodyXml: string;
    readonly body: Body;
}

export type ToTrials =
    | ({ readonly kind: 'start' } & TrialParts)
    /** One at a time: another one ends the one before, which is not answered. */
    | { readonly kind: 'play'; readonly id: number; readonly request: TrialRequest }
    | { readonly kind: 'cancel' }
    /** poses: servo units by ID, JOINTS numbers each. */
    | { readonly kind: 'touch'; readonly id: number; readonly poses: Uint16Array };

export type FromTrials =
    | { readonly kind: 'started' }
    | { readonly kind: 'played'; readonly id: number; readonly record: TrialRecord }
    | { readonly kind: 'touched'; readonly id: number; readonly touches: readonly (readonly Touch[])[] }
    /** id: of what could not be done; null: the worker as a whole cannot work. */
    | { readonly kind: 'failed'; readonly id: number | null; readonly text: string };
