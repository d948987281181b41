// SPDX-License-Identifier: MIT
// Which stop of the tour is shown. It goes on when the stop's goal is reached, but not at a stop to which the user went back.

export class TourPlace {
    private readonly count: number;
    private isBack = false;
    /** -1: the tour is not shown. */
    at = -1;

    constructor(count: number) {
        this.count = count;
    }

    /** isBack: stays there although its goal is reached, until that changes or the user goes on. false: the tour ends. */
    go(to: number, isBack = false): boolean {
        this.isBack = isBack;
        this.at = to < this.count ? Math.max(0, to) : -1;
        return this.at >= 0;
    }

    /** true: goes on to the next stop. */
    isOver(isReached: boolean): boolean {
        this.isBack &&= isReached;
        return isReached && !this.isBack;
    }
}
