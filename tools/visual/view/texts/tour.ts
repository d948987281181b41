// SPDX-License-Identifier: MIT
// What the tour says, stop by stop.

export interface TourStop {
    readonly text: string;
    /** What ends the stop; `read`: the button alone. */
    readonly goal: 'read' | 'steps-tab' | 'new-page' | 'let-go' | 'drag' | 'add' | 'name' | 'times' | 'play' | 'send';
    /** Steps that the page has then. */
    readonly steps?: number;
    /** "#Name" of a tab, button or field, or a shape of the robot. */
    readonly target?: string;
}

export const TOUR: readonly TourStop[] = [
    { goal: 'read', text: 'You will teach the robot to wave. It takes two minutes. Nothing can break, and everything can be undone.' },
    { goal: 'steps-tab', target: '#Steps', text: 'Motions are made in Steps. Open it.' },
    { goal: 'new-page', target: '#New page', text: 'A motion is a page. Press "New page" for an empty one.' },
    { goal: 'let-go', target: '#Right arm', text: 'Press "Right arm": the robot lets it go, and it can be moved by hand.' },
    {
        goal: 'drag',
        target: 'right_hand',
        text: 'Take the right hand in the picture and drag it up, beside the head. It holds when you let go of it.',
    },
    { goal: 'add', steps: 1, target: '#Add step from the robot', text: 'Press "Add step from the robot": this pose is the first step.' },
    { goal: 'drag', target: 'right_hand', text: 'Drag the hand to the side.' },
    { goal: 'add', steps: 2, target: '#Add step from the robot', text: 'Add this pose as the second step.' },
    { goal: 'drag', target: 'right_hand', text: 'Drag the hand back up: a wave goes to and fro.' },
    { goal: 'add', steps: 3, target: '#Add step from the robot', text: 'Add this pose as the third step.' },
    { goal: 'name', target: '#Name of the page', text: 'Give it a name, hello for example, and press Enter.' },
    { goal: 'times', target: '#Times', text: 'Once is no waving: put 3 into the field with the ×, and press Enter.' },
    {
        goal: 'play',
        target: '#▶ Play',
        text: 'Press "Play". The robot starts Edit, its firmware that saves motions, takes the page and waves three times. That takes a few seconds.',
    },
    {
        goal: 'send',
        text: 'That is your first motion, and it is saved in this browser. Send it to a friend: the link opens this page, and the robot waves. Press ? for all keys.',
    },
];

export const TOUR_TEXTS = {
    title: (at: number, of: number): string => `Your first wave: ${at} of ${of}`,
    tour: 'Tour',
    back: 'Back',
    start: 'Start',
    next: 'Next',
    done: 'Done',
    end: 'End the tour',
    send: 'Send it to a friend',
} as const;
