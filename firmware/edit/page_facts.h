/* SPDX-License-Identifier: MIT
 * page_facts.h - computes how long a page in flash takes and how fast it gets, without playing it.
 * Reads flash through page_store.h, a word at a time. Main loop only. No RAM. The law is motion/step_ticks.c. */
#ifndef PAGE_FACTS_H
#define PAGE_FACTS_H

#include <stdint.h>
#include "page.h"

/* The top speed of an unloaded AX-12 at this supply: 59 rpm = 354 degrees/s at 12 V (maker's data sheet), 283 at a CM-5's
 * 9.6 V. */
#define PAGE_FACTS_FASTEST_DEG_S(supply_dv) ((uint16_t)((supply_dv) * 59u / 20u))

/* The supply assumed while unknown: a CM-5's eight cells, in 0.1 V. */
#define PAGE_FACTS_BATTERY_DV 96u

typedef struct {
    uint16_t ticks;      /* duration without the pause; at least 1 */
    uint16_t pause_ticks;
    uint16_t distance_pos; /* the longest distance of a joint from the previous step (step 0: from the last one) */
    uint8_t joint;       /* the joint that moves that far */
} page_facts_t;

/* One position word. */
uint16_t page_facts_word(uint8_t page, uint8_t step, uint8_t joint);

/* Computes the facts of step 0..PAGE_STEPS-1 of a good page. */
void page_facts_step(uint8_t page, uint8_t step, page_facts_t *facts);

/* Duration of one repetition of a good page, in ticks. */
uint32_t page_facts_ticks(uint8_t page);

/* Mean speed of that joint in the step, degrees/s. */
uint16_t page_facts_deg_s(const page_facts_t *facts);

#endif
