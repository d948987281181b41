// SPDX-License-Identifier: MIT
// The tour goes on by itself, and back when it is told to.
import { expect, test } from 'vitest';
import { TourPlace } from '../view/editor/tour-place.ts';

test('it goes on when a goal is reached, and ends after the last stop', () => {
    const place = new TourPlace(2);
    expect([place.go(0), place.at, place.isOver(false), place.isOver(true)]).toEqual([true, 0, false, true]);
    expect([place.go(1), place.at, place.go(2), place.at]).toEqual([true, 1, false, -1]);
});

test('back stays at a stop whose goal is reached, until that changes and is reached again, or the user goes on', () => {
    const place = new TourPlace(3);
    place.go(1);
    place.go(0, true);
    expect([place.isOver(true), place.isOver(true)]).toEqual([false, false]);
    expect([place.isOver(false), place.isOver(true)]).toEqual([false, true]);
    place.go(-1, true); // there is nothing before the first
    expect([place.at, place.isOver(true)]).toEqual([0, false]);
    place.go(1);
    expect(place.isOver(true)).toBe(true);
});
