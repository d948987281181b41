// SPDX-License-Identifier: MIT
// What the tour says, stop by stop.

export interface TourStop {
    readonly text: string;
    /** What ends the stop; `read`: the button alone. */
    readonly goal: 'read' | 'steps-tab' | 'new-page' | 'let-go' | 'drag' | 'add' | 'name' | 'play';
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
    {
        goal: 'play',
        target: '#▶ Play',
        text: 'Press "Play". The robot starts Edit, its firmware that saves motions, takes the page and waves. That takes a few seconds.',
    },
    {
        goal: 'read',
        text: 'That is your first motion. It is kept in this browser. Drag times below the pictures, press "Pose" to bend a step, ? for all keys.',
    },
];
