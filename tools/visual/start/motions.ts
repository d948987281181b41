// SPDX-License-Identifier: MIT
// The ten motions of the start page: pages of the library, and what stands below their pictures.

export interface StartMotion {
    /** Of the page in the library. */
    readonly name: string;
    readonly title: string;
    readonly text: string;
    /** Of the picture: seconds from the beginning, and at most. */
    readonly fromSeconds: number;
    readonly seconds: number;
    /** It begins lying on its face, where a push has brought it. */
    readonly lies?: boolean;
}

export const START_MOTIONS: readonly StartMotion[] = [
    { name: 'walk', title: 'Walk', text: 'It goes on until you stop it.', fromSeconds: 2, seconds: 4 },
    { name: 'wave', title: 'Wave', text: 'The right hand, beside the head.', fromSeconds: 0, seconds: 6 },
    { name: 'dance', title: 'Dance', text: '120 beats a minute.', fromSeconds: 0, seconds: 9 },
    { name: 'kick_r', title: 'Kick', text: 'On one leg, with the other.', fromSeconds: 0, seconds: 6 },
    { name: 'get_up', title: 'Get up', text: 'From lying on its face.', fromSeconds: 0, seconds: 10, lies: true },
    { name: 'pushups', title: 'Push-ups', text: 'Four of them, and up again.', fromSeconds: 0, seconds: 14 },
    { name: 'bow', title: 'Bow', text: 'Forty degrees.', fromSeconds: 0, seconds: 6 },
    { name: 'clap', title: 'Clap', text: 'Three times.', fromSeconds: 0, seconds: 6 },
    { name: 'cheer', title: 'Cheer', text: 'Both arms up.', fromSeconds: 0, seconds: 6 },
    { name: 'sit', title: 'Sit down', text: 'On its heels, and stays there.', fromSeconds: 0, seconds: 4 },
];
