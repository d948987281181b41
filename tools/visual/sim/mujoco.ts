// SPDX-License-Identifier: MIT
// The part of MuJoCo's WebAssembly that is used here, with types. Its own declarations type every array as `any`.

import loadMujoco from '@mujoco/mujoco';

export interface Model {
    readonly nbody: number;
    readonly njnt: number;
    readonly nu: number;
    readonly jnt_qposadr: Int32Array;
    readonly jnt_dofadr: Int32Array;
    readonly jnt_user: Float64Array;
    readonly nuser_jnt: number;
    readonly actuator_trnid: Int32Array;
    readonly geom_friction: Float64Array;
    /** The body that a geom belongs to. */
    readonly geom_bodyid: Int32Array;
    readonly body_mass: Float64Array;
    /** timestep: seconds. */
    readonly opt: { gravity: Float64Array; readonly timestep: number };
    delete(): void;
}

interface Contact {
    readonly geom1: number;
    readonly geom2: number;
    /** Distance in metres; negative: overlap. */
    readonly dist: number;
    delete(): void;
}

interface Contacts {
    get(index: number): Contact | undefined;
    delete(): void;
}

/** The arrays are views into the module's memory, created at each access. */
export interface Data {
    readonly qpos: Float64Array;
    readonly qvel: Float64Array;
    readonly ctrl: Float64Array;
    readonly xfrc_applied: Float64Array;
    readonly xpos: Float64Array;
    readonly xquat: Float64Array;
    readonly xipos: Float64Array;
    readonly ncon: number;
    /** A copy, created at each access. Delete it and each contact taken from it. */
    readonly contact: Contacts;
    delete(): void;
}

export interface Mujoco {
    readonly MjModel: { from_xml_string(xml: string): Model };
    readonly MjData: new (model: Model) => Data;
    mj_step(model: Model, data: Data): void;
    mj_forward(model: Model, data: Data): void;
    mj_kinematics(model: Model, data: Data): void;
    mj_collision(model: Model, data: Data): void;
    mj_resetData(model: Model, data: Data): void;
    mj_name2id(model: Model, type: number, name: string): number;
}

/** mjtObj: MuJoCo's numbers of object types. */
export const OBJECT = { body: 1, joint: 3, geom: 5 } as const;

/** wasm: the bytes of mujoco.wasm. Throws if there is not enough memory for it. */
export async function makeMujoco(wasm: ArrayBuffer): Promise<Mujoco> {
    const module: unknown = await loadMujoco({ wasmBinary: wasm });
    return module as Mujoco; // narrowed to what is used; tests/physical-body.test.ts uses all of it
}
