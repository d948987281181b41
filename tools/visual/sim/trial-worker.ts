// SPDX-License-Identifier: MIT
// The worker for trials: plays motions in physics and finds limbs that touch in single poses. It has its own MuJoCo, so the robot on
// display is not affected.

import { jointAngle } from '../model/body.ts';
import type { Body } from '../model/body.ts';
import { JOINTS } from '../model/motion.ts';
import type { Touch, TrialRecord } from '../model/trial.ts';
import { makeMujoco } from './mujoco.ts';
import { PhysicalBody } from './physical-body.ts';
import { TrialStand } from './trial.ts';
import type { FromTrials, ToTrials, TrialParts } from './trial-messages.ts';

interface Ready {
    readonly stand: TrialStand;
    readonly body: Body;
    /** For single poses. A running trial uses another body. */
    readonly posed: PhysicalBody;
}

let ready: Ready | null = null;
let running: { readonly id: number; readonly play: Generator<number, TrialRecord> } | null = null;
const turn = new MessageChannel();
let isTurnDue = false;

function tell(message: FromTrials, transfer: Transferable[] = []): void {
    postMessage(message, { transfer });
}

async function start({ module, wasm, bodyXml, body }: TrialParts): Promise<void> {
    const mujoco = await makeMujoco(wasm);
    const stand = await TrialStand.make(module, body, new PhysicalBody(mujoco, bodyXml, body));
    ready = { stand, body, posed: new PhysicalBody(mujoco, bodyXml, body) };
    tell({ kind: 'started' });
}

/** Queues the next part of the trial behind the waiting messages. */
function later(): void {
    if (!isTurnDue) turn.port2.postMessage(null);
    isTurnDue = true;
}

function goOn(): void {
    isTurnDue = false;
    if (!running) return;
    const { id, play } = running;
    try {
        const { done, value } = play.next();
        if (!done) return later();
        tell({ kind: 'played', id, record: value }, [value.positions.buffer]);
    } catch (cause) {
        fail(id, cause);
    }
    running = null;
}

function touching({ body, posed }: Ready, pose: Uint16Array): Touch[] {
    const joints = new Map(body.joints.map(joint => [joint.servo, joint]));
    return posed.touchingIn(servo => {
        const joint = joints.get(servo);
        return joint ? jointAngle(joint, pose[servo] ?? joint.zero) : 0;
    });
}

function fail(id: number | null, cause: unknown): void {
    tell({ kind: 'failed', id, text: cause instanceof Error ? cause.message : String(cause) });
}

function handle(message: ToTrials): void {
    if (message.kind === 'start') return void start(message).catch((cause: unknown) => fail(null, cause));
    if (!ready) return fail(null, 'there is no place for trials yet');
    switch (message.kind) {
        case 'play':
            running = { id: message.id, play: ready.stand.play(message.request) };
            return later();
        case 'cancel':
            running = null;
            return;
        case 'touch': {
            const { poses, id } = message;
            const here = ready;
            const touches = Array.from({ length: poses.length / JOINTS }, (_, i) =>
                touching(here, poses.subarray(i * JOINTS, (i + 1) * JOINTS)),
            );
            return tell({ kind: 'touched', id, touches });
        }
        default:
            message satisfies never;
    }
}

turn.port1.onmessage = goOn;
self.onmessage = (event: MessageEvent<ToTrials>) => handle(event.data);
