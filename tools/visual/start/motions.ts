// SPDX-License-Identifier: MIT
// The ten motions of the start page, which are pages of the library. The text of their cards is in view/texts/.

export interface StartMotion {
    /** The page's name in the library. */
    readonly name: string;
    /** Start of the picture in the motion, and its longest duration. */
    readonly fromSeconds: number;
    readonly seconds: number;
    /** The robot starts lying on its face after a push. */
    readonly lies?: boolean;
}

export const START_MOTIONS: readonly StartMotion[] = [
    { name: 'walk', fromSeconds: 2, seconds: 4 },
    { name: 'wave', fromSeconds: 0, seconds: 6 },
    { name: 'dance', fromSeconds: 0, seconds: 9 },
    { name: 'kick_r', fromSeconds: 0, seconds: 6 },
    { name: 'get_up', fromSeconds: 0, seconds: 10, lies: true },
    { name: 'pushups', fromSeconds: 0, seconds: 14 },
    { name: 'bow', fromSeconds: 0, seconds: 6 },
    { name: 'clap', fromSeconds: 0, seconds: 6 },
    { name: 'cheer', fromSeconds: 0, seconds: 6 },
    { name: 'sit', fromSeconds: 0, seconds: 4 },
];
