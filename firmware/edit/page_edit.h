/* SPDX-License-Identifier: MIT
 * page_edit.h - arithmetic of editing on positions and times: mirroring, interpolated steps. Pure; no RAM.
 * VisualEditor's WebAssembly links it too. */
#ifndef PAGE_EDIT_H
#define PAGE_EDIT_H

#include <stdint.h>

/* The position mirrored for the joint on the other side: the same distance from that joint's neutral position, in the other
 * direction, limited to 0..PAGE_POS_MAX. neutral_sum: sum of both neutral positions, 2 * PAGE_POS_MIDDLE unless known. */
uint16_t page_edit_mirrored(uint16_t pos, uint16_t neutral_sum);

/* value * mul / div, rounded to the nearest, halves up. div must not be 0; the result must fit 16 bits. */
uint16_t page_edit_part(uint16_t value, uint16_t mul, uint16_t div);

/* The position that is `percent` (0..100) of the distance from a to b: rounded to the nearest, halves away from a. */
uint16_t page_edit_between(uint16_t a, uint16_t b, uint8_t percent);

/* Splits the time of a step: a new step before it gets `percent` of it. Returns the new step's time, rounded to the nearest,
 * halves up; *time keeps the rest. Both are at least 1, unless *time was 0: then both are 0. */
uint8_t page_edit_time_split(uint8_t *time, uint8_t percent);

#endif
