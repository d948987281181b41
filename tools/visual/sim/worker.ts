// SPDX-License-Identifier: MIT
// The worker with the simulated robot: its loop in wall-clock time and its messages (messages.ts).

import { CYCLES_PER_TICK } from './board.ts';
import { resetBoard, makeMachine, readMemories } from './machine.ts';
import type { FromSim, ToSim } from './messages.ts';
import { Pacer } from './pacer.ts';
import { Simulation } from './simulation.ts';

const TURN_MS = 12; // computing time before messages are read again
const FRAME_MS = 1000 / 60;
/** A tick of the robot takes as long. */
const IDLE_MS = 8;
const PAUSED_MS = 50;
/** Written memories are sent to be kept after this time without further writes. */
const REST_MS = 300;

let simulation: Simulation | null = null;
let startedBody: Extract<ToSim, { kind: 'start' }>['body'] | null = null;
const pacer = new Pacer();
let frameAtMs = 0;
let keptOperations = 0;
let seenOperations = 0;
let writtenAtMs = 0;
/** The page knows that the robot has written what it has not got yet. */
let isWriteTold = false;
let isStopped = false;
let isSeen = true;
/** Messages that came while the robot was being made. */
const early: ToSim[] = [];
const ready = new MessageChannel();

function tell(message: FromSim, transfer: Transferable[] = []): void {
    postMessage(message, { transfer });
}

async function start(message: Extract<ToSim, { kind: 'start' }>): Promise<void> {
    const board = await makeMachine(message.module, message.images, message.kept, Math.floor(Math.random() * 0xffffffff));
    startedBody = message.body;
    simulation = new Simulation(board, message.body);
    isStopped = false;
    keptOperations = seenOperations = board.operations;
    board.setPower(true);
    pacer.setSpeed(1, performance.now(), board.nowCycles);
    tell({ kind: 'started', faults: board.faultNames() });
    for (const one of early.splice(0)) handle(one);
    loop();
}

async function addPhysics(message: Extract<ToSim, { kind: 'physics' }>): Promise<void> {
    try {
        const [{ makeMujoco }, { PhysicalBody }] = await Promise.all([import('./mujoco.ts'), import('./physical-body.ts')]);
        const mujoco = await makeMujoco(message.wasm);
        if (!simulation || !startedBody) throw new Error('there is no robot yet');
        simulation.setPhysical(new PhysicalBody(mujoco, message.bodyXml, startedBody));
        pacer.setSpeed(pacer.isPaused ? 0 : pacer.currentSpeed, performance.now(), simulation.board.nowCycles);
        tell({ kind: 'physics', error: null });
    } catch (cause) {
        tell({ kind: 'physics', error: cause instanceof Error ? cause.message : String(cause) });
    }
}

function loop(): void {
    if (!simulation || isStopped) return;
    const startMs = performance.now();
    const isBehind = run(simulation, startMs);
    if (simulation.board.operations !== keptOperations && !isWriteTold) {
        isWriteTold = true;
        tell({ kind: 'writes' });
    }
    const bytes = simulation.board.receive();
    if (bytes.length > 0) tell({ kind: 'bytes', bytes }, [bytes.buffer]);
    const nowMs = performance.now();
    if (isSeen && nowMs - frameAtMs >= FRAME_MS - 1) sendFrame(simulation, nowMs);
    if (isBehind) ready.port2.postMessage(null);
    else setTimeout(() => guarded(loop), pacer.isPaused ? PAUSED_MS : IDLE_MS);
}

/** Runs what is due, for at most one turn. true: there is more. */
function run(robot: Simulation, startMs: number): boolean {
    while (robot.board.nowCycles < pacer.dueCycle(performance.now(), robot.board.nowCycles)) {
        const before = robot.board.nowCycles;
        const due = pacer.dueCycle(performance.now(), before);
        if (due - before < CYCLES_PER_TICK) return false; // less than a tick
        if (!robot.runTick()) {
            const violation = robot.board.violation;
            isStopped = true;
            tell({ kind: 'violation', violation: violation?.kind ?? 'unknown', text: violation?.text ?? '' });
            return false;
        }
        if (performance.now() - startMs > TURN_MS) return true;
    }
    return false;
}

function sendFrame(robot: Simulation, nowMs: number): void {
    frameAtMs = nowMs;
    isSeen = false;
    const state = robot.state(pacer.lateMs(nowMs, robot.board.nowCycles));
    tell({ kind: 'state', state }, [state.trace.buffer]);
    const operations = robot.board.operations;
    if (operations !== seenOperations) {
        seenOperations = operations;
        writtenAtMs = nowMs;
    } else if (operations !== keptOperations && nowMs - writtenAtMs > REST_MS) {
        tellWritten(robot);
    }
}

function tellWritten({ board }: Simulation): void {
    keptOperations = seenOperations = board.operations;
    isWriteTold = false;
    tell({ kind: 'memories', memories: readMemories(board), id: null });
}

function handle(message: ToSim): void {
    if (message.kind === 'start') return void start(message).catch(crash);
    if (!simulation) {
        if (message.kind !== 'bytes') early.push(message); // bytes: nobody reads the line yet
        return;
    }
    if (message.kind === 'physics') return void addPhysics(message);
    if (message.kind === 'seen') {
        isSeen = true;
        return;
    }
    const { board } = simulation;
    switch (message.kind) {
        case 'bytes':
            return board.send(message.sender, message.bytes);
        case 'speed':
            return pacer.setSpeed(message.speed, performance.now(), board.nowCycles);
        case 'tick':
            return void simulation.runTick();
        case 'power':
            return board.setPower(message.on);
        case 'reset':
            return resetBoard(board);
        case 'button':
            return board.press(message.button, message.down);
        case 'battery':
            return board.setBattery(message.volts);
        case 'fault':
            return simulation.setFault(message.servo, message.fault, message.answers);
        case 'grip':
            return simulation.setGrip(message.grip, message.ticks);
        case 'hold':
            return simulation.setHeld(message.held);
        case 'floor':
            return simulation.setFloor(message.floor);
        case 'memories':
            if (board.operations !== keptOperations) tellWritten(simulation);
            return tell({ kind: 'memories', memories: readMemories(board), id: message.id });
        default:
            message satisfies never;
    }
}

function crash(cause: unknown): void {
    isStopped = true;
    tell({ kind: 'crashed', text: cause instanceof Error ? cause.message : String(cause) });
}

ready.port1.onmessage = () => guarded(loop);
self.onmessage = (event: MessageEvent<ToSim>) => guarded(() => handle(event.data));

function guarded(action: () => void): void {
    try {
        action();
    } catch (cause) {
        crash(cause);
    }
}
