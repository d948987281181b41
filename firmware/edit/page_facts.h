/* SPDX-License-Identifier: MIT
 * page_facts.h - computes how long a page in flash takes, without playing it.
 * Reads flash through page_store.h, a word at a time. Main loop only. No RAM. The law is motion/step_ticks.c. */
#ifndef PAGE_FACTS_H
#define PAGE_FACTS_H

#include <stdint.h>

/* Duration of one repetition of a good page, in ticks. */
uint32_t page_facts_ticks(uint8_t page);

#endif
