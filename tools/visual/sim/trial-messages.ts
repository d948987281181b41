// SPDX-License-Identifier: MIT
// All messages between the page and the worker for trials.

import type { Body } from '../model/body.ts';
import type { Touch, TrialRecord, TrialRequest } from '../model/trial.ts';

/** What a worker for trials needs to start. module: trial.wasm; wasm: the bytes of mujoco.wasm. */
export interface TrialParts {
    readonly module: WebAssembly.Module;
    readonly wasm: ArrayBuffer;
    readonly bodyXml: string;
    readonly body: Body;
}

export type ToTrials =
    | ({ readonly kind: 'start' } & TrialParts)
    /** One at a time. A new play ends the previous one, which then gets no answer. */
    | { readonly kind: 'play'; readonly id: number; readonly request: TrialRequest }
    | { readonly kind: 'cancel' }
    /** poses: servo units by ID, JOINTS numbers each. */
    | { readonly kind: 'touch'; readonly id: number; readonly poses: Uint16Array };

export type FromTrials =
    | { readonly kind: 'started' }
    | { readonly kind: 'played'; readonly id: number; readonly record: TrialRecord }
    | { readonly kind: 'touched'; readonly id: number; readonly touches: readonly (readonly Touch[])[] }
    /** id: the failed request; null: the worker cannot run at all. */
    | { readonly kind: 'failed'; readonly id: number | null; readonly text: string };
