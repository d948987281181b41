// SPDX-License-Identifier: MIT
// Contacts in MuJoCo's model: geoms with the floor, links of the robot with each other.

import type { Touch } from '../model/trial.ts';
import type { Data } from './mujoco.ts';

export interface GeomTouch {
    /** A pair. */
    readonly geoms: readonly number[];
    readonly depthM: number;
}

/** Geoms in contact after the last step or the last mj_collision(). */
export function geomTouches({ ncon, contact }: Data): GeomTouch[] {
    const all = Array.from({ length: ncon }, (_, i) => {
        const one = contact.get(i);
        const copied = { geoms: [one?.geom1 ?? -1, one?.geom2 ?? -1], depthM: -(one?.dist ?? 1) };
        one?.delete();
        return copied;
    });
    contact.delete();
    return all.filter(({ depthM }) => depthM >= 0);
}

/** Links in contact: each pair once, with its greatest depth. linkOf: the name of a geom's link; undefined if it is not part of the
 *  robot. */
export function linkTouches(touches: readonly GeomTouch[], linkOf: (geom: number) => string | undefined): Touch[] {
    const pairs = new Map<string, Touch>();
    for (const { geoms, depthM } of touches) {
        const [a, b] = geoms.map(linkOf).sort();
        if (a === undefined || b === undefined) continue;
        if (depthM >= (pairs.get(`${a} ${b}`)?.depthM ?? 0)) pairs.set(`${a} ${b}`, { links: [a, b], depthM });
    }
    return [...pairs.values()];
}
