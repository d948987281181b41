// SPDX-License-Identifier: MIT
// The ten motions of the start page: pages of the library. What stands on their cards is in view/texts/.

export interface StartMotion {
    /** Of the page in the library. */
    readonly name: string;
    /** Of the picture: seconds from the beginning, and at most. */
    readonly fromSeconds: number;
    readonly seconds: number;
    /** It begins lying on its face, where a push has brought it. */
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
