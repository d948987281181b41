// SPDX-License-Identifier: MIT
// The stops of the tour: text, goal, and target of the ring.

import { TEXTS } from '../texts/texts.ts';

export interface TourStop {
    readonly text: string;
    /** Ends the stop when reached; `read`: only the button ends it. */
    readonly goal: 'read' | 'steps-tab' | 'new-page' | 'let-go' | 'drag' | 'add' | 'name' | 'times' | 'play' | 'send';
    /** Number of steps that the page must have. */
    readonly steps?: number;
    /** `#` and the name of a tab, button or field, or a shape of the robot. */
    readonly target?: string;
}

export function tourStops(): readonly TourStop[] {
    const { tour, areas, steps, teach } = TEXTS;
    const hand = 'right_hand';
    const add = `#${teach.add}`;
    return [
        { goal: 'read', text: tour.begin },
        { goal: 'steps-tab', target: `#${areas.titles.steps}`, text: tour.openSteps },
        { goal: 'new-page', target: `#${steps.create}`, text: tour.newMotion },
        { goal: 'let-go', target: `#${teach.rightArm}`, text: tour.letGo },
        { goal: 'drag', target: hand, text: tour.dragUp },
        { goal: 'add', steps: 1, target: add, text: tour.addFirst },
        { goal: 'drag', target: hand, text: tour.dragSide },
        { goal: 'add', steps: 2, target: add, text: tour.addSecond },
        { goal: 'drag', target: hand, text: tour.dragBack },
        { goal: 'add', steps: 3, target: add, text: tour.addThird },
        { goal: 'name', target: `#${steps.nameOf}`, text: tour.name },
        { goal: 'times', target: `#${steps.times}`, text: tour.times },
        { goal: 'play', target: `#${steps.play}`, text: tour.play },
        { goal: 'send', text: tour.sendIt },
    ];
}
