/* SPDX-License-Identifier: MIT
 * sparse_pages.h - a page_source_t over pages that use joints 0..3 only, small enough for the RAM of the ATmega128. */
#ifndef SPARSE_PAGES_H
#define SPARSE_PAGES_H

#include "player.h"

#define SPARSE_JOINTS 4u
#define SPARSE_PAGES 5u /* pages 1..4; any other is damaged */

typedef struct {
    uint16_t pos[SPARSE_JOINTS];
    uint8_t pause, time;
} sparse_step_t;

typedef struct {
    uint8_t count, schedule, steps, speed, accel, next, exit, link1, code1, compliance;
    bool damaged;
    sparse_step_t step[PAGE_STEPS];
} sparse_page_t;

extern sparse_page_t sparse_pages[SPARSE_PAGES];
extern const page_source_t sparse_source;

/* Resets all pages: count 1, time base, no steps, speed 32, accel 32, no links. */
void sparse_clear(void);

/* Appends a step to page `page` with all four joints at pos. */
void sparse_step(uint8_t page, uint8_t time, uint8_t pause, uint16_t pos);

#endif
