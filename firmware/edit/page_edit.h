/* SPDX-License-Identifier: MIT
 * page_edit.h - what editing computes of positions and times: mirror images, steps put in between. Pure; no RAM.
 * VisualEditor's WebAssembly links it too. */
#ifndef PAGE_EDIT_H
#define PAGE_EDIT_H

#include <stdint.h>

/* A position as the joint on the other side has it: as far from its own neutral position, on the other side; limited to
 * 0..PAGE_POS_MAX. `neutral_sum`: the neutral positions of both joints together, 2 * PAGE_POS_MIDDLE unless known. */
uint16_t page_edit_mirrored(uint16_t pos, uint16_t neutral_sum);

/* value * mul / div, rounded to the nearest, halves up. div is not 0; the result has to fit 16 bits. */
uint16_t page_edit_part(uint16_t value, uint16_t mul, uint16_t div);

/* The position that is `percent` (0..100) of the distance from a to b: rounded to the nearest, halves away from a. */
uint16_t page_edit_between(uint16_t a, uint16_t b, uint8_t percent);

/* Divides the time of a step with a new one before it, which gets `percent` of it: returns the new one's time, rounded
 * to the nearest, halves up; `time` keeps the rest. Both are at least 1, unless there was no time. */
uint8_t page_edit_time_split(uint8_t *time, uint8_t percent);

#endif
